// SPDX-License-Identifier: MIT
// Discrete and continuous algebraic Riccati equations: the stabilising solution, or the reason why there is
// none.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// X = AᵀXA + Q − (AᵀXB + N)(R + BᵀXB)⁻¹(BᵀXA + Nᵀ); the continuous one: 0 = AᵀX + XA + Q − (XB + N)R⁻¹(BᵀX +
// Nᵀ). Shapes: A nx × nx, B nx × nu, Q nx × nx and R nu × nu symmetric, N nx × nu.
struct RiccatiEquation {
  RealMatrix A, B, Q, R, N;
};

enum class RiccatiFailure {
  none,
  no_start,       // no start found whose closed loop is stable
  not_converged,  // a closed-loop pole on the stability limit, or one that cannot be told from it
  not_definite,   // R + BᵀXB (the continuous one: R) is not positive definite
  residual,       // the result does not satisfy the equation
};

struct RiccatiResult {
  RiccatiFailure failure = RiccatiFailure::none;
  RealMatrix X;       // symmetric
  RealMatrix K;       // discrete: (R + BᵀXB)⁻¹(BᵀXA + Nᵀ); continuous: R⁻¹(BᵀX + Nᵀ)
  RealMatrix closed;  // A − BK
  Real condition;     // of the Stein equation Z − closedᵀ Z closed = Y for Z
};

// X = Σ (Aᵀ)ᵏ Y Aᵏ, the solution of X = AᵀXA + Y, by doubling (R. A. Smith, SIAM Journal on Applied
// Mathematics 16 (1968), 198–201). Empty when the powers of A do not vanish: A is not strictly stable.
std::optional<RealMatrix> solve_stein(const RealMatrix& A, const RealMatrix& Y);

// The cost of one step under u = −Kx:  [I −Kᵀ] [Q N; Nᵀ R] [I; −K] = Q − NK − KᵀNᵀ + KᵀRK.
RealMatrix step_cost(const RiccatiEquation& equation, const RealMatrix& K);

// K of a given X, from the discrete equation. Empty when R + BᵀXB is not positive definite.
std::optional<RealMatrix> gain_of(const RiccatiEquation& equation, const RealMatrix& X);

// The stabilising solution, to all digits in force but those that the condition takes. `start`, when not
// empty, is a solution in fewer digits.
RiccatiResult solve_discrete_riccati(const RiccatiEquation& equation, const RealMatrix& start);
RiccatiResult solve_continuous_riccati(const RiccatiEquation& equation, const RealMatrix& start);

}  // namespace lqg::design
