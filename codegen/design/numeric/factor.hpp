// SPDX-License-Identifier: MIT
// Triangular factors of symmetric matrices.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// P = U diag(d) Uᵀ, U unit triangular.
struct Factors {
  RealMatrix U;
  RealVector d;
};

// Lower triangular U, pivots from the first row on. Stops being meaningful at a pivot ≤ 0: such d say that P
// is not positive definite.
Factors lower_factors(const RealMatrix& P);

// Upper triangular U, pivots from the last row on; P may be singular. A pivot below 10^−40 of its diagonal
// entry counts as an exact zero, with a zero column of U above its 1: that moves no entry of P by more than
// 10^−20 √(P_ii P_jj).
Factors upper_factors(const RealMatrix& P);

bool positive_definite(const RealMatrix& P);

// The least eigenvalue of P after its rows and columns have been scaled to a unit diagonal: unit-free.
Real least_scaled_eigenvalue(const RealMatrix& P);

}  // namespace lqg::design
