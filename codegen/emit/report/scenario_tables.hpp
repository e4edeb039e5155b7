// SPDX-License-Identifier: MIT
// Runs of scenarios as tables: CSV for other programs, lines for people.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"
#include "simulate/monte_carlo.hpp"
#include "simulate/replay.hpp"
#include "simulate/scenario_run.hpp"

namespace lqg::emit {

// What of the numbers of a run is one number, with a name that no other has; infinite where something is not reached.
struct NamedNumber {
  std::string name;
  double value;
};
std::vector<NamedNumber> named_numbers(const Controller& controller, const simulate::ScenarioNumbers& numbers);

// "output_gated"
std::string event_name(step::Event event);
// The names of the bits of `events`, of the outputs that were rejected too: "output_rejected_2".
std::vector<std::string> event_names(unsigned events);

// A line for each sample: t, r_, y_, u_, x_, estimate_, sigma_, innovation_ of each signal, nis, nees, and the events
// with | between them. Numbers read back exactly; what is missing is empty.
std::string csv(const Controller& controller, const simulate::ScenarioRun& run);
// Likewise: t, y_, u_, law_, estimate_, sigma_, innovation_, nis, events.
std::string csv(const Controller& controller, const simulate::ReplayRun& run);
// A line for each run: its number, whether it failed, and its numbers.
std::string csv(const Controller& controller, const simulate::MonteCarlo& result);

// The numbers that decide, in aligned columns.
std::string lines(const Controller& controller, const simulate::ScenarioRun& run);
std::string lines(const Controller& controller, const simulate::MonteCarlo& result);
std::string lines(const Controller& controller, const simulate::ReplayRun& run);

// "step with load" as a part of a file's name: "step_with_load".
std::string in_file_name(const std::string& scenario);

}  // namespace lqg::emit
