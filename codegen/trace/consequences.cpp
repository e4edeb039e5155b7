// SPDX-License-Identifier: MIT
#include "trace/consequences.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lqg::trace {

namespace {

// e of 2^e
std::optional<int> exponent_of(double value) {
  int exponent = 0;
  if (!(value > 0) || std::frexp(value, &exponent) != 0.5) return std::nullopt;
  return exponent - 1;
}

// What a number is below whose square is below `bound`.
double root_of(double bound) {
  const std::optional<int> exponent = exponent_of(bound);
  return exponent && *exponent % 2 == 0 ? std::ldexp(1.0, *exponent / 2) : std::max(1.0, bound);
}

class Following {
 public:
  explicit Following(const Graph& graph)
      : graph_(graph), is_known_finite_(graph.nodes().size(), false),
        is_known_not_negative_(graph.nodes().size(), false) {}

  void passed(int condition) {
    find_signs(condition);
    follow(condition);
  }

  std::vector<Consequence> found;

 private:
  const Node& at(int node) const { return graph_.nodes()[static_cast<std::size_t>(node)]; }

  // What is not below 0, of a whole condition: a sum is looked at with it.
  void find_signs(int condition) {
    const Node& node = at(condition);
    if (node.op == Op::both) return find_signs(node.a), find_signs(node.b);
    if (node.op != Op::negation || at(node.a).op != Op::less) return;
    const Node& less = at(node.a);
    if (graph_.is_constant(less.b, 0)) is_known_not_negative_[static_cast<std::size_t>(less.a)] = true;
  }

  void follow(int condition) {
    const Node& node = at(condition);
    switch (node.op) {
      case Op::finite: return is_finite(node.a);
      case Op::usable: is_finite(node.a); return is_positive(node.b);
      case Op::less: return is_less(node.a, node.b);
      case Op::both: follow(node.a); return follow(node.b);
      default: return;
    }
  }

  void note(const Consequence& consequence) {
    if (!graph_.is_constant(consequence.node)) found.push_back(consequence);
  }

  void is_finite(int a) {
    if (is_known_finite_[static_cast<std::size_t>(a)]) return;
    is_known_finite_[static_cast<std::size_t>(a)] = true;
    note({a});
    const Node& node = at(a);
    if (node.op != Op::add && node.op != Op::subtract && node.op != Op::negate && node.op != Op::absolute) return;
    is_finite(node.a);
    if (node.b >= 0) is_finite(node.b);
  }

  void is_positive(int a) {
    const Node& node = at(a);
    if (node.op == Op::subtract) is_less(node.b, node.a);
  }

  void is_less(int a, int b) {
    if (graph_.is_constant(b)) return is_below(a, at(b).value);
    if (at(a).op == Op::absolute) note({at(a).a, std::numeric_limits<double>::infinity(), b});
  }

  void is_below(int a, double bound) {
    if (!is_not_negative(a)) return;
    const Node& node = at(a);
    note({a, bound});
    if (node.op == Op::absolute) note({node.a, bound});
    if (node.op == Op::multiply || node.op == Op::multiply_add) is_product_below(node.a, node.b, bound);
    if (node.op == Op::multiply_add) is_below(node.c, bound);
    if (node.op != Op::add) return;
    is_below(node.a, bound);
    is_below(node.b, bound);
  }

  void is_product_below(int a, int b, double bound) {
    if (a == b) return note({a, root_of(bound)});
    if (graph_.is_constant(b)) std::swap(a, b);
    if (graph_.is_constant(a) && exponent_of(at(a).value)) is_below(b, bound / at(a).value);
  }

  bool is_not_negative(int a) const {
    if (is_known_not_negative_[static_cast<std::size_t>(a)]) return true;
    const Node& node = at(a);
    switch (node.op) {
      case Op::constant: return node.value >= 0;
      case Op::absolute: return true;
      case Op::multiply: return is_product_not_negative(node);
      case Op::multiply_add: return is_product_not_negative(node) && is_not_negative(node.c);
      case Op::add: return is_not_negative(node.a) && is_not_negative(node.b);
      default: return false;
    }
  }

  bool is_product_not_negative(const Node& node) const {
    return node.a == node.b || (is_not_negative(node.a) && is_not_negative(node.b));
  }

  const Graph& graph_;
  std::vector<bool> is_known_finite_, is_known_not_negative_;
};

}  // namespace

std::vector<Consequence> consequences(const Graph& graph, int condition) {
  Following following(graph);
  following.passed(condition);
  return following.found;
}

}  // namespace lqg::trace
