// SPDX-License-Identifier: MIT
// Keys that add states to the filter: kalman.disturbance and plant.output_delay.
#pragma once

#include <optional>

#include "input/report.hpp"
#include "input/values.hpp"

namespace lqg::input {

// The size of an input's disturbance that gives none, in the input's unit per √s: 0.1 % of the input's own in a sample.
// Empty where the file says no size of the input.
std::optional<double> default_disturbance(const Values& values, int input);

// What they need beside them, and whether their states are not too many.
void check_added_states(const Values& values, Report& report);

}  // namespace lqg::input
