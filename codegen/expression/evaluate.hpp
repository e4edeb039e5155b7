// SPDX-License-Identifier: MIT
// The value of a bound formula over any scalar.
#pragma once

#include <map>
#include <optional>
#include <stdexcept>

#include "expression/scalar.hpp"
#include "expression/tree.hpp"

namespace lqg::expression {

// x^n of products: x² = x x, x³ = x² x, x⁴ = x² x², …
template <class S>
S whole_power(const S& x, int n) {
  if (n < 0) return S(1) / whole_power(x, -n);
  if (n == 0) return S(1);
  if (n == 1) return x;
  const S half = whole_power(x, n / 2);
  const S square = half * half;
  return n % 2 ? S(square * x) : square;
}

template <class S>
S value_of(Operation operation, const S& a) {
  switch (operation) {
    case Operation::negate: return -a;
    case Operation::sqrt: return sqrt(a);
    case Operation::sin: return sin(a);
    case Operation::cos: return cos(a);
    case Operation::tan: return tan(a);
    case Operation::asin: return asin(a);
    case Operation::acos: return acos(a);
    case Operation::atan: return atan(a);
    case Operation::exp: return exp(a);
    case Operation::log: return log(a);
    case Operation::tanh: return tanh(a);
    case Operation::abs: return abs(a);
    default: throw std::logic_error("an operation of two operands has one");
  }
}

template <class S>
S value_of(Operation operation, const S& a, const S& b) {
  switch (operation) {
    case Operation::add: return a + b;
    case Operation::subtract: return a - b;
    case Operation::multiply: return a * b;
    case Operation::divide: return a / b;
    case Operation::power: return power(a, b);
    case Operation::atan2: return atan2(a, b);
    case Operation::min: return minimum(a, b);
    case Operation::max: return maximum(a, b);
    default: throw std::logic_error("an operation of one operand has two");
  }
}

// `variable(index)` is the value of a variable; `constant(node)` that of a largest part without one: made with many
// digits and rounded once, say.
template <class S, class Variable, class Constant>
S evaluate(const Node& node, const Variable& variable, Constant&& constant) {
  if (node.is_constant) return constant(node);
  if (node.kind == Node::Kind::variable) return variable(node.index);
  if (node.kind != Node::Kind::operation) throw std::logic_error("the name " + node.name + " is not bound");
  const auto operand = [&](std::size_t i) -> S { return evaluate<S>(*node.operands[i], variable, constant); };
  if (node.operands.size() == 1) return value_of<S>(node.operation, operand(0));
  if (node.operation == Operation::power)
    if (const std::optional<int> exponent = whole_exponent(*node.operands[1]))
      return whole_power(operand(0), *exponent);
  const S first = operand(0);
  return value_of<S>(node.operation, first, operand(1));
}

// Values of formulas without variables, over a scalar of numbers that is exact for a double. Each parameter is computed
// once, however often it is named.
template <class S>
class Constants {
 public:
  S operator()(const Node& node) {
    switch (node.kind) {
      case Node::Kind::number: return S(node.number);
      case Node::Kind::pi: return acos(S(-1));
      case Node::Kind::parameter: return parameter(*node.operands[0]);
      case Node::Kind::operation: return result(node);
      default: throw std::logic_error("the formula has a variable");
    }
  }

 private:
  S parameter(const Node& value) {
    const auto known = parameters_.find(&value);
    if (known != parameters_.end()) return known->second;
    const S computed = (*this)(value);
    parameters_.emplace(&value, computed);
    return computed;
  }
  S result(const Node& node) {
    const S first = (*this)(*node.operands[0]);
    if (node.operands.size() == 1) return value_of<S>(node.operation, first);
    if (node.operation == Operation::power)
      if (const std::optional<int> exponent = whole_exponent(*node.operands[1])) return whole_power(first, *exponent);
    return value_of<S>(node.operation, first, (*this)(*node.operands[1]));
  }

  std::map<const Node*, S> parameters_;
};

}  // namespace lqg::expression
