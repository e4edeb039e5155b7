#include "design/draft.hpp"

#include "design/checks.hpp"
#include "design/cost.hpp"
#include "design/estimator.hpp"
#include "design/regulator.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

void take_condition(Solution& solution, const RiccatiResult& result) {
  solution.numerics.condition = std::max(solution.numerics.condition, to_double(result.condition));
}

void draft_regulator(const Problem& problem, const Samples& samples, const Draft* coarser, Draft& result) {
  check_stabilisable(problem, samples.plant, result.findings);
  check_weights_on_limit(problem, samples, result.findings);
  if (has_error(result.findings)) return;
  const RiccatiResult found =
      solve_regulator(problem, samples, coarser ? coarser->solution.regulator->X : RealMatrix());
  explain_regulator(found.failure, result.findings);
  if (found.failure != RiccatiFailure::none) return;
  take_condition(result.solution, found);
  result.solution.regulator = RegulatorSolution{*samples.cost, found.K, found.X, {}};
  result.regulator_poles = eigenvalues(found.closed);
  for (const ComplexReal& pole : result.regulator_poles)
    if (!(hypot(pole.re, pole.im) < 1) && problem.regulator->cost == Cost::continuous)
      return add_error(result.findings, "lqr.cost",
                       "the continuous gain does not stabilise the sampled plant: sample faster, or use \"sampled\"");
}

void draft_estimator(const Problem& problem, const Samples& samples, const Draft* coarser, Draft& result) {
  check_detectable(problem, samples.plant, result.findings);
  check_noise_on_limit(problem, samples, result.findings);
  if (has_error(result.findings)) return;
  const RiccatiResult found =
      solve_estimator(samples, coarser ? coarser->solution.estimator->P_prior : RealMatrix());
  explain_estimator(found.failure, result.findings);
  if (found.failure != RiccatiFailure::none) return;
  take_condition(result.solution, found);
  result.solution.estimator = filter_of(samples, found.X);
  result.estimator_poles = eigenvalues(found.closed);
  if (problem.estimator->gain == Gain::online) result.solution.online = online_filter(*problem.estimator, samples);
}

}  // namespace

Draft draft(const Problem& problem, const Draft* coarser) {
  Draft result;
  const Samples samples = sample(problem);
  result.solution.plant = samples.plant;
  if (problem.regulator) draft_regulator(problem, samples, coarser, result);
  if (problem.estimator) draft_estimator(problem, samples, coarser, result);
  if (has_error(result.findings) || !problem.regulator || !problem.estimator) return result;
  const SteadyCost cost = steady_cost(problem, samples, result.solution);
  result.cost_per_sample = cost.per_sample;
  result.cost_per_second = cost.per_second;
  return result;
}

}  // namespace lqg::design
