// SPDX-License-Identifier: MIT
// What straight-line code costs a Cortex-M4F, as arm-none-eabi-gcc 12.2 compiles it at -O2.
#pragma once

#include "emit/plan/registers.hpp"

namespace lqg::emit {

struct FunctionCost {
  long flash = 0;  // bytes of code and the constants behind it
  long stack = 0;  // bytes of its own frame
};

// The FPU computes floats in 32 registers.
FunctionCost cost_in_float(const Listing& listing);

// The C library computes doubles: each operation is a call.
FunctionCost cost_in_double(const Listing& listing);

// A step that is one text of what these calls do one by one.
FunctionCost cost_of_step(const Listing& step, const std::vector<Listing>& calls, bool is_double);

}  // namespace lqg::emit
