// SPDX-License-Identifier: MIT
// From a linear form in many digits to the constants of a step, rounded once.
#pragma once

#include "controller/model_of.hpp"
#include "step/linear.hpp"

namespace lqg::controller {

template <class S, class Round>
step::LinearModel<S> linear_model_of(const Controller& controller, Round round) {
  const design::LinearForm& form = *controller.linear;
  step::LinearModel<S> model;
  model.predictor_form = controller.is_predictor;
  model.A = convert<S>(form.A, round);
  model.B = convert<S>(form.B, round);
  model.C = convert<S>(form.C, round);
  model.D = convert<S>(form.D, round);
  model.expected = convert<S>(form.expected, round);
  model.estimate = convert<S>(form.estimate, round);
  model.heard = convert<S>(form.heard, round);
  model.of_state = convert<S>(form.of_state, round);
  model.keep = convert<S>(form.keep, round);
  model.z0 = convert<S>(form.z0, round);
  model.point = convert_point<S>(controller.point);
  if (!model.predictor_form) return model;
  model.D.resize(controller.size.nu, 0);
  model.heard.resize(controller.size.nx, 0);
  return model;
}

}  // namespace lqg::controller
