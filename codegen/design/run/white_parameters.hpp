// SPDX-License-Identifier: MIT
// White parameters of the file at the plant's samples, and what they make of loops.
#pragma once

#include <optional>
#include <vector>

#include "design/loop/compensator.hpp"
#include "design/order/order_search.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

// One for each table [[uncertain]], for each output that drops out, and for the jitter, over all states of `samples`:
//   dropout p of output i:  C x is 0 with probability p; its mean is (1 − p) C_i x, which `samples` have; C₁ has the
//                           row √(p (1 − p)) C_i
//   jitter σ of a period:   to the first order A₁ = σ dA/dT = σ A_c A, B₁ = σ dB/dT = σ A B_c of the sampled A and B
// Weights and noises of a period are those of the mean one.
std::vector<WhiteParameter> white_parameters(const Problem& problem, const Samples& samples);

// What a compensator of the design sees: MeasuredPlant with the noises and the weights of its samples.
OrderProblem order_problem(const Problem& problem, const Samples& samples);

// P = Σ Φ_j P Φ_jᵀ + V; of one Φ and of several. Empty where the map P → Σ Φ_j P Φ_jᵀ is not stable.
std::optional<RealMatrix> steady_second_moments(const std::vector<RealMatrix>& Phi, const RealMatrix& V);

// [x; z] of plant and controller in the mean and for each white parameter, and the covariance of what the noises add.
// (The parameter's B)(the controller's D)(the parameter's C) is not in it: one of them is 0.
struct WhiteLoop {
  std::vector<RealMatrix> Phi;
  RealMatrix V;
};
WhiteLoop white_loop(const OrderProblem& problem, const MeasuredPlant& plant, const Compensator& controller);

// E[xᵀQx + 2xᵀNu + uᵀRu] under the white parameters; empty: without bound.
std::optional<Real> white_cost(const OrderProblem& problem, const MeasuredPlant& plant, const Compensator& controller);

// The factor by which the second moments of a loop grow in a sample, at the worst.
double growth_of(const std::vector<RealMatrix>& Phi);

}  // namespace lqg::design
