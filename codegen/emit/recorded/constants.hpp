// SPDX-License-Identifier: MIT
// Numbers of the code that are no gains: limits, bounds, thresholds. C knows each by a name, whose #define says where
// it comes from.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"
#include "step/model.hpp"
#include "trace/expr.hpp"

namespace lqg::emit {

// "SERVO_U_MAX_VOLTAGE" of input 0; "SERVO_GATE_SQUARED" where i is −1.
std::string constant_name(const Controller& controller, step::Quantity quantity, int i);

// "TWO_TO_82", without the design's name.
std::string name_of_power(int exponent);

// The value with that name, where it is a finite number.
trace::Expr named(const Controller& controller, const trace::Expr& value, step::Quantity quantity, int i = -1);

// A #define: a name, its value in C, and where that comes from ("N, limits.u_max = 0.27, rounded inwards").
struct Constant {
  std::string name, value, origin;
};

// Those that a text in C uses, in the order in which a reader looks for them. Limits of u and y are always there.
std::vector<Constant> constants_of(const Controller& controller, const std::string& text);

}  // namespace lqg::emit

namespace lqg::step {

// "SERVO_TWO_TO_82"
template <>
struct PowerOfTwo<trace::Expr> {
  static trace::Expr of(int exponent);
};

}  // namespace lqg::step
