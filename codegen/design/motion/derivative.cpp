// SPDX-License-Identifier: MIT
#include "design/motion/derivative.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "expression/evaluate.hpp"

namespace lqg::design {

namespace {

using expression::Node;
using expression::Operation;

// Nothing but rounding beside numbers of size 1 and of that size: no number of a plant is as small.
bool is_nothing(const Real& x, const Real& size = Real(0)) { return abs(x) <= negligible(0.5) * (1 + abs(size)); }

// What is larger is no plant's, and could take sin for ever.
constexpr double largest_value = 1e308;

// Two branches of equal value.
bool is_tie(Operation operation, const std::vector<Slope>& operands) {
  if (operation == Operation::abs) return is_nothing(operands[0].value);
  if (operation != Operation::min && operation != Operation::max) return false;
  return is_nothing(operands[0].value - operands[1].value, operands[0].value);
}

// What keeps an operation from having a value, or a finite slope, there; empty: nothing.
std::string obstacle(Operation operation, const std::vector<Slope>& operands) {
  const Real& a = operands[0].value;
  switch (operation) {
    case Operation::divide: return is_nothing(operands[1].value) ? "division by 0" : "";
    case Operation::sqrt:
      if (is_nothing(a)) return "sqrt has no slope at 0";
      return a < 0 ? "sqrt of a negative number" : "";
    case Operation::log: return is_nothing(a) || a < 0 ? "log of a number that is not positive" : "";
    case Operation::asin:
    case Operation::acos:
      if (is_nothing(abs(a) - 1)) return std::string(expression::name_of(operation)) + " has no slope at ±1";
      return abs(a) > 1 ? std::string(expression::name_of(operation)) + " of a number beyond ±1" : "";
    case Operation::tan: return is_nothing(cos(a)) ? "tan is infinite" : "";
    case Operation::power: return is_nothing(a) || a < 0 ? "a power that is no whole number, of one ≤ 0" : "";
    case Operation::atan2: {
      const Real& x = operands[1].value;
      if (is_nothing(a) && is_nothing(x)) return "atan2(0, 0)";
      return is_nothing(a) && x < 0 ? "atan2 jumps at π" : "";
    }
    default: return "";
  }
}

// One walk over a formula.
class SlopeWalk {
 public:
  // At the tie `other_side`, if there is one, the other branch is taken.
  SlopeWalk(const RealVector& point, const Node* other_side) : point_(point), other_side_(other_side) {}

  Slope walk(const Node& node) {
    if (fault_) return Slope(Real(1));
    const Slope slope = slope_there(node);
    if (!fault_ && !(abs(slope.value) < largest_value)) refuse(node, "a value beyond what a double can be");
    return slope;
  }
  const std::optional<NoSlope>& fault() const { return fault_; }
  const std::vector<const Node*>& ties() const { return ties_; }

 private:
  Slope slope_there(const Node& node) {
    if (node.is_constant) return constant(node);
    if (node.kind == Node::Kind::variable)
      return Slope::variable(point_(node.index), node.index, static_cast<int>(point_.size()));
    if (node.operation == Operation::power)
      if (const std::optional<int> exponent = expression::whole_exponent(*node.operands[1]))
        return whole_power(node, *exponent);
    std::vector<Slope> operands;
    for (const expression::Tree& operand : node.operands) operands.push_back(walk(*operand));
    if (!fault_) refuse(node, obstacle(node.operation, operands));
    if (fault_) return Slope(Real(1));
    if (is_tie(node.operation, operands)) {
      ties_.push_back(&node);
      if (&node == other_side_) return other_side(node.operation, operands);
    }
    return operands.size() == 1 ? expression::value_of(node.operation, operands[0])
                                : expression::value_of(node.operation, operands[0], operands[1]);
  }
  void refuse(const Node& node, const std::string& reason) {
    if (!reason.empty() && !fault_) fault_ = NoSlope{node.at, reason};
  }
  Slope constant(const Node& node) {
    const Real value = values_(node);
    if (!isfinite(value)) refuse(node, "a number that has no value");
    return Slope(value);
  }
  Slope whole_power(const Node& node, int exponent) {
    const Slope base = walk(*node.operands[0]);
    if (exponent < 0 && is_nothing(base.value)) refuse(node, "division by 0");
    if (fault_) return Slope(Real(1));
    return expression::whole_power(base, exponent);
  }
  static Slope other_side(Operation operation, const std::vector<Slope>& operands) {
    if (operation == Operation::abs) return -expression::value_of(operation, operands[0]);
    return expression::value_of(operation, operands[1], operands[0]);
  }

