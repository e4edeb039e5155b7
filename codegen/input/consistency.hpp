// SPDX-License-Identifier: MIT
// What must hold between the keys of a design file.
#pragma once

#include "input/report.hpp"
#include "input/values.hpp"

namespace lqg::input {

// Reports what does not fit together, and what has no effect; makes the symmetric matrices symmetric to the
// last bit.
void check_consistency(Values& values, Report& report);

}  // namespace lqg::input
