// The Kalman filter with its constant gain.
#pragma once

#include "step/state.hpp"

namespace lqg::step {

// x̂ ← x̂ + L(y − C x̂ − D u). An output that is not finite counts as one that came as expected.
template <class S, class Listener>
auto update_steady(const Model<S>& model, State<S>& state, const Vector<S>& y, Listener& listener) {
  Vector<S> innovation(model.ny);
  for (int i = 0; i < model.ny; ++i) {
    listener.section(model.D.cols() ? "innovation = y − C x̂ − D u, 0 if it is not finite"
                                    : "innovation = y − C x̂, 0 if it is not finite", i);
    S nu = residual(model, state, S(y(i)), i);
    listener.name(nu, "measured");
    auto usable = listener.accept(is_finite(nu), Event::output_not_finite);
    nu = select(usable, nu, S(0));
    listener.name(nu, "innovation");
    innovation(i) = nu;
  }
  listener.section("x̂ ← x̂ + L innovation");
  Total<S> total;
  for (int j = 0; j < model.nx; ++j) {
    S sum = state.x(j);
    for (int i = 0; i < model.ny; ++i) sum = multiply_add(S(model.L(j, i)), S(innovation(i)), sum);
    listener.name(sum, "posterior", j);
    state.x(j) = sum;
    total.add(sum, listener);
  }
  if (model.M.cols()) state.innovation = innovation;
  return is_finite(total.sum);
}

template <class S, class Listener>
auto predict_steady(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  Total<S> total;
  predict_state(model, state, u, total, listener);
  return is_finite(total.sum);
}

}  // namespace lqg::step
