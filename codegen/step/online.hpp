// SPDX-License-Identifier: MIT
// What the filters that carry P have in common: decorrelated outputs, and the residual that cross noise keeps.
#pragma once

#include "step/state.hpp"

namespace lqg::step {

// y'_i = y_i + Σ_j<i E_ij y_j. A zero of E keeps the NaN of one output out of the others.
template <class S, class Listener>
S decorrelate(const Model<S>& model, const Vector<S>& y, int i, Listener& listener) {
  S sum = y(i);
  for (int j = 0; j < i; ++j)
    if (!is_zero(model.E(i, j))) sum = multiply_add(S(model.E(i, j)), S(y(j)), sum);
  if (i > 0) listener.name(sum, "uncorrelated", of_output(i));
  return sum;
}
template <class S, class Listener>
Vector<S> decorrelate(const Model<S>& model, const Vector<S>& y, Listener& listener) {
  listener.section("outputs with uncorrelated noise, y ← E y");
  Vector<S> out(y.size());
  for (int i = 0; i < model.ny; ++i) out(i) = decorrelate(model, y, i, listener);
  return out;
}

// Output i is in the mixture of a later one.
template <class S>
bool is_mixed_in(const Model<S>& model, int i) {
  for (int k = i + 1; k < model.ny; ++k)
    if (!is_zero(model.E(k, i))) return true;
  return false;
}

// What is left of an output after the update: it tells predict about the noise that w and v share.
template <class S, class Listener, class Condition>
void keep_residual_alone(const Model<S>& model, State<S>& state, const S& y, const Condition& usable, int i,
                         Listener& listener) {
  if (!model.M.cols()) return;
  listener.section("what the output tells of w: y − C x̂ − D u after all updates", i);
  S left = select(usable, residual(model, state, y, i), S(0));
  listener.name(left, "residual");
  state.innovation(i) = left;
}

template <class S, class Listener, class Condition>
void keep_residual(const Model<S>& model, State<S>& state, const Vector<S>& y, const std::vector<Condition>& usable,
                   Listener& listener) {
  for (int i = 0; i < model.ny; ++i)
    keep_residual_alone(model, state, S(y(i)), usable[static_cast<std::size_t>(i)], i, listener);
}

}  // namespace lqg::step
