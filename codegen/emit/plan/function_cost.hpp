// SPDX-License-Identifier: MIT
// What the functions of lqg/functions.h cost that straight-line code calls.
#pragma once

#include <vector>

#include "emit/recorded/traced.hpp"

namespace lqg::emit {

struct CostOfFunctions {
  long flash = 0, stack = 0;  // bytes, by arm-none-eabi-gcc 12.2 at -O2 for a Cortex-M4F
};

// Each function that one of these calls, once.
CostOfFunctions cost_of_functions(const std::vector<const TracedFunction*>& callers, bool is_double);

}  // namespace lqg::emit
