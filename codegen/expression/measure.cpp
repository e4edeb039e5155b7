// SPDX-License-Identifier: MIT
#include "expression/measure.hpp"

#include <optional>

#include "expression/evaluate.hpp"

namespace lqg::expression {
namespace {

using Kind = Measure::Kind;

class Measurer {
 public:
  explicit Measurer(const MeasureOf& measure_of_name) : measure_of_name_(measure_of_name) {}

  Measure measure(const Node& node) {
    switch (node.kind) {
      case Node::Kind::number: return {node.number == 1 ? Kind::pure : Kind::free};
      case Node::Kind::pi: return {Kind::free};
      case Node::Kind::operation: break;
      default: return measure_of_name_(node);
    }
    const Measure first = measure(*node.operands[0]);
    if (node.operands.size() == 1) return of_one(node, first);
    return of_two(node, first, measure(*node.operands[1]));
  }

  const std::optional<Fault>& fault() const { return fault_; }

 private:
  Measure of_one(const Node& node, const Measure& a) {
    switch (node.operation) {
      case Operation::negate:
      case Operation::abs: return a;
      case Operation::sqrt: return a.kind == Kind::known ? Measure{Kind::known, power(a.unit, 0.5)} : a;
      default: break;
    }
    if (a.kind == Kind::known && !is_pure(a.unit))
      complain(node.operands[0]->at, std::string(name_of(node.operation)) + " needs a pure number (or rad), found " +
                                         in_words(a.unit) + advice(a.unit));
    return {Kind::pure};
  }

  Measure of_two(const Node& node, const Measure& a, const Measure& b) {
    const bool is_known = a.kind == Kind::known && b.kind == Kind::known;
    switch (node.operation) {
      case Operation::multiply: return of_product(a, b, [](const Unit& x, const Unit& y) { return x * y; });
      case Operation::divide: return of_product(a, b, [](const Unit& x, const Unit& y) { return x / y; });
      case Operation::power: return of_power(node, a, b);
      default: break;
    }
    if (is_known && !is_same(a.unit, b.unit)) complain_of_sum(node, a.unit, b.unit);
    if (node.operation == Operation::atan2) return {Kind::pure};
    for (const Kind kind : {Kind::known, Kind::unknown, Kind::free})
      if (a.kind == kind || b.kind == kind) return a.kind == kind ? a : b;
    return {Kind::pure};
  }

  template <class Join>
  static Measure of_product(const Measure& a, const Measure& b, const Join& join) {
    if (a.kind == Kind::unknown || b.kind == Kind::unknown) return {};
    const bool is_known = a.kind == Kind::known || b.kind == Kind::known;
    if (a.kind == Kind::free || b.kind == Kind::free) return {is_known ? Kind::unknown : Kind::free};
    if (!is_known) return {Kind::pure};
    return {Kind::known, join(a.unit, b.unit)};
  }

  Measure of_power(const Node& node, const Measure& a, const Measure& b) {
    const Node& exponent = *node.operands[1];
    if (b.kind == Kind::known && !is_pure(b.unit))
      complain(exponent.at, "an exponent is a pure number, found " + in_words(b.unit));
    if (a.kind != Kind::known || is_pure(a.unit)) return a;
    if (exponent.is_constant) return {Kind::known, power(a.unit, Constants<double>()(exponent))};
    complain(exponent.at, "the exponent of " + in_words(a.unit) + " is a number, found what changes");
    return {};
  }

  void complain_of_sum(const Node& node, const Unit& a, const Unit& b) {
    const std::string both = in_words(a) + " and " + in_words(b);
    const std::string name = name_of(node.operation);
    const bool is_sum = node.operation == Operation::add || node.operation == Operation::subtract;
    const std::string what = is_sum ? "a sum" : name;
    complain(node.at, is_like(a, b) ? what + " of different units, " + both + ": convert one to the other"
                                    : what + " of " + both);
  }

  static std::string advice(const Unit& unit) { return is_like(unit, {}) ? ": convert it" : ""; }

  // The first one counts.
  void complain(std::size_t at, const std::string& message) {
    if (!fault_) fault_ = Fault{at, message};
  }

  const MeasureOf& measure_of_name_;
  std::optional<Fault> fault_;
};

}  // namespace

std::variant<Measure, Fault> measure_of(const Node& node, const MeasureOf& measure_of_name) {
  Measurer measurer(measure_of_name);
  const Measure measure = measurer.measure(node);
  if (measurer.fault()) return *measurer.fault();
  return measure;
}

}  // namespace lqg::expression
