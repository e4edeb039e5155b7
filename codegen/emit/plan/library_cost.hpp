// SPDX-License-Identifier: MIT
// What the C library and this library's loops cost a Cortex-M4F, as arm-none-eabi-gcc 12.2 compiles them at -O2.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

// Routines that the compiler calls by itself.
constexpr long bytes_of_memset = 164;
constexpr long bytes_of_memcpy = 308;
constexpr long stack_of_memset = 12;
constexpr long stack_of_double = 20;  // of the deepest of them that compute doubles

// Those that compute doubles: nothing for float.
long bytes_of_software_floats(const Controller& controller, bool divides);

// What limits that are foreseen add to the cost of straight-line code or of the library's loops: the solver with its
// tables, and its memory on the stack.
void add_foresight(const Controller& controller, bool is_in_loops, CodeCost& cost);

// NAME_init of the compact style and all that follows from it.
CodeCost cost_of_loops(const Controller& controller);

}  // namespace lqg::emit
