// SPDX-License-Identifier: MIT
// The Riccati differential equation over one period.
#pragma once

#include "design/equations/riccati.hpp"

namespace lqg::design {

// X(0) = H + AᵀX(T)(I + G X(T))⁻¹A: what a period does to any X at its end, all of it exact.
struct RiccatiFlow {
  RealMatrix A, G, H;
};

// −Ẋ = AᵀX + XA + Q − (XB + N)R⁻¹(BᵀX + Nᵀ), R > 0, over T seconds: the exponential of the Hamiltonian
// [A − BR⁻¹Nᵀ  −BR⁻¹Bᵀ; −(Q − NR⁻¹Nᵀ)  −(A − BR⁻¹Nᵀ)ᵀ] for a short time, solved for what does not grow, then doubled
// as in the structure-preserving algorithm (see riccati.cpp). Empty when a step is singular.
std::optional<RiccatiFlow> riccati_flow(const RiccatiEquation& continuous, const Real& T);

// X(0) of X(T).
std::optional<RealMatrix> carried_back(const RiccatiFlow& flow, const RealMatrix& X);

}  // namespace lqg::design
