#include "design/draft.hpp"

#include <algorithm>
#include <limits>

#include "design/checks.hpp"
#include "design/cost.hpp"
#include "design/estimator.hpp"
#include "design/placed.hpp"
#include "design/regulator.hpp"
#include "design/representable.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

void take_condition(Solution& solution, const RiccatiResult& result) {
  const double condition = std::min(to_double(result.condition), std::numeric_limits<double>::max());
  solution.numerics.condition = std::max(solution.numerics.condition, condition);
}

// The plant as if u took effect at once: what sampling does to its modes does not depend on the delay.
SampledPlant plant_without_delay(const Problem& problem, const Samples& samples) {
  return problem.plant.delay > 0 ? sample(problem, Delay()).plant : samples.plant;
}

bool is_stable(const std::vector<ComplexReal>& poles) {
  return std::all_of(poles.begin(), poles.end(),
                     [](const ComplexReal& pole) { return hypot(pole.re, pole.im) < 1; });
}

void check_regulator(const Problem& problem, const Samples& samples, Draft& result) {
  result.may_want_digits =
      !check_stabilisable(problem, plant_without_delay(problem, samples), result.findings);
  if (problem.regulator->integral)
    check_set_points(samples.plant, problem.regulator->integral->outputs, "lqr.integral", result.findings);
  if (!has_error(result.findings))
    check_weights_on_limit(problem, deciding_equation(problem, samples), result.findings);
}

void draft_regulator(const Problem& problem, const Samples& samples, const Draft* coarser, Draft& result) {
  check_regulator(problem, samples, result);
  if (has_error(result.findings)) return;
  const SteadyRegulator found =
      solve_regulator(problem, samples, coarser ? coarser->solution.regulator->X : RealMatrix());
  explain_regulator(found.riccati.failure, result.findings);
  if (found.riccati.failure != RiccatiFailure::none) result.may_want_digits = true;
  if (found.riccati.failure != RiccatiFailure::none) return;
  take_condition(result.solution, found.riccati);
  RegulatorSolution& regulator = result.solution.regulator.emplace();
  regulator.cost = *samples.cost;
  regulator.K = found.riccati.K;
  regulator.X = found.riccati.X;
  result.regulator_poles = found.poles;
  if (problem.regulator->cost == Cost::continuous && !is_stable(found.poles))
    add_error(result.findings, "lqr.cost",
              "the continuous gain does not stabilise the sampled plant: sample faster, or use \"sampled\"");
}

void draft_placed_regulator(const Problem& problem, const Samples& samples, const Draft* coarser, Draft& result) {
  const PlacedGain placed = place_regulator(problem, samples.plant,
                                            coarser ? &*coarser->regulator_choice : nullptr, result.findings);
  result.may_want_digits = placed.may_want_digits;
  if (has_error(result.findings)) return;
  result.regulator_choice = placed.choice;
  result.regulator_poles = placed.poles;
  result.solution.regulator.emplace();
  result.solution.regulator->K = placed.gain;
}

void draft_placed_estimator(const Problem& problem, const Samples& samples, const Draft* coarser, Draft& result) {
  const PlacedGain placed = place_observer(problem, samples,
                                           coarser ? &*coarser->estimator_choice : nullptr, result.findings);
  result.may_want_digits = result.may_want_digits || placed.may_want_digits;
  if (has_error(result.findings)) return;
  result.estimator_choice = placed.choice;
  result.estimator_poles = placed.poles;
  result.solution.estimator = observer_of(samples.plant, problem.estimator->form, placed.gain);
}

void draft_estimator(const Problem& problem, const Samples& samples, const Draft* coarser, Draft& result) {
  if (!check_detectable(problem, own_plant(samples), result.findings)) result.may_want_digits = true;
  check_noise_on_limit(problem, samples, result.findings);
  if (has_error(result.findings)) return;
  const RiccatiResult found =
      solve_estimator(samples, coarser ? coarser->solution.estimator->P_prior : RealMatrix());
  explain_estimator(found.failure, result.findings);
  if (found.failure != RiccatiFailure::none) result.may_want_digits = true;
  if (found.failure != RiccatiFailure::none) return;
  take_condition(result.solution, found);
  result.solution.estimator = filter_of(samples, found.X);
  result.estimator_poles = eigenvalues(found.closed);
  result.estimator_poles.resize(static_cast<std::size_t>(samples.plant.A.rows()), {Real(0), Real(0)});
  if (problem.estimator->gain == Gain::online)
    result.solution.online = online_filter(*problem.estimator, samples);
}

}  // namespace

Draft draft(const Problem& problem, const Draft* coarser) {
  Draft result;
  const Samples samples = sample(problem);
  result.solution.plant = samples.plant;
  check_representable(result.solution, problem.code.real, result.findings);
  if (has_error(result.findings)) return result;
  result.findings.clear();  // the notes come at the end, with the others
  if (problem.regulator)
    (has_cost(problem.regulator) ? draft_regulator : draft_placed_regulator)(problem, samples, coarser, result);
  if (problem.estimator)
    (has_noise(problem.estimator) ? draft_estimator : draft_placed_estimator)(problem, samples, coarser, result);
  if (has_error(result.findings) || !has_cost(problem.regulator) || !has_noise(problem.estimator)) return result;
  const std::optional<SteadyCost> cost =
      steady_cost(problem, samples, compensator(problem, result.solution), *result.solution.estimator);
  if (cost) result.cost_per_sample = cost->per_sample;
  if (cost) result.cost_per_second = cost->per_second;
  return result;
}

}  // namespace lqg::design
