// SPDX-License-Identifier: MIT
#include <algorithm>

#include "design/checks/rounding_artefacts.hpp"
#include "design/checks/well_posed.hpp"
#include "design/gains/horizon.hpp"
#include "design/gains/pole_placement.hpp"
#include "design/gains/regulator.hpp"
#include "design/run/design_run_parts.hpp"
#include "design/run/order_run.hpp"
#include "design/run/sparse_gain_run.hpp"
#include "design/sampled/added_states.hpp"
#include "design/sampled/anti_windup.hpp"
#include "design/sampled/reference.hpp"

namespace lqg::design {

namespace {

// The plant as if u took effect at once: what sampling does to its modes does not depend on the delay.
SampledPlant plant_without_delay(const Problem& problem, const Samples& samples) {
  return problem.plant.delay > 0 ? sample(problem, Delay()).plant : samples.plant;
}

void check_integral(const Problem& problem, const SampledPlant& plant, Findings& findings) {
  const std::vector<int>& outputs = problem.regulator->integral->outputs;
  const std::size_t before = findings.size();
  check_set_points(plant, outputs, "lqr.integral", findings);
  if (findings.size() == before) check_set_points_are_no_artefact(problem, outputs, "lqr.integral", findings);
}

void check_regulator(const Problem& problem, const Samples& samples, DesignRun& result) {
  result.may_want_digits = !check_stabilisable(problem, plant_without_delay(problem, samples), result.findings);
  if (!has_error(result.findings)) check_reach_is_no_artefact(problem, result.findings);
  if (problem.regulator->integral) check_integral(problem, samples.plant, result.findings);
  if (!has_error(result.findings))
    check_weights_on_limit(problem, deciding_equation(problem, samples), result.findings);
  if (!has_error(result.findings)) check_weights_are_no_artefact(problem, result.findings);
}

void take_table(const GainTable& table, const char* key, DesignRun& result) {
  if (table.failed_at >= 0)
    return add_error(result.findings, key,
                     "R + BᵀXB of step " + std::to_string(table.failed_at) +
                         " is not positive definite: some input costs nothing there");
  result.solution.regulator->K_schedule = table.K;
  result.solution.regulator->X0 = table.X_first;
}

// The gain that is optimal for ever after the last change.
void run_steady_law(const SampledStage& last, const DesignRun* coarser, DesignRun& result) {
  check_regulator(last.problem, last.of_regulator(), result);
  if (has_error(result.findings)) return;
  const bool is_white = has_white_parameters(last.problem) && !last.problem.estimator;
  const RealMatrix start = !coarser ? RealMatrix() : is_white ? coarser->unaware_riccati : coarser->own_law->X;
  const SteadyRegulator found = solve_regulator(last.problem, last.of_regulator(), start);
  explain_regulator(found.riccati.failure, result.findings);
  if (found.riccati.failure != RiccatiFailure::none) {
    result.may_want_digits = true;
    return;
  }
  take_condition(found.riccati, result.solution);
  result.solution.regulator->K = found.riccati.K;
  result.solution.regulator->X = found.riccati.X;
  result.regulator_poles = found.poles;
  result.unaware_riccati = found.riccati.X;
  if (is_white) return run_white_law(last.problem, last.of_regulator(), found.riccati.K, result);
  if (last.problem.regulator->structure.size() > 0)
    keep_regulator_structure(last.problem, last.of_regulator(), coarser, result);
  const bool is_used = !is_of_given_order(last.problem);  // else it is there to compare with
  if (is_used && last.problem.regulator->cost == Cost::continuous && !is_stable(found.poles))
    add_error(result.findings, "lqr.cost",
              "the continuous gain does not stabilise the sampled plant: sample faster, or use \"sampled\"");
}

// The gains of `horizon` steps; the last one is held, whatever that makes of the loop.
void run_finite(const std::vector<SampledStage>& stages, const Regulator& lqr, DesignRun& result) {
  const SampledStage& last = stage_at(stages, lqr.horizon - 1);
  RegulatorSolution& regulator = *result.solution.regulator;
  const RealMatrix X_end = final_weight(last, lqr.Q_final);
  const GainTable table = gains_backward(stages, lqr.horizon, X_end);
  take_table(table, "lqr.horizon", result);
  if (has_error(result.findings)) return;
  const Index nx = last.problem.plant.A.rows();
  regulator.Q_final = X_end.topLeftCorner(nx, nx);
  regulator.K = table.K.back();
  regulator.X = table.X_last;
  result.regulator_poles = eigenvalues(regulated_loop(last.problem, last.of_regulator().plant, regulator.K));
  if (!is_stable(result.regulator_poles))
    add_note(
        result.findings, "lqr.horizon",
        "the gain that is held at the end does not stabilise the plant: the loop has no margins and no steady cost");
}

void run_optimal_law(const Problem& problem, const std::vector<SampledStage>& stages, const DesignRun* coarser,
                     DesignRun& result) {
  RegulatorSolution& regulator = result.solution.regulator.emplace();
  regulator.cost = *stages.front().of_regulator().cost;
  if (problem.regulator->horizon > 0) return run_finite(stages, *problem.regulator, result);
  run_steady_law(stages.back(), coarser, result);
  if (stages.size() > 1 && !has_error(result.findings))
    take_table(gains_backward(stages, last_change(stages), regulator.X), "stage", result);
}

void run_feed_forward(const SampledStage& last, DesignRun& result) {
  const std::optional<SetPoint> point = set_point(last.problem, last.of_regulator().plant, result.findings);
  if (!point) return;
  check_set_points_are_no_artefact(last.problem, last.problem.regulator->track, "lqr.track", result.findings);
  RegulatorSolution& regulator = *result.solution.regulator;
  regulator.Nx = point->Nx;
  regulator.Nu = point->Nu;
  regulator.Nbar = feed_forward(last.problem, regulator.K, regulator.Gamma, *point);
}

void run_anti_windup(const SampledStage& last, DesignRun& result) {
  RegulatorSolution& regulator = *result.solution.regulator;
  const auto Gamma = state_share_of_integrals(last.problem, last.of_regulator().plant, regulator.K);
  if (!Gamma)
    return add_note(
        result.findings, "lqr.integral",
        "without its integrals the loop has a pole at 1, so the model does not tell what a limited input costs "
        "them: at a limit they follow the input (anti_windup = \"conditioning\")");
  regulator.Gamma = *Gamma;
  if (last.problem.regulator->anti_windup == AntiWindup::model)
    regulator.H = anti_windup(last.problem, last.of_regulator().plant, regulator.Gamma);
}

void run_placed_law(const Problem& problem, const Samples& samples, const DesignRun* coarser, DesignRun& result) {
  const PlacedGain placed =
      place_regulator(problem, samples.plant, coarser ? &*coarser->regulator_choice : nullptr, result.findings);
  result.may_want_digits = placed.may_want_digits;
  if (has_error(result.findings)) return;
  result.regulator_choice = placed.choice;
  result.regulator_poles = placed.poles;
  result.solution.regulator.emplace();
  result.solution.regulator->K = placed.gain;
}

// Of the plant's own states.
void run_own_law(const Problem& problem, const std::vector<SampledStage>& stages, const DesignRun* coarser,
                 DesignRun& result) {
  if (!has_cost(problem.regulator)) return run_placed_law(problem, stages.back().of_regulator(), coarser, result);
  run_optimal_law(problem, stages, coarser, result);
  if (problem.regulator->integral && !has_error(result.findings)) run_anti_windup(stages.back(), result);
  if (!problem.regulator->track.empty() && !has_error(result.findings)) run_feed_forward(stages.back(), result);
}

}  // namespace

void run_regulator(const Problem& problem, const std::vector<SampledStage>& stages, const DesignRun* coarser,
                   DesignRun& result) {
  run_own_law(problem, stages, coarser, result);
  if (has_error(result.findings)) return;
  result.own_law = result.solution.regulator;
  add_states_to(problem, *result.solution.regulator);
}

}  // namespace lqg::design
