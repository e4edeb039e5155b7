// SPDX-License-Identifier: MIT
#include "emit/report/nyquist.hpp"

#include <algorithm>
#include <cmath>

#include "emit/report/sections.hpp"

namespace lqg::emit {

namespace {

// A few frequencies inside of the window, not too close to each other, with the direction of rising frequency.
void mark_frequencies(const LoopCurve& loop, double sample_time, Chart& chart) {
  const double apart = (chart.x_high - chart.x_low) / 5;
  for (std::size_t k = 1; k + 1 < loop.L.size(); ++k) {
    const Complex at = loop.L[k], along = loop.L[k + 1] - loop.L[k - 1];
    const bool is_inside =
        at.real() > chart.x_low && at.real() < chart.x_high && at.imag() > chart.y_low && at.imag() < chart.y_high;
    const bool is_free = std::none_of(chart.notes.begin(), chart.notes.end(), [&](const Note& note) {
      return std::hypot(note.x - at.real(), note.y - at.imag()) < apart;
    });
    if (!is_inside || !is_free) continue;
    const double f = hertz(loop.angles[k], sample_time);
    chart.notes.push_back({at.real(), at.imag(), with_unit(f, "Hz"), along.real(), along.imag()});
  }
}

Curve curve_of(const LoopCurve& loop, double sample_time, bool is_mirrored) {
  Curve curve = {
      is_mirrored ? "f < 0" : "L, f > 0", is_mirrored ? Mark::dashes : Mark::line, is_mirrored ? 5 : 0, {}, {}};
  for (std::size_t k = 0; k < loop.L.size(); ++k) {
    curve.x.push_back(loop.L[k].real());
    curve.y.push_back(is_mirrored ? -loop.L[k].imag() : loop.L[k].imag());
    if (!is_mirrored) curve.texts.push_back(with_unit(hertz(loop.angles[k], sample_time), "Hz"));
  }
  return curve;
}

Chart chart_of(const LoopCurve& loop, double sample_time, const std::optional<double>& disk, const std::string& title,
               double x, double reach) {
  Chart chart;
  chart.title = title;
  chart.x.label = "Re L";
  chart.y.label = "Im L";
  chart.is_square = true;
  chart.x_low = x - reach, chart.x_high = x + reach;
  chart.y_low = -reach, chart.y_high = reach;
  // |S − T| < 2/d keeps L out of the circle through −(2 + d)/(2 − d) and −(2 − d)/(2 + d).
  if (disk && *disk < 2) {
    const double far = (2 + *disk) / (2 - *disk), near = 1 / far;
    chart.circles.push_back({-(far + near) / 2, 0, (far - near) / 2});
  }
  chart.curves = {
      curve_of(loop, sample_time, true), curve_of(loop, sample_time, false), {"−1", Mark::crosses, 1, {-1}, {0}}};
  mark_frequencies(loop, sample_time, chart);
  return chart;
}

}  // namespace

std::vector<Chart> nyquist(const LoopCurve& loop, double sample_time, const std::optional<double>& disk,
                           const std::string& id) {
  constexpr double near = 1.5, far = 20;  // half the side of what is shown
  double largest = 0;
  for (const Complex& l : loop.L) largest = std::max(largest, std::abs(l));
  std::vector<Chart> charts = {chart_of(loop, sample_time, disk, "Nyquist curve about −1", -0.75, near)};
  charts.back().id = id + "-nyquist";
  if (largest < near) return charts;
  charts.push_back(chart_of(loop, sample_time, disk, "Nyquist curve, overview", 0, std::min(far, 1.1 * largest)));
  charts.back().id = id + "-nyquist-all";
  return charts;
}

}  // namespace lqg::emit
