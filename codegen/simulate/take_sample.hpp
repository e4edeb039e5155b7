// SPDX-License-Identifier: MIT
// One sample of a controller in its surroundings, in the order of its form, as firmware does it.
#pragma once

#include "simulate/emitted_controller.hpp"
#include "simulate/emitted_form.hpp"
#include "simulate/numbers.hpp"

namespace lqg::simulate {

using Eigen::VectorXd;

// What one sample shows.
struct Sample {
  VectorXd y, u, estimate;
  unsigned events = 0;
};

// Surroundings have:
//   controller         the Controller
//   applied            u of the sample before
//   measure(u)         y as the controller is told of it, while u acts
//   given_input()      u where there is no regulator
//   state()            x of the sampled plant, for a regulator alone
//   before_update(emitted, y), after_update(emitted): who watches the filter; these watch nothing.
struct Unwatched {
  template <class Emitted>
  void before_update(const Emitted&, const VectorXd&) {}
  template <class Emitted>
  void after_update(const Emitted&) {}
};

// Each samples `around` in the order of its form, as firmware does.
template <class S, class Around>
Sample take_sample(EmittedController<S>& emitted, Around& around) {
  const Controller& controller = around.controller;
  Sample sample;
  Vector<S> u;
  const auto act = [&] {
    sample.estimate = as_doubles(emitted.estimate());
    if (controller.has.regulator)
      sample.events |= emitted.control(u);
    else
      u = numbers_of<S>(around.given_input());
  };
  const auto hear = [&](const VectorXd& acting) {
    sample.y = around.measure(acting);
    around.before_update(emitted, sample.y);
    sample.events |= emitted.update(numbers_of<S>(sample.y));
    around.after_update(emitted);
  };
  if (controller.is_predictor) {
    act();
    hear(as_doubles(u));
  } else {
    hear(around.applied);
    act();
  }
  sample.events |= emitted.predict(u);
  sample.u = as_doubles(u);
  return sample;
}

// A regulator alone, of the state itself.
template <class S, class Around>
Sample take_sample_of_state(EmittedController<S>& emitted, Around& around) {
  Sample sample;
  Vector<S> u;
  sample.estimate = in_target(around.controller.target, around.state());
  sample.events = emitted.control(numbers_of<S>(sample.estimate), u);
  sample.u = as_doubles(u);
  sample.y = around.measure(sample.u);
  return sample;
}

template <class S, class Around>
Sample take_sample(EmittedForm<S>& emitted, Around& around) {
  Sample sample;
  Vector<S> u;
  if (!around.controller.is_predictor) sample.y = around.measure(around.applied);
  sample.events = emitted.control(numbers_of<S>(sample.y), u);
  sample.estimate = as_doubles(emitted.estimate());
  sample.u = as_doubles(u);
  if (around.controller.is_predictor) sample.y = around.measure(sample.u);
  sample.events |= emitted.advance(numbers_of<S>(sample.y));
  return sample;
}

}  // namespace lqg::simulate
