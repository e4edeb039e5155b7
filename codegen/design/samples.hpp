// The problem at the sample instants.
#pragma once

#include <optional>

#include "design/solution.hpp"

namespace lqg::design {

// What the continuous cost counts between the samples beside the sampled weights.
struct BetweenSamples {
  SampledCost cost;    // the sampled integral's weights, of whatever `cost` the design has
  Real noise_cost;     // the process noise's own share of a period
  RealMatrix u_noise;  // nu × nw: the weight uᵀ(u_noise)w on the part of w that v tells; 0 × 0: none
};

struct Samples {
  SampledPlant plant;
  std::optional<SampledCost> cost;  // of the Riccati equation: continuous weights with Cost::continuous
  std::optional<SampledNoise> noise;
  std::optional<BetweenSamples> between;  // of a continuous cost
};

Samples sample(const Problem& problem);

}  // namespace lqg::design
