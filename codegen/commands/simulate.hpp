// SPDX-License-Identifier: MIT
// `lqgen simulate`: a design in its scenarios, many times over, or over a log.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emit/report/scenario_json.hpp"
#include "emit/text/files.hpp"

namespace lqg::commands {

struct SimulateArguments {
  std::vector<std::string> scenarios;  // names; empty: all
  int runs = 0, first = 0;             // of a Monte Carlo; 0: none
  std::uint64_t seed = 1;
  std::string log;          // CSV; empty: none
  bool wants_json = false;  // on standard output, instead of files
};

// How far it is, from 0 to 1.
using SimulateProgress = std::function<void(const std::string& work, double share)>;

// What the arguments ask for, or in `why` what is wrong with them.
std::optional<emit::Simulations> run_simulations(const controller::Controller& controller,
                                                 const SimulateArguments& arguments, const SimulateProgress& progress,
                                                 std::string& why);

// What [require] asks for and the loop, or a single run, misses.
design::Findings missed_requirements(const controller::Controller& controller, const emit::Simulations& simulations);

// NAME_SCENARIO.csv, NAME_SCENARIO_runs.csv, NAME_replay.csv; NAME_simulation.html.
std::vector<emit::File> simulation_files(const controller::Controller& controller,
                                         const emit::Simulations& simulations);

// For people.
std::string simulation_lines(const controller::Controller& controller, const emit::Simulations& simulations);

}  // namespace lqg::commands
