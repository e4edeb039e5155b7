// SPDX-License-Identifier: MIT
// The problem that a file without errors states, with the defaults of what it leaves out.
#pragma once

#include "design/problem.hpp"
#include "input/values.hpp"

namespace lqg::input {

design::Problem assemble(const Values& values);

// Where the file does not say in which state the filter begins, it begins there.
void begin_at_operating_point(const Values& values, design::Problem& problem);

}  // namespace lqg::input
