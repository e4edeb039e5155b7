// SPDX-License-Identifier: MIT
// Lines with fewer points that look the same.
#pragma once

#include <cstddef>
#include <vector>

namespace lqg::emit {

struct Point {
  double x, y;
};

// The indices, rising, of the points that are needed so that no point is farther from the line than the tolerance; the
// first and the last are among them (D. H. Douglas, T. K. Peucker, Cartographica 10, 1973).
std::vector<std::size_t> needed_points(const std::vector<Point>& line, double tolerance);

}  // namespace lqg::emit
