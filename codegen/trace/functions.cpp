// SPDX-License-Identifier: MIT
#include "trace/functions.hpp"

#include <stdexcept>

#include "lqg/functions.h"

namespace lqg::trace {

namespace {

struct Function {
  Op op;
  const char* name;
  int multiply_adds;
};

constexpr Function functions[] = {{Op::square_root, "sqrt", 1},
                                  {Op::sine, "sin", 13},
                                  {Op::cosine, "cos", 13},
                                  {Op::tangent, "tan", 22},
                                  {Op::arcsine, "asin", 16},
                                  {Op::arccosine, "acos", 16},
                                  {Op::arctangent, "atan", 14},
                                  {Op::arctangent_of_two, "atan2", 16},
                                  {Op::exponential, "exp", 12},
                                  {Op::logarithm, "log", 14},
                                  {Op::hyperbolic_tangent, "tanh", 16},
                                  {Op::wrapped, "wrap", 4}};

const Function* find(Op op) {
  for (const Function& function : functions)
    if (function.op == op) return &function;
  return nullptr;
}

const Function& at(Op op) {
  const Function* const found = find(op);
  if (!found) throw std::logic_error("an operation that is no function");
  return *found;
}

}  // namespace

bool is_function(Op op) { return find(op) != nullptr; }

const char* name_of_function(Op function) { return at(function).name; }

int multiply_adds_of(Op function) { return at(function).multiply_adds; }

std::string call_of(Op function, const std::string& arguments, bool is_double) {
  return std::string("lqg_") + at(function).name + (is_double ? "(" : "f(") + arguments + ")";
}

float value_of_function(Op function, float a, float b) {
  switch (function) {
    case Op::square_root: return lqg_sqrtf(a);
    case Op::sine: return lqg_sinf(a);
    case Op::cosine: return lqg_cosf(a);
    case Op::tangent: return lqg_tanf(a);
    case Op::arcsine: return lqg_asinf(a);
    case Op::arccosine: return lqg_acosf(a);
    case Op::arctangent: return lqg_atanf(a);
    case Op::arctangent_of_two: return lqg_atan2f(a, b);
    case Op::exponential: return lqg_expf(a);
    case Op::logarithm: return lqg_logf(a);
    case Op::hyperbolic_tangent: return lqg_tanhf(a);
    default: return lqg_wrapf(a);
  }
}

double value_of_function(Op function, double a, double b) {
  switch (function) {
    case Op::square_root: return lqg_sqrt(a);
    case Op::sine: return lqg_sin(a);
    case Op::cosine: return lqg_cos(a);
    case Op::tangent: return lqg_tan(a);
    case Op::arcsine: return lqg_asin(a);
    case Op::arccosine: return lqg_acos(a);
    case Op::arctangent: return lqg_atan(a);
    case Op::arctangent_of_two: return lqg_atan2(a, b);
    case Op::exponential: return lqg_exp(a);
    case Op::logarithm: return lqg_log(a);
    case Op::hyperbolic_tangent: return lqg_tanh(a);
    default: return lqg_wrap(a);
  }
}

}  // namespace lqg::trace
