// What the closed loop costs in the long run.
#pragma once

#include "design/samples.hpp"

namespace lqg::design {

struct SteadyCost {
  Real per_sample;                 // E[xᵀQx + 2xᵀNu + uᵀRu], in the sampled weights of a continuous cost
  std::optional<Real> per_second;  // of a continuous cost, the noise between the samples included
};

// `solution` has a regulator and an estimator.
SteadyCost steady_cost(const Problem& problem, const Samples& samples, const Solution& solution);

}  // namespace lqg::design
