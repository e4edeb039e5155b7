// SPDX-License-Identifier: MIT
// From the plant's own units, in which a design file states what it states, to deviations from the operating point, in
// which everything is designed.
#pragma once

#include "design/finding.hpp"
#include "design/problem.hpp"

namespace lqg::design {

// Of a Problem whose limits, ranges of outputs, initial states and scenarios are in the plant's own units: they become
// deviations. What sensors, actuators and outliers of a scenario do stays in own units. Nothing happens without an
// operating point. Findings: a point beyond its limits, or one that means nothing.
void express_as_deviations(Problem& problem, Findings& findings);

}  // namespace lqg::design
