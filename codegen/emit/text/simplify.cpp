// SPDX-License-Identifier: MIT
#include "emit/text/simplify.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lqg::emit {

namespace {

// From the straight line between two points, or from the first where they are one.
double distance_of(const Point& point, const Point& from, const Point& to) {
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length == 0) return std::hypot(point.x - from.x, point.y - from.y);
  return std::abs(dx * (point.y - from.y) - dy * (point.x - from.x)) / length;
}

}  // namespace

std::vector<std::size_t> needed_points(const std::vector<Point>& line, double tolerance) {
  if (line.empty()) return {};
  std::vector<std::size_t> needed = {0, line.size() - 1};
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t farthest = from;
    double distance = tolerance;
    for (std::size_t i = from + 1; i < to; ++i)
      if (const double here = distance_of(line[i], line[from], line[to]); here > distance)
        farthest = i, distance = here;
    if (farthest == from) continue;
    needed.push_back(farthest);
    open.push_back({from, farthest});
    open.push_back({farthest, to});
  }
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  return needed;
}

}  // namespace lqg::emit
