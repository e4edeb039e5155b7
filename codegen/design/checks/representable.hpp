// SPDX-License-Identifier: MIT
// Do the numbers of a design fit into those of the target, and of the report?
#pragma once

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// An entry that overflows is an error, one that becomes zero a note; but a variance that is divided by must
// not vanish. Of the target's numbers that is asked in `real`, of all others in double.
void check_representable(const Solution& solution, Scalar real, Findings& findings);

}  // namespace lqg::design
