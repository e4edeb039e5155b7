// SPDX-License-Identifier: MIT
// The state, set by hand and read; the input is in servo.hpp.
#pragma once

#include "step/bounds_check.hpp"
#include "step/model.hpp"

namespace lqg::step {

// M v, each product added to those before it; zeros of M take nothing, whatever stands beside them.
template <class S>
Vector<S> image(const Matrix<S>& M, const Vector<S>& v) {
  Vector<S> result(M.rows());
  for (int i = 0; i < M.rows(); ++i) {
    S sum = S(0);
    bool has_sum = false;
    for (int j = 0; j < M.cols(); ++j) {
      if (is_zero(S(M(i, j)))) continue;
      sum = has_sum ? multiply_add(S(M(i, j)), S(v(j)), sum) : S(M(i, j) * v(j));
      has_sum = true;
    }
    result(i) = sum;
  }
  return result;
}

// x̂ ← x, and nothing is left to tell of the last outputs. The condition says that x is within its bounds.
template <class S, class Listener>
auto set_state(const Model<S>& model, State<S>& state, const Vector<S>& x, Listener& listener) {
  const bool is_kept = model.to_estimate.size() == 0;
  listener.section(is_kept ? "x̂ ← x" : "z ← T⁻¹ x", -1, and_check(model.x_bound));
  const Vector<S> kept = is_kept ? x : image(model.of_estimate, x);
  for (int i = 0; !is_kept && i < model.nx; ++i) listener.name(kept(i), "set", of_state(i));
  BoundsCheck<S> bounds;
  for (int i = 0; i < model.nx; ++i) bounds.add(S(kept(i)), model.x_bound, of_state(i, "x"), listener);
  state.x = kept;
  for (int i = 0; i < state.innovation.size(); ++i) state.innovation(i) = S(0);
  return bounds.is_within();
}

// x̂
template <class S, class Listener>
Vector<S> estimate(const Model<S>& model, const State<S>& state, Listener& listener) {
  if (model.to_estimate.size() == 0) return state.x;
  listener.section("x̂ = T z");
  const Vector<S> x = image(model.to_estimate, state.x);
  for (int i = 0; i < model.nx; ++i) listener.name(x(i), "estimate", of_entry(i));
  return x;
}

}  // namespace lqg::step
