// SPDX-License-Identifier: MIT
#include "trace/graph.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "trace/functions.hpp"

namespace lqg::trace {

namespace {

template <class T>
double compute(Op op, bool fused, T a, T b, T c) {
  if (is_function(op)) return value_of_function(op, a, b);
  switch (op) {
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return a * b;
    case Op::divide: return a / b;
    case Op::negate: return -a;
    case Op::absolute: return std::abs(a);
    case Op::multiply_add: {
      const T product = a * b;
      return fused ? std::fma(a, b, c) : product + c;
    }
    case Op::multiply_subtract: {
      const T product = a * b;
      return fused ? std::fma(-a, b, c) : c - product;
    }
    case Op::finite: return a - a == 0;
    case Op::less: return a < b;
    case Op::usable: return a - a < b;
    case Op::either: return a != 0 || b != 0;
    case Op::both: return a != 0 && b != 0;
    case Op::negation: return a == 0;
    default: return a != 0 ? b : c;  // select
  }
}

bool commutes(Op op) {
  return op == Op::add || op == Op::multiply || op == Op::either || op == Op::both || op == Op::multiply_add ||
         op == Op::multiply_subtract;  // the two factors
}

}  // namespace

bool is_condition(Op op) {
  return op == Op::finite || op == Op::less || op == Op::either || op == Op::both || op == Op::negation ||
         op == Op::usable || op == Op::same || op == Op::asked;
}

int Graph::insert(Node node) {
  node.section = static_cast<int>(sections_.size()) - 1;
  nodes_.push_back(std::move(node));
  return static_cast<int>(nodes_.size()) - 1;
}

int Graph::constant(double value) {
  value += 0.0;  // −0 is 0
  const auto [at, is_new] = constants_.try_emplace(value, -1);
  if (is_new) {
    Node node;
    node.value = value;
    at->second = insert(std::move(node));
  }
  return at->second;
}

int Graph::constant(double value, const std::string& name) {
  const auto [at, is_new] = named_constants_.try_emplace(prefix_ + name, -1);
  if (is_new) {
    Node node;
    node.value = value + 0.0;  // −0 is 0
    node.text = at->first;
    at->second = insert(std::move(node));
  }
  return at->second;
}

int Graph::input(const std::string& text, const std::string& name) {
  Node node;
  node.op = Op::input;
  node.text = text;
  const int made = insert(std::move(node));
  this->name(made, name);
  return made;
}

int Graph::flag(const std::string& text) {
  const auto [at, is_new] = flags_.try_emplace(text, -1);
  if (is_new) {
    Node node;
    node.op = Op::flag;
    node.text = text;
    at->second = insert(std::move(node));
  }
  return at->second;
}

int Graph::ask(int condition, const std::string& function, int b, int c, double bound) {
  Node node;
  node.op = Op::asked;
  node.a = condition;
  node.b = b;
  node.c = c;
  node.text = function;
  node.value = bound;
  return insert(std::move(node));
}

void Graph::begin_rest() {
  rest_ = static_cast<int>(nodes_.size());
  known_.clear();
}

int Graph::resume(int value, const std::string& place, const std::string& name) {
  Node node;
  node.op = Op::resumed;
  node.a = value;
  node.text = place;
  node.name = name;
  return insert(std::move(node));
}

int Graph::make(Op op, int a, int b, int c) {
  const bool is_product = op == Op::multiply || op == Op::multiply_add || op == Op::multiply_subtract;
  // The number stands before the value, as in an equation, and of two numbers the one that folds.
  if (is_product && is_constant(b) && (!is_constant(a) || is_constant(b, 0) || std::abs(nodes_[b].value) == 1))
    std::swap(a, b);
  const int folded = fold(op, a, b, c);
  if (folded >= 0) return folded;
  Key key{op, a, b, c};
  if (commutes(op) && b < a) key = {op, b, a, c};
  const auto [at, is_new] = known_.try_emplace(key, -1);
  if (is_new) {
    Node node;
    node.op = op;
    node.a = a;
    node.b = b;
    node.c = c;
    at->second = insert(std::move(node));
  }
  return at->second;
}

int Graph::call(Op function, int a, int b) {
  const int made = make(function, a, b);
  if (is_constant(made) || !nodes_[made].hint.empty()) return made;
  const Node& argument = nodes_[a];
  const std::string of = !argument.name.empty() ? argument.name : argument.hint;
  nodes_[made].hint = std::string(name_of_function(function)) + "_" + (of.empty() ? "value" : of);
  return made;
}

int Graph::fold_constants(Op op, int a, int b, int c) {
  for (const int operand : {a, b, c})
    if (operand >= 0 && !is_constant(operand)) return -1;
  const auto value = [&](int node) { return node >= 0 ? nodes_[node].value : 0.0; };
  const double result = target_.is_double ? compute<double>(op, target_.is_fused, value(a), value(b), value(c))
                                          : compute<float>(op, target_.is_fused, static_cast<float>(value(a)),
                                                           static_cast<float>(value(b)), static_cast<float>(value(c)));
  return std::isfinite(result) ? constant(result) : -1;
}

int Graph::fold(Op op, int a, int b, int c) {
  const int folded = fold_constants(op, a, b, c);
  if (folded >= 0) return folded;
  switch (op) {
    case Op::add:
      if (is_constant(a, 0)) return b;
      if (is_constant(b, 0)) return a;
      return -1;
    case Op::subtract:
      if (is_constant(b, 0)) return a;
      if (is_constant(a, 0)) return make(Op::negate, b);
      return a == b ? constant(0) : -1;
    case Op::multiply: return fold_multiply(a, b);
    case Op::divide:
      if (is_constant(a, 0) || is_constant(b, 1)) return a;
      return a == b ? constant(1) : -1;
    case Op::negate: return nodes_[a].op == Op::negate ? nodes_[a].a : -1;
    case Op::absolute: return nodes_[a].op == Op::absolute ? a : -1;
    case Op::multiply_add: return fold_multiply_add(a, b, c);
    case Op::multiply_subtract: return fold_multiply_subtract(a, b, c);
    default: return fold_condition(op, a, b, c);
  }
}

// A negative number hands its sign on: the same number with the other sign need not be loaded too.
int Graph::fold_multiply(int a, int b) {
  if (is_constant(a, 0)) return a;
  if (is_constant(a, 1)) return b;
  if (is_constant(a, -1)) return make(Op::negate, b);
  if (is_constant(a) && nodes_[a].value < 0) return make(Op::negate, make(Op::multiply, constant(-nodes_[a].value), b));
  return -1;
}

int Graph::fold_multiply_add(int a, int b, int c) {
  if (is_constant(a, 0)) return c;
  if (is_constant(a, 1)) return make(Op::add, c, b);
  if (is_constant(a, -1)) return make(Op::subtract, c, b);
  if (is_constant(c, 0)) return make(Op::multiply, a, b);
  if (is_constant(a) && is_constant(b) && !target_.is_fused) return make(Op::add, c, make(Op::multiply, a, b));
  if (is_constant(a) && nodes_[a].value < 0) return make(Op::multiply_subtract, constant(-nodes_[a].value), b, c);
  return -1;
}

int Graph::fold_multiply_subtract(int a, int b, int c) {
  if (is_constant(a, 0)) return c;
  if (is_constant(a, 1)) return make(Op::subtract, c, b);
  if (is_constant(a, -1)) return make(Op::add, c, b);
  if (is_constant(a) && is_constant(b) && !target_.is_fused) return make(Op::subtract, c, make(Op::multiply, a, b));
  if (is_constant(a) && (nodes_[a].value < 0 || is_constant(c, 0)))
    return make(Op::multiply_add, constant(-nodes_[a].value), b, c);
  if (is_constant(c, 0)) return make(Op::negate, make(Op::multiply, a, b));
  return -1;
}

int Graph::fold_condition(Op op, int a, int b, int c) {
  switch (op) {
    case Op::either:
      if (is_constant(a)) return nodes_[a].value != 0 ? a : b;
      if (is_constant(b)) return nodes_[b].value != 0 ? b : a;
      return a == b ? a : -1;
    case Op::both:
      if (is_constant(a)) return nodes_[a].value != 0 ? b : a;
      if (is_constant(b)) return nodes_[b].value != 0 ? a : b;
      return a == b ? a : -1;
    case Op::negation: return nodes_[a].op == Op::negation ? nodes_[a].a : -1;
    case Op::less: {  // nothing finite lies beyond infinity
      constexpr double infinity = std::numeric_limits<double>::infinity();
      return is_constant(a, infinity) || is_constant(b, -infinity) ? constant(0) : -1;
    }
    case Op::select:
      if (is_constant(a)) return nodes_[a].value != 0 ? b : c;
      return b == c ? b : -1;
    default: return -1;
  }
}

void Graph::section(const std::string& equation, const std::string& suffix) { sections_.push_back({equation, suffix}); }

void Graph::name(int node, const std::string& base) {
  if (nodes_[node].op == Op::constant || !nodes_[node].name.empty()) return;
  nodes_[node].name = base + sections_.back().suffix;
}

void Graph::hint(int node, const std::string& base) {
  if (nodes_[node].hint.empty()) nodes_[node].hint = base + sections_.back().suffix;
}

}  // namespace lqg::trace
