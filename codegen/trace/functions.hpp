// SPDX-License-Identifier: MIT
// The functions of lqg/functions.h as operations of a graph.
#pragma once

#include "trace/graph.hpp"

namespace lqg::trace {

bool is_function(Op op);

// "sin"
const char* name_of_function(Op function);

// As the target computes it.
float value_of_function(Op function, float a, float b);
double value_of_function(Op function, double a, double b);

// "lqg_sinf(angle)"
std::string call_of(Op function, const std::string& arguments, bool is_double);

// What one call costs in multiply-adds, about: of the polynomials, of what reduces the argument, and of a division as
// one. Both of a sine and a cosine are one call, which costs as much as one and a half.
int multiply_adds_of(Op function);

}  // namespace lqg::trace
