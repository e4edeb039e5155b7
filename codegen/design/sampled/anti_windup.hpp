// SPDX-License-Identifier: MIT
// What of ξ is the state's own share, and what becomes of ξ when an input is limited.
#pragma once

#include "design/sampled/augmentation.hpp"

namespace lqg::design {

// Γ, nξ × nx (× nx + nu with `input_rate`, over [x; u[k−1]]): ξ + Γ x stays as it is while the plant moves under u =
// −K' x, K' = Kx − Kξ Γ, which is the law where ξ = −Γ x:
//
//   Γ (A − I − B K') = T (C_i − D_i K')
//
// So ξ + Γ x holds only what the model does not explain: loads, and errors of the model. The equation is solved by
// three passes from K' = Kx on; what repeating it for ever tends to follows the slowest poles, which is worse
// (src/README.md says what was compared).
//
// Empty where a pass has no solution: the loop under K' has a pole at 1.
std::optional<RealMatrix> state_share_of_integrals(const Problem& problem, const SampledPlant& plant,
                                                   const RealMatrix& K);

// H = T D_i − Γ B, nξ × nu (of [B; I] with `input_rate`): with ξ + H (u − v) an input u in place of v leaves ξ + Γ x as
// it was.
RealMatrix anti_windup(const Problem& problem, const SampledPlant& plant, const RealMatrix& Gamma);

}  // namespace lqg::design
