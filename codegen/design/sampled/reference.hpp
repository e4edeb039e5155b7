// The feed-forward that makes outputs follow r without bias.
#pragma once

#include <optional>

#include "design/sampled/augmentation.hpp"

namespace lqg::design {

// The set point of r: x = Nx r, u = Nu r with [A − I  B; C_t  D_t] [Nx; Nu] = [0; I] of the tracked outputs. Of many
// set points the one with the least uᵀRu, R of the file, and of these the one with the least xᵀx.
// r has the outputs of `integral` and `track` by rising index; an output that is only integrated has zero columns.
struct SetPoint {
  RealMatrix Nx, Nu;
};

// Empty, with a finding under "lqr.track", when there is none.
std::optional<SetPoint> set_point(const Problem& problem, const SampledPlant& plant, Findings& findings);

// u = −K [x̂ − Nx r; ξ; u[k−1] − Nu r] + Nu r:  Nbar = Nu + K_x Nx; of Δu:  K_x Nx + K_u Nu.
RealMatrix feed_forward(const Problem& problem, const RealMatrix& K, const SetPoint& set_point);

// The outputs that are integrated, ξ by ξ, and those in r; none without a regulator.
const std::vector<int>& integrated_outputs(const Problem& problem);
std::vector<int> reference_outputs(const Problem& problem);

}  // namespace lqg::design
