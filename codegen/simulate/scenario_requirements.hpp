// SPDX-License-Identifier: MIT
// Does the controller do in its scenarios what [require] asks for?
#pragma once

#include "design/finding.hpp"
#include "simulate/scenario_run.hpp"

namespace lqg::simulate {

// Something of [require] is to be measured in `scenario`.
bool is_required_in(const design::Requirements& require, const design::Scenario& scenario);

// An error for each requirement that the run misses.
void check_run(const controller::Controller& controller, const ScenarioRun& run, design::Findings& findings);

// Runs the scenarios that [require] speaks of, seed 1.
void check_scenario_requirements(const controller::Controller& controller, design::Findings& findings);

}  // namespace lqg::simulate
