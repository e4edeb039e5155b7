// SPDX-License-Identifier: MIT
// What the design file requires of the closed loop.
#pragma once

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// An error under "require.…" with both numbers for each one that the loop misses: margins at the plant's inputs
// (a margin that no factor or angle exhausts is met), the largest |z| of all poles.
void check_requirements(const Problem& problem, const Solution& solution, Findings& findings);

}  // namespace lqg::design
