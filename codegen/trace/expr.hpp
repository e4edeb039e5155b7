// SPDX-License-Identifier: MIT
// The symbolic scalar: a run over it records its operations in the graph in force, and the graph is the program.
#pragma once

#include "trace/graph.hpp"

namespace lqg::trace {

// The graph in which expressions are recorded while this lives.
class Recording {
 public:
  explicit Recording(Graph& graph);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

 private:
  Graph* before_;
};

Graph& graph();

struct Expr {
  int node;
  Expr(double value = 0) : node(graph().constant(value)) {}
  static Expr of(int node) {
    Expr made(Existing{});
    made.node = node;
    return made;
  }

 private:
  struct Existing {};
  explicit Expr(Existing) : node(-1) {}
};

struct Condition {
  int node = -1;
};

inline Expr operator+(const Expr& a, const Expr& b) { return Expr::of(graph().make(Op::add, a.node, b.node)); }
inline Expr operator-(const Expr& a, const Expr& b) { return Expr::of(graph().make(Op::subtract, a.node, b.node)); }
inline Expr operator*(const Expr& a, const Expr& b) { return Expr::of(graph().make(Op::multiply, a.node, b.node)); }
inline Expr operator/(const Expr& a, const Expr& b) { return Expr::of(graph().make(Op::divide, a.node, b.node)); }

inline Expr multiply_add(const Expr& a, const Expr& b, const Expr& c) {
  return Expr::of(graph().make(Op::multiply_add, a.node, b.node, c.node));
}
inline Expr multiply_subtract(const Expr& a, const Expr& b, const Expr& c) {
  return Expr::of(graph().make(Op::multiply_subtract, a.node, b.node, c.node));
}
inline Expr select(const Condition& condition, const Expr& yes, const Expr& no) {
  return Expr::of(graph().make(Op::select, condition.node, yes.node, no.node));
}
inline Expr operator-(const Expr& a) { return Expr::of(graph().make(Op::negate, a.node)); }
inline Expr absolute(const Expr& a) { return Expr::of(graph().make(Op::absolute, a.node)); }
inline Expr abs(const Expr& a) { return absolute(a); }
inline Expr sqrt(const Expr& a) { return Expr::of(graph().call(Op::square_root, a.node)); }
inline Expr sin(const Expr& a) { return Expr::of(graph().call(Op::sine, a.node)); }
inline Expr cos(const Expr& a) { return Expr::of(graph().call(Op::cosine, a.node)); }
inline Expr tan(const Expr& a) { return Expr::of(graph().call(Op::tangent, a.node)); }
inline Expr asin(const Expr& a) { return Expr::of(graph().call(Op::arcsine, a.node)); }
inline Expr acos(const Expr& a) { return Expr::of(graph().call(Op::arccosine, a.node)); }
inline Expr atan(const Expr& a) { return Expr::of(graph().call(Op::arctangent, a.node)); }
inline Expr atan2(const Expr& y, const Expr& x) {
  return Expr::of(graph().call(Op::arctangent_of_two, y.node, x.node));
}
inline Expr exp(const Expr& a) { return Expr::of(graph().call(Op::exponential, a.node)); }
inline Expr log(const Expr& a) { return Expr::of(graph().call(Op::logarithm, a.node)); }
inline Expr tanh(const Expr& a) { return Expr::of(graph().call(Op::hyperbolic_tangent, a.node)); }
inline Expr wrapped(const Expr& a) { return Expr::of(graph().call(Op::wrapped, a.node)); }
// aᵇ = e^(b ln a)
inline Expr power(const Expr& a, const Expr& b) { return exp(b * log(a)); }
inline Expr not_a_number(const Expr&) {
  return Expr::of(graph().flag(graph().target().is_double ? "(double)NAN" : "NAN"));
}
inline bool is_zero(const Expr& a) { return graph().is_constant(a.node, 0); }
inline Condition is_finite(const Expr& a) { return {graph().make(Op::finite, a.node)}; }
inline Condition is_less(const Expr& a, const Expr& b) { return {graph().make(Op::less, a.node, b.node)}; }
inline Condition is_usable(const Expr& a, const Expr& b) { return {graph().make(Op::usable, a.node, b.node)}; }
inline Condition either(const Condition& a, const Condition& b) { return {graph().make(Op::either, a.node, b.node)}; }
inline Condition both(const Condition& a, const Condition& b) { return {graph().make(Op::both, a.node, b.node)}; }
inline Condition negation(const Condition& a) { return {graph().make(Op::negation, a.node)}; }

}  // namespace lqg::trace
