// SPDX-License-Identifier: MIT
// Limits in the target's numbers.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace lqg::controller {

// The number of the target next to `limit` that does not lie outside it (`inward` is −1 for u_max, +1 for u_min);
// an infinite limit stays infinite.
inline double limit_of_target(double limit, int inward, bool is_double) {
  if (is_double || std::isinf(limit)) return limit;
  const float near = static_cast<float>(limit);
  const bool outside = inward < 0 ? static_cast<double>(near) > limit : static_cast<double>(near) < limit;
  return outside ? std::nextafter(near, inward < 0 ? -INFINITY : INFINITY) : near;
}

}  // namespace lqg::controller
