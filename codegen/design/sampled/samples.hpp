// SPDX-License-Identifier: MIT
// The problem at the sample instants.
#pragma once

#include <optional>

#include "design/sampled/delay.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// What the continuous cost counts between the samples beside the sampled weights.
struct BetweenSamples {
  SampledCost cost;    // the sampled integral's weights, of whatever `cost` the design has
  Real noise_cost;     // the process noise's own share of a period
  RealMatrix u_noise;  // nu × nw: the weight uᵀ(u_noise)w on the part of w that v tells; 0 × 0: none
};

// With a delay the plant's and the cost's state is [x; the inputs on their way, the oldest first]. Where added_states
// has made more of x, `start` says what of it follows from x0.
struct Samples {
  SampledPlant plant;
  Eigen::Index own_states = 0;      // of the plant's states those that are not inputs on their way
  std::optional<SampledCost> cost;  // of the Riccati equation; with Cost::continuous the file's weights
  std::optional<SampledNoise> noise;
  std::optional<BetweenSamples> between;  // of a continuous cost
  RealMatrix start;                       // own_states × of x0, or empty: x0 itself
  RealMatrix fictitious;                  // with recovery: what the filter's gain takes for noise of the states, too
};

// A delay and cost = "continuous" do not go together.
Samples sample(const Problem& problem);
Samples sample(const Problem& problem, const Delay& delay);  // instead of the plant's own

// The plant without the inputs on their way, which its controller knows; B and D are empty.
SampledPlant own_plant(const Samples& samples);

// x0 and P0 of the file over all states of `samples`, with nothing to learn of the inputs on their way.
RealMatrix initial_state(const Estimator& estimator, const Samples& samples);
RealMatrix initial_covariance(const Estimator& estimator, const Samples& samples);

}  // namespace lqg::design
