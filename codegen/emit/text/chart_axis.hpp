// SPDX-License-Identifier: MIT
// The range of an axis, and its ticks: 1, 2 or 5 times a power of ten.
#pragma once

#include <vector>

namespace lqg::emit {

struct Range {
  double low = 0, high = 0;
  double size() const { return high - low; }
};

// Four to nine ticks that fill the range; on a logarithmic one every decade, with 2 and 5 of it where there are fewer
// than three, and not every decade where there are more than eight.
std::vector<double> ticks(const Range& range, bool is_logarithmic);

// From 0 to 1 in the range.
double share_of(const Range& range, bool is_logarithmic, double value);

}  // namespace lqg::emit
