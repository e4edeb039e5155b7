// SPDX-License-Identifier: MIT
// Instructions of an ordinary sample in straight-line code, core by core: every output is as expected, no input is at a
// limit, nothing begins anew.
#pragma once

#include <vector>

#include "controller/controller.hpp"
#include "emit/plan/registers.hpp"

namespace lqg::emit {

// Estimates, nearly all within 15 %, of the code that GCC 12.2 makes at -O2, library functions included. In the order
// of the cores; those without the instruction are left out where a listing has fused multiply-adds.
std::vector<controller::CoreInstructions> instructions_of(const Listing& listing, bool is_double);

}  // namespace lqg::emit
