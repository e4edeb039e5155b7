// SPDX-License-Identifier: MIT
#include <algorithm>

#include "design/checks/rounding_artefacts.hpp"
#include "design/checks/well_posed.hpp"
#include "design/finding.hpp"
#include "design/gains/pole_placement.hpp"
#include "design/gains/schedule.hpp"
#include "design/run/design_run_parts.hpp"
#include "design/run/sparse_gain_run.hpp"
#include "design/sampled/added_states.hpp"

namespace lqg::design {

namespace {

std::vector<ComplexReal> poles_of_filter(const Samples& samples, const RealMatrix& L_predictor) {
  const SampledPlant own = own_plant(samples);
  std::vector<ComplexReal> poles = eigenvalues(own.A - multiply(L_predictor.topRows(own.A.rows()), own.C));
  poles.resize(static_cast<std::size_t>(samples.plant.A.rows()), {Real(0), Real(0)});  // of the known inputs
  return poles;
}

// Do the noises of late outputs and of those that come sooner or later know of each other?
bool couples_periods(const Plant& plant, const RealMatrix& V) {
  const std::vector<Index> periods = periods_of_outputs(plant);
  for (Index i = 0; i < V.rows(); ++i)
    for (Index j = 0; j < i; ++j)
      if (periods[static_cast<std::size_t>(i)] != periods[static_cast<std::size_t>(j)] && !V(i, j).is_zero())
        return true;
  return false;
}

// The spectrum of late outputs is that of prompt ones with factors z⁻ᵠ to the left and zᵠ to the right, unless their
// noises are coupled: the optimal filter's poles are those of the prompt filter, and zeros. Eigenvalues of the long
// chain, defective ones at 0, would have few digits.
std::vector<ComplexReal> poles_of_optimal_filter(const SampledStage& stage, const RealMatrix& L_predictor) {
  const Samples& samples = stage.samples;
  if (late_output_count(stage.problem) == 0 || couples_periods(stage.problem.plant, samples.noise->V))
    return poles_of_filter(samples, L_predictor);
  const Samples prompt = sample(stage.of_filter());
  const RiccatiResult found = solve_estimator(prompt, RealMatrix());
  if (found.failure != RiccatiFailure::none) return poles_of_filter(samples, L_predictor);
  std::vector<ComplexReal> poles = poles_of_filter(prompt, filter_of(prompt, found.X).L_predictor);
  poles.resize(static_cast<std::size_t>(samples.plant.A.rows()), {Real(0), Real(0)});
  return poles;
}

// Is there a steady filter? One that is updated on the target can do without, where a mode needs no noise.
bool has_steady_filter(const SampledStage& stage, DesignRun& result) {
  const Problem& problem = stage.of_filter();
  const Samples& samples = stage.samples;
  if (!check_detectable(stage.problem, own_plant(stage.of_regulator()), result.findings)) result.may_want_digits = true;
  if (!has_error(result.findings)) check_sight_is_no_artefact(stage.problem, result.findings);
  if (!has_error(result.findings) && disturbance_count(stage.problem) > 0)
    result.may_want_digits = !check_disturbances(problem, result.findings) || result.may_want_digits;
  Findings on_limit;
  check_noise_on_limit(problem, samples, on_limit);
  if (on_limit.empty()) check_noise_is_no_artefact(problem, on_limit);
  const bool is_online = problem.estimator->gain == Gain::online;
  for (Finding& finding : on_limit) {
    if (is_online) finding.severity = Severity::note;
    if (is_online) finding.message += "; its gain tends to 0, and the loop has no margins and no steady cost";
    result.findings.push_back(finding);
  }
  return on_limit.empty() && !has_error(result.findings);
}

// What other tools call the Kalman gain of a continuous plant, with its disturbances and without late outputs. Nothing
// here is made of it: where it is not found, it is left out.
void add_continuous_gain(const Problem& problem, const DesignRun* coarser, EstimatorSolution& filter) {
  if (problem.plant.domain == Domain::discrete || problem.estimator->noise == Noise::discrete) return;
  const RealMatrix start =
      coarser && coarser->solution.estimator ? coarser->solution.estimator->P_continuous : RealMatrix();
  const RiccatiResult found = solve_continuous_estimator(problem, start);
  if (found.failure != RiccatiFailure::none) return;
  if (!problem.estimator->recovery) filter.P_continuous = found.X;
  filter.L_continuous = found.K.transpose();
}

// The filter's own P counts noise that is not there.
void take_true_error(const Samples& samples, DesignRun& result) {
  EstimatorSolution& filter = *result.solution.estimator;
  const std::optional<RealMatrix> P = steady_error(samples, filter.L_predictor);
  if (P) return set_error(samples, *P, filter);
  result.may_want_digits = true;
  add_error(result.findings, "kalman.recovery", "the filter's poles are too near to the stability limit");
}

void run_steady_filter(const SampledStage& last, const DesignRun* coarser, DesignRun& result) {
  if (!has_steady_filter(last, result)) return;
  const RiccatiResult found = solve_estimator(last.samples, coarser ? coarser->filter_riccati : RealMatrix());
  explain_estimator(found.failure, result.findings);
  if (found.failure != RiccatiFailure::none) result.may_want_digits = true;
  if (found.failure != RiccatiFailure::none) return;
  take_condition(found, result.solution);
  result.filter_riccati = found.X;
  result.solution.estimator = filter_of(last.samples, found.X);
  result.estimator_poles = poles_of_optimal_filter(last, result.solution.estimator->L_predictor);
  add_continuous_gain(last.of_filter(), coarser, *result.solution.estimator);
  if (last.problem.estimator->recovery) take_true_error(last.samples, result);
  if (last.problem.estimator->structure.size() > 0)
    keep_estimator_structure(last.problem, last.samples, coarser, result);
}

void take_tables(const GainSchedule& schedule, DesignRun& result) {
  result.solution.estimator->L_schedule = schedule.L;
  result.solution.estimator->M_schedule = schedule.M;
}

void run_schedule_to_steady(const Problem& problem, const std::vector<SampledStage>& stages, DesignRun& result) {
  if (stages.size() == 1) check_start(stages.front().of_filter(), stages.front().samples, result.findings);
  if (has_error(result.findings)) return;
  const EstimatorSolution& steady = *result.solution.estimator;
  const int most = most_gains(problem, steady);
  const GainSchedule schedule = gains_until_steady(stages, result.solution.start->P0, steady, problem.code.real, most);
  if (!schedule.is_settled)
    return add_error(result.findings, "kalman.gain",
                     "after " + std::to_string(most) +
                         " samples, all that fit into code.flash, the gains are not the "
                         "steady ones yet: give a horizon, more flash, or use \"online\"");
  take_tables(schedule, result);
}

// The gains of `horizon` samples; the last one is held, whatever that makes of the filter.
void run_finite_schedule(const Problem& problem, const std::vector<SampledStage>& stages, DesignRun& result) {
  const int count = problem.estimator->horizon;
  const GainSchedule schedule = gains_forward(stages, result.solution.start->P0, count);
  result.solution.estimator = schedule.last;
  take_tables(schedule, result);
  result.estimator_poles = poles_of_filter(stage_at(stages, count - 1).samples, schedule.last.L_predictor);
  if (!is_stable(result.estimator_poles))
    add_note(result.findings, "kalman.horizon",
             "the gain that is held at the end is not that of a stable filter: no margins and no steady cost");
}

void run_optimal_filter(const Problem& problem, const std::vector<SampledStage>& stages, const DesignRun* coarser,
                        DesignRun& result) {
  const Gain gain = problem.estimator->gain;
  result.solution.noise = stages.front().samples.noise;
  if (gain == Gain::schedule && problem.estimator->horizon > 0) return run_finite_schedule(problem, stages, result);
  // An extended filter alone is nowhere for long: it has no steady gain.
  if (!problem.estimator->extended || problem.regulator) run_steady_filter(stages.back(), coarser, result);
  if (has_error(result.findings)) return;
  if (gain == Gain::schedule) run_schedule_to_steady(problem, stages, result);
  if (gain == Gain::online)
    result.solution.online = online_filter(*stages.front().of_filter().estimator, stages.front().samples);
}

void run_placed_filter(const Problem& problem, const Samples& samples, const DesignRun* coarser, DesignRun& result) {
  const PlacedGain placed =
      place_observer(problem, samples, coarser ? &*coarser->estimator_choice : nullptr, result.findings);
  result.may_want_digits = result.may_want_digits || placed.may_want_digits;
  if (has_error(result.findings)) return;
  result.estimator_choice = placed.choice;
  result.estimator_poles = placed.poles;
  result.solution.estimator = observer_of(samples.plant, problem.estimator->form, placed.gain);
}

}  // namespace

void run_estimator(const Problem& problem, const std::vector<SampledStage>& stages, const DesignRun* coarser,
                   DesignRun& result) {
  if (has_noise(problem.estimator)) return run_optimal_filter(problem, stages, coarser, result);
  run_placed_filter(problem, stages.back().samples, coarser, result);
}

}  // namespace lqg::design
