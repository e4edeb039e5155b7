// SPDX-License-Identifier: MIT
// Second moments in all digits, by corrections from factors in doubles.
#pragma once

#include <optional>
#include <vector>

#include "design/numeric/linear_algebra.hpp"
#include "design/order/moment_map.hpp"

namespace lqg::design::order {

enum class Side { moments, duals };  // P = Σ Φ P Φᵀ + Y, or S = Σ Φᵀ S Φ + Y

// The solution, to all digits in force but those that its condition takes. `rough`: the map of Φ rounded; `near`, when
// not empty: a solution that is near. The digits' own factors where doubles are too coarse; empty where these are
// singular.
std::optional<RealMatrix> refined_moments(const MomentMap<double>& rough, const std::vector<RealMatrix>& Phi,
                                          bool is_continuous, Side side, const RealMatrix& Y, const RealMatrix& near);

}  // namespace lqg::design::order
