// SPDX-License-Identifier: MIT
// The update of the filters that carry P, whatever form P has.
#pragma once

#include "step/extended.hpp"

namespace lqg::step {

template <class S, class Listener>
auto update_online_output(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  return model.filter == Filter::ud ? update_ud_output(model, state, y, i, listener)
                                    : update_plain_output(model, state, y, i, listener);
}

template <class S, class Listener>
void check_estimate(const Model<S>& model, const State<S>& state, BoundsCheck<S>& check, Listener& listener) {
  listener.section("x̂ within its bounds", -1, and_check(model.x_bound));
  for (int j = 0; j < model.nx; ++j) check.add(S(state.x(j)), model.x_bound, of_state(j, "x"), listener);
}

// After an update: x̂ is within its bounds, and no S was found that is not positive. Of a covariance S is V at least.
template <class S, class Listener>
auto has_sound_state(const Model<S>& model, const State<S>& state, Listener& listener) {
  BoundsCheck<S> check;
  check_estimate(model, state, check, listener);
  auto within = check.is_within();
  return model.filter == Filter::plain ? listener.without(Event::innovation_not_positive, within) : within;
}

// One output after the other, of outputs y that are `measured` or differ from them by what the model says.
template <class S, class Listener>
auto update_by_outputs(const Model<S>& model, State<S>& state, const Vector<S>& outputs, const Vector<S>& measured,
                       Listener& listener) {
  Vector<S> heard = outputs, y = outputs;
  std::vector<decltype(is_less(S(), S()))> usable;
  for (int i = 0; i < model.ny; ++i) {
    listener.section("y ← E y, of uncorrelated noise", i);
    y(i) = decorrelate(model, heard, i, listener);
    usable.push_back(update_online_output(model, state, S(y(i)), i, listener));
    // What is left out must not come in by way of another output.
    if (is_mixed_in(model, i)) heard(i) = select(usable.back(), S(heard(i)), not_a_number(S(heard(i))));
  }
  observe(model, state, measured, usable, listener);
  keep_residual(model, state, y, usable, listener);
  return has_sound_state(model, state, listener);
}

// The condition says that x̂ is within its bounds, and that P can be a covariance. An extended filter linearises all
// outputs of a sample at the estimate before them.
template <class S, class Listener>
auto update_online(const Model<S>& model, State<S>& state, const Vector<S>& measured, Listener& listener) {
  if (!model.equations) return update_by_outputs(model, state, measured, measured, listener);
  const OutputsAtEstimate<S> outputs = outputs_at_estimate(model, state, measured, listener);
  const Model<S> linear = linearised(model, state, outputs.C, listener);
  return update_by_outputs(linear, state, outputs.innovation, measured, listener);
}

template <class S, class Listener>
auto update_by_output(const Model<S>& model, State<S>& state, const S& y, const S& measured, int i,
                      Listener& listener) {
  auto usable = update_online_output(model, state, y, i, listener);
  observe_alone(model, state, measured, usable, i, listener);
  keep_residual_alone(model, state, y, usable, i, listener);
  return has_sound_state(model, state, listener);
}

// The same of output i alone: as if the others were not there.
template <class S, class Listener>
auto update_online_alone(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  if (!model.equations) return update_by_output(model, state, y, y, i, listener);
  OutputsAtEstimate<S> outputs = {Vector<S>(model.ny), Matrix<S>(Matrix<S>::Constant(model.ny, model.nx, S(0)))};
  take_output(model, state, variables(state.x), y, i, outputs, listener);
  Model<S> linear = model;
  linear.linearised_at = state.x;
  linear.C = outputs.C;
  return update_by_output(linear, state, S(outputs.innovation(i)), y, i, listener);
}

// P ← P0, x̂ stays: after an update or a prediction whose condition does not hold. The condition says that what stays
// is within its bounds; if it is not, all begins anew.
template <class S, class Listener>
auto begin_covariance_anew(const Model<S>& model, State<S>& state, Listener& listener) {
  state.P = model.P0;
  state.U = model.U0;
  state.D = model.D0;
  BoundsCheck<S> check;
  check_estimate(model, state, check, listener);
  check_memory(model, state, check, listener);
  return check.is_within();
}

}  // namespace lqg::step
