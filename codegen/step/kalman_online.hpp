// The update of the filters that carry P, whatever form P has.
#pragma once

#include "step/kalman_plain.hpp"
#include "step/kalman_ud.hpp"

namespace lqg::step {

template <class S, class Listener>
auto update_online_output(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  return model.filter == Filter::ud ? update_ud_output(model, state, y, i, listener)
                                    : update_plain_output(model, state, y, i, listener);
}

template <class S, class Listener>
auto has_bounded_estimate(const Model<S>& model, const State<S>& state, Listener& listener) {
  listener.section("Σ x̂² in units of a bound");
  BoundsCheck<S> bounds;
  for (int j = 0; j < model.nx; ++j) bounds.add(S(state.x(j)), model.x_bound, j, listener);
  return bounds.is_within();
}

// One output after the other.
template <class S, class Listener>
auto update_online(const Model<S>& model, State<S>& state, const Vector<S>& measured, Listener& listener) {
  const Vector<S> y = decorrelate(model, measured, listener);
  std::vector<decltype(is_finite(y(0)))> usable;
  for (int i = 0; i < model.ny; ++i) usable.push_back(update_online_output(model, state, S(y(i)), i, listener));
  keep_residual(model, state, y, usable, listener);
  return has_bounded_estimate(model, state, listener);
}

// The same of output i alone: as if the others were not there.
template <class S, class Listener>
auto update_online_alone(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  auto usable = update_online_output(model, state, y, i, listener);
  keep_residual_alone(model, state, y, usable, i, listener);
  return has_bounded_estimate(model, state, listener);
}

}  // namespace lqg::step
