// SPDX-License-Identifier: MIT
// The state, set by hand; the input is in servo.hpp.
#pragma once

#include "step/bounds_check.hpp"
#include "step/model.hpp"

namespace lqg::step {

// x̂ ← x, and nothing is left to tell of the last outputs. The condition says that x is within its bounds.
template <class S, class Listener>
auto set_state(const Model<S>& model, State<S>& state, const Vector<S>& x, Listener& listener) {
  listener.section("x̂ ← x", -1, and_check(model.x_bound));
  BoundsCheck<S> bounds;
  for (int i = 0; i < model.nx; ++i) bounds.add(S(x(i)), model.x_bound, of_state(i, "x"), listener);
  state.x = x;
  for (int i = 0; i < state.innovation.size(); ++i) state.innovation(i) = S(0);
  return bounds.is_within();
}

}  // namespace lqg::step
