// SPDX-License-Identifier: MIT
#include "design/run/design_run.hpp"

#include <algorithm>
#include <limits>

#include "design/checks/representable.hpp"
#include "design/gains/estimator.hpp"
#include "design/loop/compensator.hpp"
#include "design/loop/cost.hpp"
#include "design/loop/rounded_loop.hpp"
#include "design/rounding.hpp"
#include "design/run/design_run_parts.hpp"
#include "design/run/order_run.hpp"
#include "design/sampled/added_states.hpp"

namespace lqg::design {

namespace {

StageSolution stage_solution(const SampledStage& stage) {
  StageSolution solution;
  solution.from = stage.from;
  solution.plant = stage.samples.plant;
  solution.cost = stage.samples.cost;
  solution.noise = stage.samples.noise;
  const std::optional<Estimator>& kalman = stage.of_filter().estimator;
  if (has_noise(kalman) && kalman->gain == Gain::online) solution.online = online_filter(*kalman, stage.samples);
  return solution;
}

FilterStart start_of(const SampledStage& first) {
  const Estimator& estimator = *first.of_filter().estimator;
  return {initial_state(estimator, first.samples), initial_covariance(estimator, first.samples)};
}

// Without those of the controller's copy of the last input, which the plant that is measured keeps, too.
std::vector<ComplexReal> poles_of_closed_loop(const Problem& problem, const Solution& solution) {
  const MeasuredPlant plant = measured_plant(problem, solution);
  std::vector<ComplexReal> poles = eigenvalues(closed_loop(plant, compensator(problem, solution)).A);
  const auto farther = [](const ComplexReal& a, const ComplexReal& b) { return hypot(a.re, a.im) > hypot(b.re, b.im); };
  std::sort(poles.begin(), poles.end(), farther);
  if (!solution.compensator) poles.resize(poles.size() - static_cast<std::size_t>(plant.B.cols()));
  return poles;
}

void take_loop_poles(const Problem& problem, DesignRun& run) {
  run.loop_poles = run.regulator_poles;
  run.loop_poles.insert(run.loop_poles.end(), run.estimator_poles.begin(), run.estimator_poles.end());
  run.loop_poles.insert(run.loop_poles.end(), static_cast<std::size_t>(late_output_count(problem)), {Real(0), Real(0)});
  if (run.solution.compensator) run.loop_poles = poles_of_closed_loop(problem, run.solution);
  if (run.solution.compensator || !run.has_steady_loop || !problem.estimator ||
      is_separated(problem, final_plant(run.solution)))
    return;
  run.loop_poles = poles_of_closed_loop(problem, run.solution);
  if (!is_stable(run.loop_poles))
    add_error(
        run.findings, "lqr.integral",
        "the integrated outputs answer an input at once (plant.D), and in filter form they are measured before the "
        "next input: the loop is unstable, use form = \"predictor\"");
}

// A loop that stays what it is in the end: with a filter where one is asked for, and stable.
bool has_steady_loop(const Problem& problem, const DesignRun& run) {
  return run.solution.regulator && problem.estimator.has_value() == run.solution.estimator.has_value() &&
         is_stable(run.regulator_poles) && is_stable(run.estimator_poles);
}

// White innovations need the filter that is optimal for ever, for the plant that is there.
std::optional<SteadyCost> cost_of_loop(const SampledStage& last, const Solution& solution) {
  const Estimator& kalman = *last.problem.estimator;
  const Compensator controller = compensator(last.problem, solution);
  const bool is_optimal =
      (kalman.gain != Gain::schedule || kalman.horizon == 0) && kalman.structure.size() == 0 && !kalman.recovery;
  if (!is_optimal || has_added_states(last.problem)) return steady_cost(last.problem, last.of_loop(), controller);
  return steady_cost(last.problem, last.samples, controller, solution);
}

}  // namespace

bool is_stable(const std::vector<ComplexReal>& poles) {
  return std::all_of(poles.begin(), poles.end(), [](const ComplexReal& pole) { return hypot(pole.re, pole.im) < 1; });
}

void take_condition(const RiccatiResult& result, Solution& solution) {
  const double condition = std::min(to_double(result.condition), std::numeric_limits<double>::max());
  solution.numerics.condition = std::max(solution.numerics.condition, condition);
}

DesignRun run_design(const Problem& problem, const DesignRun* coarser) {
  DesignRun result;
  std::vector<SampledStage> stages = sample_stages(problem);
  if (has_white_parameters(problem) && !problem.regulator)
    add_noise_of_white_parameters(problem, stages.front().samples, result.findings);
  if (has_error(result.findings)) return result;
  result.stages = stages;
  result.solution.plant = stages.front().samples.plant;
  if (problem.estimator) result.solution.start = start_of(stages.front());
  for (std::size_t i = 1; i < stages.size(); ++i) result.solution.stages.push_back(stage_solution(stages[i]));
  check_representable(result.solution, problem.code.real, result.findings);
  if (has_error(result.findings)) return result;
  result.findings.clear();  // the notes come at the end, with the others
  if (problem.estimator) check_model(stages.back().samples.plant, problem.code.real, result.findings);
  if (has_error(result.findings)) return result;
  if (problem.regulator) run_regulator(problem, stages, coarser, result);
  if (foresees(problem.limits) && !has_error(result.findings)) run_limits(problem, stages.back().samples, result);
  if (problem.estimator) run_estimator(problem, stages, coarser, result);
  if (has_error(result.findings)) return result;
  if (is_of_given_order(problem)) run_compensator(problem, stages.back().of_loop(), coarser, result);
  if (has_error(result.findings)) return result;
  result.has_steady_loop = result.ordered || has_steady_loop(problem, result);
  take_loop_poles(problem, result);
  if (!result.has_steady_loop || !has_cost(problem.regulator) || !has_noise(problem.estimator)) return result;
  if (result.ordered) return result;
  const std::optional<SteadyCost> cost = cost_of_loop(stages.back(), result.solution);
  if (cost) result.cost_per_sample = cost->per_sample;
  if (cost) result.cost_per_second = cost->per_second;
  return result;
}

}  // namespace lqg::design
