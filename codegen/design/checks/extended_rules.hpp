// SPDX-License-Identifier: MIT
// What goes together with an extended Kalman filter.
#pragma once

#include "design/finding.hpp"
#include "design/problem.hpp"

namespace lqg::design {

void check_extended(const Problem& problem, Findings& findings);

}  // namespace lqg::design
