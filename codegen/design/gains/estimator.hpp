// SPDX-License-Identifier: MIT
// The steady Kalman filter, and the same filter prepared for the target to carry its covariance.
#pragma once

#include "design/equations/riccati.hpp"
#include "design/finding.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

// The dual Riccati equation: Aᵀ, Cᵀ, GWGᵀ (with recovery and the fictitious noise), V, G Swv in the places of A, B, Q,
// R, N; its X is P_prior, its K is L_predictorᵀ; `closed` is that of the plant's own states. `start` is P_prior in
// fewer digits, or empty.
RiccatiResult solve_estimator(const Samples& samples, const RealMatrix& start);

// The continuous equation of a continuous plant with continuous noise, A P + P Aᵀ + GWGᵀ = (P Cᵀ + G Swv) V⁻¹ (…)ᵀ: X
// is P, K is Lᵀ (R. E. Kalman and R. S. Bucy, Journal of Basic Engineering 83 (1961), 95–108).
RiccatiResult solve_continuous_estimator(const Problem& problem, const RealMatrix& start);

// All of the filter that follows from P_prior; the poles stay empty.
EstimatorSolution filter_of(const Samples& samples, const RealMatrix& P_prior);

// The covariance of the error x − x̂ under the noise of `samples`, for any gain, which may be made for other noise.
// A sample later, by Joseph's form, which stays definite:
//   F P Fᵀ + [G −L_p] [W Swv; Swvᵀ V] [G −L_p]ᵀ,  F = A − L_p C.
RealMatrix next_error(const Samples& samples, const RealMatrix& L_predictor, const RealMatrix& P_prior);
// In the long run; empty when the filter is not stable.
std::optional<RealMatrix> steady_error(const Samples& samples, const RealMatrix& L_predictor);
// P_prior, and the P_posterior and S that follow from it with the gain of `filter`.
void set_error(const Samples& samples, const RealMatrix& P_prior, EstimatorSolution& filter);

OnlineSolution online_filter(const Estimator& estimator, const Samples& samples);

// Says under the right key why there is no filter.
void explain_estimator(RiccatiFailure failure, Findings& findings);

}  // namespace lqg::design
