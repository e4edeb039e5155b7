// The Kalman filter with its constant gain.
#pragma once

#include "step/state.hpp"

namespace lqg::step {

// The innovation of output i, 0 where it is beyond its limit or the gate: it counts as one that came as expected.
template <class S, class Listener>
S innovate(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  const std::string otherwise = is_zero(model.gate) ? ", 0 if it is not believable" : ", 0 if it is not believable or beyond the gate";
  listener.section((model.D.cols() ? "innovation = y − C x̂ − D u" : "innovation = y − C x̂") + otherwise, i);
  S nu = residual(model, state, y, i);
  listener.name(nu, "measured");
  auto usable = listener.accept(is_believable(model.nu_limit, i, nu), Event::output_not_finite);
  nu = select(usable, nu, S(0));
  listener.name(nu, "innovation");
  if (is_zero(model.gate)) return nu;
  auto passed = pass_gate(model, state, nu, S(model.variance(i)), usable, i, listener);
  nu = select(passed, nu, S(0));
  listener.name(nu, "likely");
  return nu;
}

// x̂ ← x̂ + L innovation over the outputs from `first` on.
template <class S, class Listener>
auto correct_steady(const Model<S>& model, State<S>& state, const Vector<S>& innovation, int first, Listener& listener) {
  listener.section("x̂ ← x̂ + L innovation");
  BoundsCheck<S> bounds;
  for (int j = 0; j < model.nx; ++j) {
    S sum = state.x(j);
    for (int i = 0; i < innovation.size(); ++i) sum = multiply_add(S(model.L(j, first + i)), S(innovation(i)), sum);
    listener.name(sum, "posterior", j);
    state.x(j) = sum;
    bounds.add(sum, model.x_bound, j, listener);
  }
  return bounds.is_within();
}

// x̂ ← x̂ + L(y − C x̂ − D u)
template <class S, class Listener>
auto update_steady(const Model<S>& model, State<S>& state, const Vector<S>& y, Listener& listener) {
  Vector<S> innovation(model.ny);
  for (int i = 0; i < model.ny; ++i) innovation(i) = innovate(model, state, S(y(i)), i, listener);
  auto within = correct_steady(model, state, innovation, 0, listener);
  if (model.M.cols()) state.innovation = innovation;
  return within;
}

// The same of output i alone: an approximation, since its gain is the best in the company of the others only.
template <class S, class Listener>
auto update_steady_alone(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  const S nu = innovate(model, state, y, i, listener);
  auto within = correct_steady(model, state, Vector<S>(Vector<S>::Constant(1, nu)), i, listener);
  if (model.M.cols()) state.innovation(i) = nu;
  return within;
}

template <class S, class Listener>
auto predict_steady(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  BoundsCheck<S> bounds;
  predict_state(model, state, u, bounds, listener);
  return bounds.is_within();
}

}  // namespace lqg::step
