// SPDX-License-Identifier: MIT
// A run of a scenario as a part of the page.
#pragma once

#include "emit/controller.hpp"
#include "emit/page/page.hpp"
#include "simulate/scenario_run.hpp"

namespace lqg::emit {

// A scenario with what the controller did in it.
struct ShownRun {
  design::Scenario scenario;
  simulate::ScenarioRun run;
};

// Those of the design, or the usual ones.
std::vector<ShownRun> runs_to_show(const Controller& controller);

// Outputs with their reference and the limits of the sensor; inputs with their limits; states with estimate and ±3σ;
// the numbers that decide. Of these charts those in which nothing happens are left out.
PageView scenario_view(const Controller& controller, const ShownRun& shown);

// The numbers alone.
std::vector<PageTable> number_tables(const Controller& controller, const simulate::ScenarioRun& run);

}  // namespace lqg::emit
