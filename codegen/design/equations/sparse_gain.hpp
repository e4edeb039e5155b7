// SPDX-License-Identifier: MIT
// Gains of which only some entries may differ from zero.
#pragma once

#include "design/equations/riccati.hpp"

namespace lqg::design {

// Minimise tr(X W) over the K (nu × nx) whose entries outside of `kept` (nu × nx of 0 and 1) are zero, X the cost to
// go under u = −Kx: X = (A − BK)ᵀX(A − BK) + Q − NK − KᵀNᵀ + KᵀRK. W (nx × nx) is the covariance of what
// disturbs x in every sample, or of x₀.
struct StructureProblem {
  RiccatiEquation equation;
  RealMatrix W;
  Eigen::MatrixXd kept;
};

enum class StructureFailure {
  none,
  no_start,       // no gain of that structure was found that stabilises
  not_converged,  // the minimum is not isolated, or cannot be told in the digits in force
};

struct StructuredGain {
  StructureFailure failure = StructureFailure::none;
  RealMatrix K, X;
};

// A local minimum: from the `full` gain, its other entries fading away while the kept ones follow, or, when that loses
// stability, from minima for A/γ, B/γ with γ falling to 1. Descent by damped Newton steps in few digits, then chord
// steps in the digits in force. The gradient is 2 ((R + BᵀXB)K − BᵀXA − Nᵀ)P with P = (A − BK)P(A − BK)ᵀ + W: W. S.
// Levine, M. Athans, "On the determination of the optimal constant output feedback gains for linear multivariable
// systems", IEEE Transactions on Automatic Control 15 (1970), 44–48. `start`, when not empty, is the result in fewer
// digits.
StructuredGain structured_gain(const StructureProblem& problem, const RealMatrix& full, const RealMatrix& start);

// Eigenvalues on or outside of the unit circle that A − BK has for every K of that structure (S. H. Wang, E. J.
// Davison, "On the stabilization of decentralized control systems", IEEE Transactions on Automatic Control 18 (1973),
// 473–478): those that two gains without pattern have in common.
std::vector<ComplexReal> fixed_unstable_modes(const StructureProblem& problem);

}  // namespace lqg::design
