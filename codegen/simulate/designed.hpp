// SPDX-License-Identifier: MIT
// What the design says of the noises and the cost in a sample.
#pragma once

#include "controller/controller.hpp"

namespace lqg::simulate {

using controller::Controller;

enum class PlantNoise {
  none,
  designed,  // w and v as the design has them; none where it has no noise
  assumed,   // the same; beside an observer, whose design says nothing of noise, a variance of 1e-4 everywhere
};

// F Fᵀ = E[n nᵀ] of n = [G w; v], lower triangular.
Eigen::MatrixXd noise_factor(const Controller& controller, std::size_t sample, PlantNoise wanted);

// nullptr without one.
const design::SampledCost* sampled_cost(const Controller& controller, std::size_t sample);

}  // namespace lqg::simulate
