// SPDX-License-Identifier: MIT
#include "input/exact_value.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "design/exact_matrix.hpp"
#include "design/numeric/digits.hpp"
#include "design/rounding.hpp"
#include "expression/evaluate.hpp"
#include "input/values.hpp"

namespace lqg::input {
namespace {

using design::Real;
using expression::Operation;

constexpr unsigned few_digits = 120;
constexpr unsigned many_digits = design::exact_digits + 50;
constexpr unsigned most_digits = many_digits + 150;
const char* const agreement = "1e-40";

// What lies beyond, sin and its kind would have to reduce with as many digits.
constexpr long largest_exponent = 16384;  // of 2

std::string in_words(const Real& x) { return shown(design::to_double(x)); }

// "1/0", "sqrt(-1)", "(-8)^0.5".
std::string written(const expression::Node& node, const Real& a, const Real* b) {
  const std::string name = expression::name_of(node.operation);
  if (b == nullptr) return name + "(" + in_words(a) + ")";
  if (expression::function_of(name)) return name + "(" + in_words(a) + ", " + in_words(*b) + ")";
  return (a < 0 ? "(" + in_words(a) + ")" : in_words(a)) + name + in_words(*b);
}

bool is_in_range(const Real& x) {
  return mpfr_number_p(x.backend().data()) != 0 &&
         (mpfr_zero_p(x.backend().data()) != 0 || mpfr_get_exp(x.backend().data()) <= largest_exponent);
}

void check_result(const expression::Node& node, const Real& result, const Real& a, const Real* b) {
  if (is_in_range(result)) return;
  const bool is_number = mpfr_nan_p(result.backend().data()) == 0;
  const bool divides_by_0 = (node.operation == Operation::divide && *b == 0) ||
                            (node.operation == Operation::power && a == 0 && *b < 0) ||
                            (node.operation == Operation::log && a == 0);
  throw expression::Fault{
      node.at, written(node, a, b) + (!is_number || divides_by_0 ? " is no finite number" : " is too large")};
}

bool agree(const Real& a, const Real& b) { return abs(a - b) <= abs(b) * Real(agreement); }

std::variant<Real, expression::Fault> checked(const expression::Node& node, const Real& value) {
  const double rounded = design::to_double(value);
  if (std::isinf(rounded)) return expression::Fault{node.at, "its value is beyond what a double can be"};
  if (rounded == 0 && value != 0)
    return expression::Fault{node.at, "its value is not 0, but nearer to it than a double can be"};
  return value;
}

}  // namespace

Real ValuesInDigits::value(const expression::Node& node) {
  switch (node.kind) {
    case expression::Node::Kind::number: return Real(node.number);
    case expression::Node::Kind::pi: return acos(Real(-1));
    case expression::Node::Kind::parameter: return parameter(*node.operands[0]);
    case expression::Node::Kind::operation: return result(node);
    default: throw expression::Fault{node.at, "expected numbers and parameters, found " + node.name};
  }
}

Real ValuesInDigits::parameter(const expression::Node& value_of_it) {
  const auto known = parameters_.find(&value_of_it);
  if (known != parameters_.end()) return known->second;
  const Real computed = value(value_of_it);
  parameters_.emplace(&value_of_it, computed);
  return computed;
}

Real ValuesInDigits::result(const expression::Node& node) {
  const Real a = value(*node.operands[0]);
  if (node.operands.size() == 1) {
    const Real made = expression::value_of<Real>(node.operation, a);
    check_result(node, made, a, nullptr);
    return made;
  }
  const Real b = value(*node.operands[1]);
  const std::optional<int> exponent =
      node.operation == Operation::power ? expression::whole_exponent(*node.operands[1]) : std::nullopt;
  const Real made = exponent ? expression::whole_power(a, *exponent) : expression::value_of<Real>(node.operation, a, b);
  check_result(node, made, a, &b);
  return made;
}

std::variant<Real, expression::Fault> ValuesInDigits::operator()(const expression::Node& node) {
  const design::Digits scope(digits_);
  try {
    return value(node);
  } catch (const expression::Fault& fault) {
    return fault;
  }
}

ExactValues::ExactValues() : few_(few_digits), many_(many_digits), most_(most_digits) {}

std::variant<Real, expression::Fault> ExactValues::operator()(const expression::Node& node) {
  const auto few = few_(node), many = many_(node);
  for (const auto* one : {&few, &many})
    if (const expression::Fault* fault = std::get_if<expression::Fault>(one)) return *fault;
  const design::Digits scope(most_digits);
  const Real& value = std::get<Real>(many);
  if (agree(std::get<Real>(few), value)) return checked(node, value);
  const auto most = most_(node);
  if (const expression::Fault* fault = std::get_if<expression::Fault>(&most)) return *fault;
  const Real& better = std::get<Real>(most);
  if (agree(value, better)) return checked(node, better);
  if (abs(better) < abs(value)) return Real(0);
  return expression::Fault{node.at, "its value hangs on a part that is 0, whatever digits it is computed with"};
}

}  // namespace lqg::input
