// SPDX-License-Identifier: MIT
#include <cmath>

#include "design/checks/well_posed.hpp"
#include "design/sampled/added_states.hpp"

namespace lqg::design {

namespace {

void check_discrete_plant(const Problem& problem, Findings& findings) {
  const std::string expected = "expected \"discrete\": the plant is given at its samples only";
  if (has_cost(problem.regulator) && problem.regulator->cost != Cost::discrete)
    add_error(findings, "lqr.cost", expected);
  if (has_noise(problem.estimator) && problem.estimator->noise != Noise::discrete)
    add_error(findings, "kalman.noise", expected);
  if (!delay_of(problem.plant).is_whole)
    add_error(findings, "plant.delay", "expected whole periods: the plant is given at its samples only");
}

void check_continuous_cost(const Problem& problem, Findings& findings) {
  if (problem.plant.delay > 0)
    add_error(findings, "lqr.cost",
              "the continuous Riccati equation knows no delay: expected \"sampled\" or \"discrete\"");
  if (problem.regulator->input_rate.size() > 0)
    add_error(findings, "lqr.input_rate",
              "a continuous trajectory has no Δu: expected cost = \"sampled\" or \"discrete\"");
}

void check_steps(int count, const std::string& key, Findings& findings) {
  if (count > most_steps)
    add_error(findings, key,
              "expected at most " + std::to_string(most_steps) + " samples, found " + std::to_string(count));
}

// Where the gain is one number for ever, the problem must be one, too.
void check_gains_and_stages(const Problem& problem, Findings& findings) {
  bool changes_plant = false, changes_filter = false;
  for (const Stage& stage : problem.stages) {
    changes_plant = changes_plant || stage.A.size() + stage.B.size() + stage.C.size() + stage.D.size() > 0;
    changes_filter =
        changes_filter || stage.A.size() + stage.C.size() + stage.G.size() > 0 || stage.W.size() + stage.V.size() > 0;
  }
  const int end = problem.stages.empty() ? 0 : problem.stages.back().from;
  const auto is_over = [&](int horizon) { return horizon > 0 && end >= horizon; };
  if ((has_cost(problem.regulator) && is_over(problem.regulator->horizon)) ||
      (has_noise(problem.estimator) && is_over(problem.estimator->horizon)))
    add_error(findings, "stage",
              "a stage begins at step " + std::to_string(end) + ", when the horizon is over and its last gain is held");
  if (has_noise(problem.estimator) && problem.estimator->gain == Gain::steady && changes_filter)
    add_error(findings, "kalman.gain", "stages change the filter: expected \"schedule\" or \"online\"");
  if (changes_plant && problem.regulator && !problem.regulator->track.empty())
    add_error(findings, "lqr.track", "stages change the plant: r has no one set point");
  if (changes_plant && problem.regulator && problem.regulator->poles)
    add_error(findings, "pole_placement", "stages change the plant: one gain has these poles for one plant only");
  if (changes_plant && problem.estimator && problem.estimator->poles)
    add_error(findings, "observer", "stages change the plant: one gain has these poles for one plant only");
}

void check_correlation_times(const Estimator& kalman, Findings& findings) {
  const bool of_process = kalman.process_correlation_time.size() > 0;
  const bool of_measurement = kalman.measurement_correlation_time.size() > 0;
  const std::string key = of_process ? "kalman.process_correlation_time" : "kalman.measurement_correlation_time";
  if (!of_process && !of_measurement) return;
  if (kalman.noise == Noise::discrete)
    add_error(findings, key, "expected noise = \"continuous\": samples have no correlation time");
  if (of_process != of_measurement && !kalman.Swv.isZero(0))
    add_error(findings, "kalman.cross_noise",
              "needs both correlation times or none: it cannot be half a covariance and half a density");
}

void check_disturbances_stated(const Problem& problem, Findings& findings) {
  const std::string key = "kalman.disturbance";
  std::vector<bool> seen(static_cast<std::size_t>(problem.plant.B.cols()), false);
  for (const InputDisturbance& disturbance : problem.estimator->disturbance) {
    const std::size_t input = static_cast<std::size_t>(disturbance.input);
    if (disturbance.input < 0 || input >= seen.size() || seen[input])
      return add_error(findings, key, "expected inputs, each one once");
    if (!(disturbance.size > 0)) add_error(findings, key, "expected sizes > 0");
    seen[input] = true;
  }
}

std::string name_of_output(const Plant& plant, Index i) {
  const std::size_t at = static_cast<std::size_t>(i);
  return at < plant.outputs.size() ? plant.outputs[at].name : "y" + std::to_string(i);
}

bool has_feedthrough(const Problem& problem, Index output) {
  bool any = !problem.plant.D.row(output).isZero(0);
  for (const Stage& stage : problem.stages) any = any || (stage.D.size() > 0 && !stage.D.row(output).isZero(0));
  return any;
}

// What of a late output the filter cannot be told by states alone.
void check_late_output(const Problem& problem, Index i, Findings& findings) {
  const Plant& plant = problem.plant;
  const Estimator& kalman = *problem.estimator;
  const std::string key = "plant.output_delay", late = "output " + name_of_output(plant, i) + " is late: ";
  if (kalman.form == Form::filter && !(plant.delay > 0) && has_feedthrough(problem, i))
    add_error(findings, key,
              late +
                  "in filter form it is measured while the last u acts, which plant.D makes part of it: expected "
                  "kalman.form = \"predictor\"");
  if (!plant.H.row(i).isZero(0))
    add_error(findings, key, late + "expected zeros in its row of plant.H, as its noise is that of its arrival");
  if (!kalman.Swv.col(i).isZero(0))
    add_error(findings, key,
              late + "expected zeros in its column of kalman.cross_noise, as its noise is that of its arrival");
  if (!problem.regulator || !problem.regulator->integral) return;
  for (const int output : problem.regulator->integral->outputs)
    if (output == i)
      add_error(findings, "lqr.integral.outputs",
                late +
                    "its integral would run behind the law; expected kalman.disturbance, which takes steady errors "
                    "away by the filter, or another output");
}

void check_late_outputs(const Problem& problem, Findings& findings) {
  const Plant& plant = problem.plant;
  const std::string key = "plant.output_delay";
  if (plant.output_delay.size() == 0 || plant.output_delay.isZero(0)) return;
  if (!has_noise(problem.estimator))
    return add_error(findings, key, "needs [kalman]: only the filter knows late outputs");
  for (Index i = 0; i < plant.output_delay.size(); ++i) {
    const double periods = plant.output_delay(i) / plant.sample_time;
    if (periods < 0 || std::abs(periods - std::round(periods)) > 1e-9 * periods)
      add_error(findings, key, "expected whole periods of the sample time for output " + name_of_output(plant, i));
    if (periods > 0) check_late_output(problem, i, findings);
  }
}

void check_added_states(const Problem& problem, Findings& findings) {
  if (has_noise(problem.estimator)) check_disturbances_stated(problem, findings);
  check_late_outputs(problem, findings);
  if (!has_error(findings) && has_added_states(problem) && problem.estimator->structure.size() > 0)
    add_error(findings, "kalman.structure",
              "says nothing of disturbances and late outputs, which are states, too: expected neither of them");
}

}  // namespace

void check_kinds(const Problem& problem, Findings& findings) {
  if (problem.plant.domain == Domain::discrete) check_discrete_plant(problem, findings);
  if (has_cost(problem.regulator) && problem.regulator->cost == Cost::continuous)
    check_continuous_cost(problem, findings);
  check_gains_and_stages(problem, findings);
  if (has_cost(problem.regulator)) check_steps(problem.regulator->horizon, "lqr.horizon", findings);
  if (has_noise(problem.estimator)) check_steps(problem.estimator->horizon, "kalman.horizon", findings);
  if (!problem.stages.empty()) check_steps(problem.stages.back().from, "stage", findings);
  if (has_noise(problem.estimator)) check_correlation_times(*problem.estimator, findings);
  check_added_states(problem, findings);
}

}  // namespace lqg::design
