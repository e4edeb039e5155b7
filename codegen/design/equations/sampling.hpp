// SPDX-License-Identifier: MIT
// A continuous plant under inputs that are held between samples, its cost integral and its noise, at the
// samples.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// ẋ = A x + B h with h constant over a period; the cost density zᵀ cost z with z = [x; h]; white noise of
// density `noise` on ẋ. An empty `cost` or `noise` is none.
struct HeldPlant {
  RealMatrix A, B;
  RealMatrix cost;
  RealMatrix noise;
};

struct SampledPeriod {
  RealMatrix A, B;   // x⁺ = A x + B h + w
  RealMatrix cost;   // ∫ zᵀ cost z dt = z₀ᵀ (this) z₀, and what the noise adds:
  Real noise_cost;   // E ∫ wᵀ cost_xx w dt, w(t) the noise's part of x(t)
  RealMatrix noise;  // E[w wᵀ] at the end of the period
};

// One period of `sample_time` seconds, by series for a short time that is then doubled: C. F. Van Loan,
// "Computing integrals involving the matrix exponential", IEEE Transactions on Automatic Control 23 (1978),
// 395–404, without its block exponential, which holds e^(−At) and overflows on stiff plants.
SampledPeriod sample(const HeldPlant& plant, const Real& sample_time);

// A period and, with the same h, another one after it.
SampledPeriod followed_by(const SampledPeriod& first, const SampledPeriod& second);

}  // namespace lqg::design
