// SPDX-License-Identifier: MIT
// How far the outputs are from what the estimate expects, for those who watch a filter.
#pragma once

#include "step/extended.hpp"

namespace lqg::step {

// Uᵀ C_iᵀ
template <class S, class Listener>
Vector<S> projection(const Model<S>& model, const State<S>& state, int i, Listener& listener) {
  Vector<S> f(model.nx);
  for (int j = 0; j < model.nx; ++j) {
    f(j) = model.C(i, j);
    for (int k = 0; k < j; ++k) f(j) = multiply_add(S(state.U[strict_triangle(k, j)]), S(model.C(i, k)), S(f(j)));
    listener.hint(f(j), "f", of_entry(j));
  }
  return f;
}

// C_i P C_iᵀ + V_i
template <class S, class Listener>
S innovation_variance(const Model<S>& model, const State<S>& state, int i, Listener& listener) {
  if (model.filter == Filter::steady) return model.variance(i);
  if (model.filter == Filter::ud) {
    const S variance = variance_ud(model, state, projection(model, state, i, listener), i);
    listener.name(variance, "variance");
    return variance;
  }
  S variance = model.V(i);
  for (int j = 0; j < model.nx; ++j) {
    S sum = S(0);
    for (int k = 0; k < model.nx; ++k) sum = multiply_add(S(state.P[triangle(j, k)]), S(model.C(i, k)), sum);
    listener.hint(sum, "cov", of_state(j));
    variance = multiply_add(S(model.C(i, j)), sum, variance);
  }
  listener.name(variance, "variance");
  return variance;
}

// y_i − C_i x̂ − D_i u of each output by itself, before the update, with C, D and V of the outputs as they are. Of an
// extended filter y − h(x̂, u), and the model takes the Jacobian of h for its C.
template <class S, class Listener>
Vector<S> innovations(Model<S>& model, const State<S>& state, const Vector<S>& y, Listener& listener) {
  if (model.equations) {
    const OutputsAtEstimate<S> outputs = outputs_at_estimate(model, state, y, listener);
    model.C = outputs.C;
    return outputs.innovation;
  }
  Vector<S> innovation(model.ny);
  for (int i = 0; i < model.ny; ++i) {
    listener.section(model.D.cols() ? "innovation = y − C x̂ − D u" : "innovation = y − C x̂", i);
    innovation(i) = residual(model, state, S(y(i)), i);
    listener.name(innovation(i), "innovation");
  }
  return innovation;
}

}  // namespace lqg::step
