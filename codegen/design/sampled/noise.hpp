// SPDX-License-Identifier: MIT
// The noise on states and outputs, from whichever keys gave it.
#pragma once

#include "design/solution.hpp"

namespace lqg::design {

// W, V, Swv of ẋ (or x⁺) = … + G w and y = … + v' with v' = H w + v:
//   V' = V + H W Hᵀ + H Swv + (H Swv)ᵀ,  Swv' = W Hᵀ + Swv
// densities or covariances, as the file has them. Noise with a correlation time τ, a variance in the file, is white
// beside a slow plant with the density 2τ times it: 2√(τᵢτⱼ) between two of them. Empty without noise (placed poles).
SampledNoise noise_of(const Problem& problem);

}  // namespace lqg::design