  expression::Constants<Real> values_;
  const RealVector& point_;
  const Node* other_side_;
  std::optional<NoSlope> fault_;
  std::vector<const Node*> ties_;
};

// A value and the sum of the sizes of what it is made of, each through its own slope.
struct Sized {
  Real value, size;
};

class SizeWalk {
 public:
  explicit SizeWalk(const RealVector& point) : point_(point) {}

  Sized walk(const Node& node) {
    if (node.is_constant) return of_number(values_(node));
    if (node.kind == Node::Kind::variable) return of_number(point_(node.index));
    if (node.operation == Operation::power)
      if (const std::optional<int> exponent = expression::whole_exponent(*node.operands[1])) {
        const Sized base = walk(*node.operands[0]);
        const Slope power = expression::whole_power(Slope::variable(base.value, 0, 1), *exponent);
        return {power.value, Real(abs(power.slope(0)) * base.size)};
      }
    const Sized a = walk(*node.operands[0]);
    if (node.operands.size() == 1) {
      const Slope of_a = expression::value_of(node.operation, Slope::variable(a.value, 0, 1));
      return {of_a.value, Real(abs(of_a.slope(0)) * a.size)};
    }
    const Sized b = walk(*node.operands[1]);
    const Slope of_both =
        expression::value_of(node.operation, Slope::variable(a.value, 0, 2), Slope::variable(b.value, 1, 2));
    return {of_both.value, Real(abs(of_both.slope(0)) * a.size + abs(of_both.slope(1)) * b.size)};
  }

 private:
  static Sized of_number(const Real& value) { return {value, Real(abs(value))}; }

  expression::Constants<Real> values_;
  const RealVector& point_;
};

bool is_same_slope(const Slope& a, const Slope& b, Index variables) {
  for (Index i = 0; i < variables; ++i)
    if (!is_nothing(a.slope(i) - b.slope(i), a.slope(i))) return false;
  return true;
}

bool is_finite(const Slope& slope) {
  return isfinite(slope.value) && std::all_of(slope.slopes.data(), slope.slopes.data() + slope.slopes.size(),
                                              [](const Real& x) { return isfinite(x); });
}

}  // namespace

std::variant<Slope, NoSlope> slope_of(const Node& formula, const RealVector& point, Kinks kinks) {
  SlopeWalk walk(point, nullptr);
  const Slope slope = walk.walk(formula);
  if (walk.fault()) return *walk.fault();
  if (!is_finite(slope)) return NoSlope{formula.at, "it has no finite value"};
  if (kinks == Kinks::take_a_side) return slope;
  constexpr std::size_t most_ties = 100;
  if (walk.ties().size() > most_ties) return NoSlope{formula.at, "more than 100 branches meet there"};
  for (const Node* tie : walk.ties()) {
    const Slope beyond = SlopeWalk(point, tie).walk(formula);
    if (!is_finite(beyond) || !is_same_slope(slope, beyond, point.size()))
      return NoSlope{tie->at, std::string(expression::name_of(tie->operation)) + " has a kink there"};
  }
  return slope;
}

Real size_of_terms(const Node& formula, const RealVector& point) {
  const Real size = SizeWalk(point).walk(formula).size;
  return isfinite(size) ? size : Real(0);
}

}  // namespace lqg::design
