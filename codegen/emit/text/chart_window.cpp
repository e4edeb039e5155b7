// SPDX-License-Identifier: MIT
// What of a chart is shown first; shorter curves.
#include <algorithm>
#include <cmath>

#include "emit/text/chart.hpp"
#include "emit/text/chart_axis.hpp"

namespace lqg::emit {

namespace {

constexpr Range nothing = {INFINITY, -INFINITY};

bool is_empty(const Range& range) { return !(range.low <= range.high); }

void include(Range& range, double value, bool is_logarithmic) {
  if (!std::isfinite(value) || (is_logarithmic && value <= 0)) return;
  range = {std::min(range.low, value), std::max(range.high, value)};
}

bool is_inside(const Range& range, double value) { return range.low <= value && value <= range.high; }

Range x_of(const Chart& chart) {
  Range range = nothing;
  for (const Curve& curve : chart.curves)
    if (curve.role == Role::data)
      for (const double x : curve.x) include(range, x, chart.x.is_logarithmic);
  return range;
}

// Of the curves where they are inside of `x`.
Range y_of(const Chart& chart, const Range& x) {
  Range range = nothing;
  for (const Curve& curve : chart.curves)
    for (std::size_t i = 0; i < curve.x.size() && curve.role != Role::grid; ++i)
      if (is_inside(x, curve.x[i])) include(range, curve.y[i], chart.y.is_logarithmic);
  return range;
}

// A band may add as much as the curves need on either side, a line half of it: what is far away stays outside.
void make_room(const Chart& chart, const Range& x, Range& range) {
  const Range curves = range;
  const double size = is_empty(curves) ? INFINITY : curves.size() > 0 ? curves.size() : std::abs(curves.high);
  const auto add = [&](double value, double share) {
    const double low = curves.low - share * size, high = curves.high + share * size;
    include(range, is_empty(curves) ? value : std::clamp(value, low, high), chart.y.is_logarithmic);
  };
  for (const Band& band : chart.bands)
    for (std::size_t i = 0; i < band.x.size(); ++i)
      if (is_inside(x, band.x[i]) || band.x.size() == 2) add(band.low[i], 1), add(band.high[i], 1);
  for (const Guide& guide : chart.guides)
    if (guide.axis == Guide::Axis::y &&
        (is_empty(curves) || (guide.at > curves.low - size / 2 && guide.at < curves.high + size / 2)))
      add(guide.at, 0.5);
}

// Something even where all values are the same.
Range widened(const Range& range, bool is_logarithmic) {
  if (is_empty(range)) return is_logarithmic ? Range{1, 10} : Range{0, 1};
  if (is_logarithmic) return range.high > range.low * 1.0001 ? range : Range{range.low / 2, range.high * 2};
  const double least = std::max(1e-12 * std::max(std::abs(range.low), std::abs(range.high)), 1e-300);
  if (range.size() >= least) return range;
  return {range.low - std::max(least, std::abs(range.low)), range.high + std::max(least, std::abs(range.high))};
}

// 3 % more on each side.
Range padded(const Range& range, bool is_logarithmic) {
  if (is_logarithmic) {
    const double factor = std::pow(range.high / range.low, 0.03);
    return {range.low / factor, range.high * factor};
  }
  return {range.low - 0.03 * range.size(), range.high + 0.03 * range.size()};
}

}  // namespace

Window window_of(const Chart& chart) {
  Range x = {chart.x_low, chart.x_high}, y = {chart.y_low, chart.y_high};
  if (!(x.low < x.high)) x = widened(x_of(chart), chart.x.is_logarithmic);
  if (!(y.low < y.high)) {
    y = y_of(chart, x);
    make_room(chart, x, y);
    y = padded(widened(y, chart.y.is_logarithmic), chart.y.is_logarithmic);
  }
  return {x.low, x.high, y.low, y.high};
}

Curve reduced(const Curve& curve, std::size_t most) {
  const std::size_t size = curve.x.size(), buckets = std::max<std::size_t>(most / 2, 1);
  const bool is_line = curve.mark <= Mark::steps;
  if (!is_line || size <= most) return curve;
  Curve out = curve;
  out.x.clear(), out.y.clear();
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    const auto from = curve.y.begin() + static_cast<std::ptrdiff_t>(bucket * size / buckets);
    const auto to = curve.y.begin() + static_cast<std::ptrdiff_t>((bucket + 1) * size / buckets);
    const auto least = std::min_element(from, to), largest = std::max_element(from, to);
    for (const auto& at : {std::min(least, largest), std::max(least, largest)}) {
      out.x.push_back(curve.x[static_cast<std::size_t>(at - curve.y.begin())]);
      out.y.push_back(*at);
      if (least == largest) break;
    }
  }
  return out;
}

Band reduced(const Band& band, std::size_t most) {
  const std::size_t size = band.x.size();
  if (size <= most) return band;
  Band out = {band.label, band.colour, {}, {}, {}, band.owner};
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t at = k * (size - 1) / (most - 1);
    out.x.push_back(band.x[at]);
    out.low.push_back(band.low[at]);
    out.high.push_back(band.high[at]);
  }
  return out;
}

}  // namespace lqg::emit
