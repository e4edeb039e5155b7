// SPDX-License-Identifier: MIT
// One sample of the whole controller, whatever its filter.
#pragma once

#include "step/kalman_online.hpp"
#include "step/kalman_steady.hpp"

namespace lqg::step {

// x̂ ← x̂ + L(y − C x̂ − D u); the condition says that the state is within its bounds.
template <class S, class Listener>
auto update(const Model<S>& model, State<S>& state, const Vector<S>& y, Listener& listener) {
  const Vector<S> heard = in_range_or_nan(model, y, listener);
  return model.filter == Filter::steady ? update_steady(model, state, heard, listener)
                                        : update_online(model, state, heard, listener);
}

// The update by output i alone.
template <class S, class Listener>
auto update_alone(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  const S heard = in_range_or_nan(model, y, i, listener);
  return model.filter == Filter::steady ? update_steady_alone(model, state, heard, i, listener)
                                        : update_online_alone(model, state, heard, i, listener);
}

// x̂ ← A x̂ + B u, or f of them, with the u that was applied; the condition says that the state is within its bounds.
template <class S, class Listener>
auto predict(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  if (model.equations) return predict_extended(model, state, u, listener);
  switch (model.filter) {
    case Filter::plain: return predict_plain(model, state, u, listener);
    case Filter::ud: return predict_ud(model, state, u, listener);
    default: return predict_steady(model, state, u, listener);
  }
}

// After an update or a prediction whose condition does not hold: P begins anew, and x̂ stays where it is within its
// bounds; else all begins anew, and the condition is false. Numbers only.
template <class S>
bool recover(const Model<S>& model, State<S>& state, Listener& listener) {
  const bool keeps_estimate = carries_covariance(model) && begin_covariance_anew(model, state, listener);
  if (!keeps_estimate) begin_anew(model, state);
  listener.raise(keeps_estimate ? Event::covariance_reset : Event::state_reset, true);
  return keeps_estimate;
}

// The three calls of a sample in the order of the form, as `NAME_step` makes them; numbers only. With a regulator `u`
// is the result, without one it is what was applied. Returns the events.
template <class S>
unsigned run_sample(const Model<S>& model, State<S>& state, const Vector<S>& y, Vector<S>& u) {
  Listener listener;
  const auto recover_unless = [&](bool within) {
    if (!within) recover(model, state, listener);
  };
  const auto act = [&] {
    if (model.K.rows()) u = control(model, state, listener);
  };
  if (model.predictor_form) act();
  recover_unless(update(model, state, y, listener));
  if (!model.predictor_form) act();
  recover_unless(predict(model, state, u, listener));
  return listener.events;
}

}  // namespace lqg::step
