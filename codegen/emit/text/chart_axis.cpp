// SPDX-License-Identifier: MIT
#include "emit/text/chart_axis.hpp"

#include <algorithm>
#include <cmath>

namespace lqg::emit {

namespace {

// 1, 2 or 5 times a power of ten: four to nine of it fill the range.
double tick_distance(const Range& range) {
  const double power = std::pow(10, std::floor(std::log10(range.size() / 4)));
  for (const double step : {5.0, 2.0})
    if (range.size() / (step * power) >= 4) return step * power;
  return power;
}

std::vector<double> even_ticks(const Range& range) {
  std::vector<double> out;
  const double step = tick_distance(range);
  for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * step; ++k)
    out.push_back(k == 0 ? 0 : k * step);  // not −0
  return out;
}

std::vector<double> ticks_of_decades(const Range& range) {
  const int first = static_cast<int>(std::floor(std::log10(range.low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(range.high) - 1e-9));
  const int stride = std::max(1, (last - first + 7) / 8);
  const std::vector<double> in_decade = last - first < 3 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
  std::vector<double> out;
  for (int decade = first; decade <= last; decade += stride)
    for (const double step : in_decade) {
      const double value = step * std::pow(10, decade);
      if (value >= range.low * (1 - 1e-9) && value <= range.high * (1 + 1e-9)) out.push_back(value);
    }
  return out;
}

}  // namespace

std::vector<double> ticks(const Range& range, bool is_logarithmic) {
  return is_logarithmic ? ticks_of_decades(range) : even_ticks(range);
}

double share_of(const Range& range, bool is_logarithmic, double value) {
  if (!is_logarithmic) return (value - range.low) / range.size();
  return (std::log10(value) - std::log10(range.low)) / (std::log10(range.high) - std::log10(range.low));
}

}  // namespace lqg::emit
