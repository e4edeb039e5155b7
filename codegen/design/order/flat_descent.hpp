// SPDX-License-Identifier: MIT
// Downhill in the digits in force, where the cost is too flat for doubles.
#pragma once

#include <optional>

#include "design/order/closed_loop.hpp"

namespace lqg::design::order {

// Largest number of unknowns of the moments with which this is worth its time.
constexpr Index most_flat_unknowns = 160;

// Newton's method with a shift that is learned (K. Levenberg, Quarterly of Applied Mathematics 2 (1944), 164–168).
// Along the orbit of similarities the Hessian gets a curvature as large as its largest one. Each step lowers the cost.
// Empty where the result is no strict minimum, or `Theta` is not stable.
std::optional<RealMatrix> descend_flat(const LoopFamily<Real>& family, RealMatrix Theta);

}  // namespace lqg::design::order
