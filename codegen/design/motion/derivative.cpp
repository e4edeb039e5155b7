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
  // With `constants` > 0 so many constants are variables, too, after those of the point.
  SlopeWalk(const RealVector& point, const Node* other_side, Index constants)
      : point_(point), other_side_(other_side), constants_(constants) {}

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
    if (node.kind == Node::Kind::variable) return variable(point_(node.index), node.index);
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
  Slope variable(const Real& value, Index index) const {
    return Slope::variable(value, static_cast<int>(index), static_cast<int>(point_.size() + constants_));
  }
  Slope constant(const Node& node) {
    const Real value = values_(node);
    if (!isfinite(value)) refuse(node, "a number that has no value");
    return constants_ == 0 ? Slope(value) : variable(value, point_.size() + next_++);
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
  Index constants_, next_ = 0;
  std::optional<NoSlope> fault_;
  std::vector<const Node*> ties_;
};

// The constants in the order of SlopeWalk: a whole exponent is none.
template <class Visit>
void for_each_constant(const Node& node, const Visit& visit) {
  if (node.is_constant) return visit(node);
  const bool is_whole_power = node.kind == Node::Kind::operation && node.operation == Operation::power &&
                              expression::whole_exponent(*node.operands[1]);
  for (std::size_t i = 0; i < (is_whole_power ? 1 : node.operands.size()); ++i)
    for_each_constant(*node.operands[i], visit);
}

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
  SlopeWalk walk(point, nullptr, 0);
  const Slope slope = walk.walk(formula);
  if (walk.fault()) return *walk.fault();
  if (!is_finite(slope)) return NoSlope{formula.at, "it has no finite value"};
  if (kinks == Kinks::take_a_side) return slope;
  for (const Node* tie : walk.ties()) {
    const Slope beyond = SlopeWalk(point, tie, 0).walk(formula);
    if (!is_finite(beyond) || !is_same_slope(slope, beyond, point.size()))
      return NoSlope{tie->at, std::string(expression::name_of(tie->operation)) + " has a kink there"};
  }
  return slope;
}

Real size_of_terms(const Node& formula, const RealVector& point) {
  std::vector<Real> values(point.data(), point.data() + point.size());
  expression::Constants<Real> value_of;
  for_each_constant(formula, [&](const Node& node) { values.push_back(value_of(node)); });
  SlopeWalk walk(point, nullptr, static_cast<Index>(values.size()) - point.size());
  const Slope slope = walk.walk(formula);
  if (walk.fault() || !is_finite(slope)) return Real(0);
  Real sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += abs(slope.slope(static_cast<Index>(i)) * values[i]);
  return sum;
}

}  // namespace lqg::design
