// SPDX-License-Identifier: MIT
// Where the search for a point at rest begins.
#pragma once

#include <vector>

#include "design/linearise.hpp"
#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// `given` with the starts of the file at the `unknown` places. Where it has none: first 0, then numbers of all sizes
// and signs, always the same.
std::vector<RealVector> starts_of(const WantedPoint& wanted, const RealVector& given,
                                  const std::vector<Index>& unknown);

}  // namespace lqg::design
