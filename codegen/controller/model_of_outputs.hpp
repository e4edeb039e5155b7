// SPDX-License-Identifier: MIT
// The outputs as they are, for those who watch a filter that makes their noise uncorrelated.
#pragma once

#include <algorithm>

#include "controller/model_of.hpp"
#include "design/numeric/digits.hpp"

namespace lqg::controller {

// Gives the model C and D of the plant, and of a filter that carries P the variances of its outputs, the diagonal of
// E⁻¹ diag(V) E⁻ᵀ. `round` turns a Real into an S.
template <class S, class Round>
void take_outputs_as_they_are(const Controller& controller, Round round, step::Model<S>& model) {
  model.C = convert<S>((controller.modal ? controller.modal->plant : controller.solution.plant).C, round);
  if (controller.has.feedthrough) model.D = convert<S>(controller.solution.plant.D, round);
  if (!controller.solution.online) return;
  const design::Digits digits(std::max(controller.solution.numerics.digits, 50u));
  const design::OnlineSolution& online = *controller.solution.online;
  const design::RealMatrix inverse = *design::solve(online.E, design::identity(online.E.rows()));
  model.V = convert<S>(design::congruence(inverse, online.V.asDiagonal()).diagonal(), round);
}

}  // namespace lqg::controller
