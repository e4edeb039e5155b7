// SPDX-License-Identifier: MIT
// X = AᵀXA + Y where A has few entries that are not zero.
#pragma once

#include <optional>

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// As solve_stein, by iterative refinement: corrections come from a Stein equation in double, residuals are taken in all
// digits and cost what A's entries cost. By solve_stein itself where double is too coarse for that.
std::optional<RealMatrix> refined_stein(const RealMatrix& A, const RealMatrix& Y);

}  // namespace lqg::design
