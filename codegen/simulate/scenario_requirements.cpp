// SPDX-License-Identifier: MIT
#include "simulate/scenario_requirements.hpp"

namespace lqg::simulate {

namespace {

using controller::Controller;
using design::Findings;
using design::Requirements;
using design::RmsRequirement;

// One run and what is said of it.
struct Judge {
  const Controller& controller;
  const ScenarioRun& run;
  Findings& findings;

  void miss(const char* key, double most, double found, const std::string& what) {
    design::add_error(findings, key,
                      design::compared("at most", most, found, "", "scenario \"" + run.name + "\": " + what));
  }
  void most(const char* key, const std::optional<double>& most, double found, const std::string& what) {
    if (most && !(found <= *most)) miss(key, *most, found, what);
  }
  std::string output(int i) const { return controller.problem.plant.outputs[static_cast<std::size_t>(i)].name; }
};

void check_answers(const Requirements& require, Judge& judge) {
  for (const StepAnswer& answer : judge.run.numbers.answers) {
    const std::string which = judge.output(answer.output);
    judge.most("require.overshoot", require.overshoot, answer.overshoot, "the overshoot of " + which + " is");
    if (require.settling_time && !answer.settling_time)
      design::add_error(judge.findings, "require.settling_time",
                        "scenario \"" + judge.run.name + "\": " + which + " does not settle to 2 % of its step");
    else if (answer.settling_time)
      judge.most("require.settling_time", require.settling_time, *answer.settling_time,
                 "the settling time of " + which + " is");
  }
  if (judge.run.numbers.answers.empty() && (require.overshoot || require.settling_time))
    design::add_error(judge.findings, require.overshoot ? "require.overshoot" : "require.settling_time",
                      "scenario \"" + judge.run.name + "\" has no step of a reference to measure it by");
}

void check_rms(const RmsRequirement& rms, std::size_t index, Judge& judge) {
  using Of = RmsRequirement::Of;
  const ScenarioNumbers& numbers = judge.run.numbers;
  const design::Plant& plant = judge.controller.problem.plant;
  const std::vector<double>& values = rms.of == Of::state   ? numbers.rms_x
                                      : rms.of == Of::input ? numbers.rms_u
                                                            : numbers.rms_y;
  const std::vector<design::Signal>& signals = rms.of == Of::state   ? plant.states
                                               : rms.of == Of::input ? plant.inputs
                                                                     : plant.outputs;
  const std::size_t i = static_cast<std::size_t>(rms.signal);
  const std::string key = "require.rms[" + std::to_string(index) + "].value";
  judge.most(key.c_str(), rms.most, values[i], "the rms of " + signals[i].name + " is");
}

}  // namespace

bool is_required_in(const Requirements& require, const design::Scenario& scenario) {
  const bool asks = require.overshoot || require.settling_time || require.share_at_limits || !require.rms.empty();
  return asks && (require.scenario.empty() || require.scenario == scenario.name);
}

void check_run(const Controller& controller, const ScenarioRun& run, Findings& findings) {
  const Requirements& require = controller.problem.requirements;
  Judge judge = {controller, run, findings};
  if (run.numbers.has_diverged)
    return design::add_error(findings, "require",
                             "scenario \"" + run.name + "\": the loop is lost " +
                                 design::decimal(run.times.size() * controller.problem.plant.sample_time) +
                                 " s after its start");
  check_answers(require, judge);
  for (const double share : run.numbers.share_at_limits)
    judge.most("require.share_at_limits", require.share_at_limits, share, "the share of samples at a limit is");
  for (std::size_t i = 0; i < require.rms.size(); ++i) check_rms(require.rms[i], i, judge);
}

void check_scenario_requirements(const Controller& controller, Findings& findings) {
  for (const design::Scenario& scenario : controller.problem.scenarios)
    if (is_required_in(controller.problem.requirements, scenario))
      check_run(controller, run_scenario(controller, scenario), findings);
}

}  // namespace lqg::simulate
