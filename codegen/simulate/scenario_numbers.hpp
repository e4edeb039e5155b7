// SPDX-License-Identifier: MIT
// The numbers that decide, of a run that has been made.
#pragma once

#include "simulate/prepared_scenario.hpp"

namespace lqg::simulate {

// Fills in run.numbers but for what the controller counts itself.
void count_numbers(const PreparedScenario& prepared, ScenarioRun& run);

}  // namespace lqg::simulate
