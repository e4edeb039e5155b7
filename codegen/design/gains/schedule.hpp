// SPDX-License-Identifier: MIT
// The gains of a filter that starts from P0: forward in time.
#pragma once

#include "design/gains/estimator.hpp"
#include "design/sampled/stages.hpp"

namespace lqg::design {

// L and M of sample 0, 1, … and the filter after the last of them (P_prior of the next sample).
struct GainSchedule {
  std::vector<RealMatrix> L, M;
  EstimatorSolution last;  // of the last sample in the table
  bool is_settled = true;  // false: not within the most samples that were allowed
};

// With recovery the gains are those of W and the fictitious noise, the covariances of `last` those of its error.
// `count` gains from P0 on: L = P Cᵀ S⁻¹, M = G Swv S⁻¹, P⁺ = A P Aᵀ + G W Gᵀ − (A L + M) S (A L + M)ᵀ.
GainSchedule gains_forward(const std::vector<SampledStage>& stages, const RealMatrix& P0, int count);

// Until L and M round to those of the steady filter, in the target's reals, and stay there: the table ends with the
// last sample whose gains differ. An entry beside which the difference is less than the rounding of the rounding of
// the largest one in its row has got there too.
GainSchedule gains_until_steady(const std::vector<SampledStage>& stages, const RealMatrix& P0,
                                const EstimatorSolution& steady, Scalar real, int most);

// The most gains whose table the flash of the problem takes, 100,000 at most.
int most_gains(const Problem& problem, const EstimatorSolution& steady);

}  // namespace lqg::design
