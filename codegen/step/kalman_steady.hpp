// SPDX-License-Identifier: MIT
// The Kalman filter with its constant gain.
#pragma once

#include "step/state.hpp"

namespace lqg::step {

// The innovation of output i, 0 where the output is not used: it is treated as an innovation of 0.
template <class S>
struct Innovation {
  S value;
  decltype(is_less(S(), S())) is_used;
};

template <class S, class Listener>
Innovation<S> innovate(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  const std::string feedthrough = model.D.cols() ? " − D u" : "";
  listener.section("innovation = y − C x̂" + feedthrough + ", 0 if it is not used", i);
  const S raw = residual(model, state, y, i);
  listener.name(raw, "raw_innovation");
  const S variance = is_zero(model.gate) ? S(0) : S(model.variance(i));
  auto used = weigh(model, state, raw, variance, [&] { return variance; }, i, listener);
  const S innovation = select(used, raw, S(0));
  listener.name(innovation, "innovation");
  return {innovation, used};
}

// x̂ ← x̂ + L innovation over the outputs from `first` on.
template <class S, class Listener>
auto correct_steady(const Model<S>& model, State<S>& state, const Vector<S>& innovation, int first,
                    Listener& listener) {
  listener.section("x̂ ← x̂ + L innovation", -1, and_check(model.x_bound));
  BoundsCheck<S> bounds;
  for (int j = 0; j < model.nx; ++j) {
    S sum = state.x(j);
    for (int i = 0; i < innovation.size(); ++i) sum = multiply_add(S(model.L(j, first + i)), S(innovation(i)), sum);
    listener.name(sum, "posterior", of_state(j));
    state.x(j) = sum;
    bounds.add(sum, model.x_bound, of_state(j, "x"), listener);
  }
  return bounds.is_within();
}

// x̂ ← x̂ + L(y − C x̂ − D u)
template <class S, class Listener>
auto update_steady(const Model<S>& model, State<S>& state, const Vector<S>& y, Listener& listener) {
  Vector<S> innovation(model.ny);
  std::vector<decltype(is_less(S(), S()))> used;
  for (int i = 0; i < model.ny; ++i) {
    const Innovation<S> found = innovate(model, state, S(y(i)), i, listener);
    innovation(i) = found.value;
    used.push_back(found.is_used);
  }
  observe(model, state, y, used, listener);
  auto within = correct_steady(model, state, innovation, 0, listener);
  if (model.M.cols()) state.innovation = innovation;
  return within;
}

// The same of output i alone: an approximation, since its gain is the best in the company of the others only.
template <class S, class Listener>
auto update_steady_alone(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  const Innovation<S> found = innovate(model, state, y, i, listener);
  observe_alone(model, state, y, found.is_used, i, listener);
  auto within = correct_steady(model, state, Vector<S>(Vector<S>::Constant(1, found.value)), i, listener);
  if (model.M.cols()) state.innovation(i) = found.value;
  return within;
}

template <class S, class Listener>
auto predict_steady(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  BoundsCheck<S> bounds;
  predict_state(model, state, u, bounds, listener);
  return bounds.is_within();
}

}  // namespace lqg::step
