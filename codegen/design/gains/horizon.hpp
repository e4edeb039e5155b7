// SPDX-License-Identifier: MIT
// Gains of a problem that ends, or that changes on the way: backward from the end.
#pragma once

#include "design/gains/regulator.hpp"
#include "design/sampled/stages.hpp"

namespace lqg::design {

struct GainTable {
  std::vector<RealMatrix> K;   // of step 0, 1, …
  RealMatrix X_first, X_last;  // the cost to go from step 0, and from the last step that has a gain
  int failed_at = -1;          // the step whose R + BᵀXB is not positive definite
};

// K[k] and X[k] for k = steps − 1 … 0 from X[steps] = X_end over z.
//   discrete:    K = (R + BᵀX⁺B)⁻¹(BᵀX⁺A + Nᵀ),  X = Q − NK − KᵀNᵀ + KᵀRK + (A − BK)ᵀX⁺(A − BK)
//   continuous:  −Ẋ = AᵀX + XA + Q − (XB + N)R⁻¹(BᵀX + Nᵀ) over a period, K = R⁻¹(BᵀX + Nᵀ) at its begin
// An input that neither costs nor does anything until the end stays 0.
GainTable gains_backward(const std::vector<SampledStage>& stages, int steps, const RealMatrix& X_end);

// Q_final over x, as one over z.
RealMatrix final_weight(const SampledStage& last, const Eigen::MatrixXd& Q_final);

}  // namespace lqg::design
