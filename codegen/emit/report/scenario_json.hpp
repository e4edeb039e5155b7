// SPDX-License-Identifier: MIT
// Runs of scenarios for other programs, every number so that it reads back exactly; what is not finite is null.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"
#include "simulate/monte_carlo.hpp"
#include "simulate/replay.hpp"
#include "simulate/scenario_run.hpp"

namespace lqg::emit {

// All that was simulated of one controller.
struct Simulations {
  std::vector<design::Scenario> scenarios;  // of the runs, or of the Monte Carlos
  std::vector<simulate::ScenarioRun> runs;
  std::uint64_t seed = 1;  // of the runs
  std::vector<simulate::MonteCarlo> monte_carlo;
  bool wants_each_run = false;  // the numbers and sums of each Monte Carlo run, not only of all
  std::optional<simulate::ReplayRun> replay;
};

std::string simulations_json(const Controller& controller, const Simulations& simulations);

}  // namespace lqg::emit
