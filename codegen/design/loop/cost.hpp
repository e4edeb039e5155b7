// SPDX-License-Identifier: MIT
// What the closed loop costs in the long run.
#pragma once

#include "design/loop/compensator.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

struct SteadyCost {
  Real per_sample;                 // E[zᵀQz + 2zᵀNv + vᵀRv], in the sampled weights of a continuous cost
  std::optional<Real> per_second;  // of a continuous cost, the noise between the samples included
};

// Of any controller around the plant of `samples`, which have a cost and a noise. Empty when the loop is not stable.
std::optional<SteadyCost> steady_cost(const Problem& problem, const Samples& samples, const Compensator& controller);

// The same of the controller of `solution`, whose filter is the optimal one: its innovations are white, and half of the
// states are enough. Where the regulator's X is what this loop costs from any state on, X says what each innovation
// costs.
std::optional<SteadyCost> steady_cost(const Problem& problem, const Samples& samples, const Compensator& controller,
                                      const Solution& solution);

}  // namespace lqg::design
