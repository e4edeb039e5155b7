// SPDX-License-Identifier: MIT
// The problem that a file without errors states, with the defaults of what it leaves out.
#pragma once

#include "design/problem.hpp"
#include "input/values.hpp"

namespace lqg::input {

design::Problem assemble(const Values& values);

}  // namespace lqg::input
