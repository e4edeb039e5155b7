// SPDX-License-Identifier: MIT
// The emitted controller that keeps z, at work: as emitted_controller.hpp.
#pragma once

#include "controller/linear_model_of.hpp"
#include "step/operating_point.hpp"

namespace lqg::simulate {

using controller::Controller;
using step::Vector;

template <class S>
class EmittedForm {
 public:
  template <class Constants>
  EmittedForm(const Controller& controller, Constants constants)
      : model_(controller::linear_model_of<S>(controller, constants)), state_(step::initial_state(model_)) {}

  void init() {
    state_ = step::initial_state(model_);
    resets_ = 0;
  }
  // In predictor form y is not looked at.
  unsigned control(const Vector<S>& y, Vector<S>& u) {
    step::Listener listener;
    const Vector<S> deviations = step::output_deviations(model_.point, y, listener);
    u = step::own_input(model_.point, step::control(model_, state_, deviations, listener), listener);
    return listener.events;
  }
  // In filter form control has heard y.
  unsigned advance(const Vector<S>& y) {
    step::Listener listener;
    const Vector<S> deviations = step::output_deviations(model_.point, y, listener);
    const Vector<S> heard =
        model_.predictor_form ? step::heard_outputs(model_, state_, deviations, listener) : state_.y;
    return end(step::advance(model_, state_, heard, listener), listener);
  }
  unsigned set_state(const Vector<S>& x) {
    step::Listener listener;
    const Vector<S> deviations = step::state_deviations(model_.point, x, listener);
    return end(step::set_state(model_, state_, deviations, listener), listener);
  }
  // x̂ that u is made of, between the two.
  Vector<S> estimate() const {
    step::Listener listener;
    return step::own_state(model_.point, step::estimate(model_, state_, listener), listener);
  }

  const step::LinearModel<S>& model() const { return model_; }
  step::LinearState<S>& state() { return state_; }
  const step::LinearState<S>& state() const { return state_; }
  unsigned long resets() const { return resets_; }

 private:
  unsigned end(bool is_finite, step::Listener& listener) {
    if (is_finite) return listener.events;
    state_ = step::initial_state(model_);
    ++resets_;
    listener.raise(step::Event::state_reset, true);
    return listener.events;
  }

  step::LinearModel<S> model_;
  step::LinearState<S> state_;
  unsigned long resets_ = 0;
};

}  // namespace lqg::simulate
