// SPDX-License-Identifier: MIT
// What goes together with a compensator of a given order, and with white parameters.
#pragma once

#include "design/finding.hpp"
#include "design/problem.hpp"

namespace lqg::design {

void check_order_and_white(const Problem& problem, Findings& findings);

}  // namespace lqg::design
