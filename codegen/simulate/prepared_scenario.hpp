// SPDX-License-Identifier: MIT
// A scenario with all that its runs have in common.
#pragma once

#include <functional>

#include "simulate/scenario_run.hpp"
#include "simulate/truth_model.hpp"

namespace lqg::simulate {

struct PreparedScenario {
  // `instants`: how many in a period are kept; 1: the samples alone. The controller has to outlive it.
  PreparedScenario(const controller::Controller& controller, design::Scenario scenario, int instants);
  PreparedScenario(const PreparedScenario&) = delete;
  PreparedScenario& operator=(const PreparedScenario&) = delete;

  const controller::Controller& controller;
  const design::Scenario scenario;
  const Courses courses;
  const TruthModel truth;
};

// The emitted controller, set up once for any number of runs, one at a time.
class ScenarioRunner {
 public:
  explicit ScenarioRunner(const PreparedScenario& prepared);
  // Of `truth`, the scenario's own or one with other entries, from x0 on.
  ScenarioRun run(const TruthModel& truth, const Eigen::VectorXd& x0, std::uint64_t seed);

 private:
  const PreparedScenario& prepared_;
  std::function<void(const TruthModel&, const Eigen::VectorXd&, std::uint64_t, ScenarioRun&)> run_;
};

}  // namespace lqg::simulate
