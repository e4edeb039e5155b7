// SPDX-License-Identifier: MIT
#include "emit/text/chart.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "design/finding.hpp"
#include "emit/text/html.hpp"

namespace lqg::emit {

namespace {

constexpr double width = 460, height = 190;
constexpr double left = 62, right = 12, top = 26, bottom = 34;
constexpr double square_height = width - left - right + top + bottom;

// One decimal of a unit of the picture.
std::string coordinate(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0, std::chars_format::fixed, 1);
  return std::string(text, end.ptr);
}

struct Range {
  double low = 0, high = 0;
  double size() const { return high - low; }
};

// Around all finite values; something even where they are all the same.
Range range_of(const std::vector<Curve>& curves, std::vector<double> Curve::* values) {
  Range range = {INFINITY, -INFINITY};
  for (const Curve& curve : curves)
    for (const double value : curve.*values) {
      if (!std::isfinite(value)) continue;
      range = {std::min(range.low, value), std::max(range.high, value)};
    }
  if (!(range.low <= range.high)) return {0, 1};
  const double least = std::max(1e-12 * std::max(std::abs(range.low), std::abs(range.high)), 1e-300);
  if (range.size() < least)
    return {range.low - std::max(least, std::abs(range.low)), range.high + std::max(least, std::abs(range.high))};
  return range;
}

// 1, 2 or 5 times a power of ten: four to nine of it fill the range.
double tick_distance(const Range& range) {
  const double power = std::pow(10, std::floor(std::log10(range.size() / 4)));
  for (const double step : {5.0, 2.0})
    if (range.size() / (step * power) >= 4) return step * power;
  return power;
}

class Picture {
 public:
  explicit Picture(const Chart& chart)
      : chart_(chart), height_(chart.is_square ? square_height : height),
        x_(chart.is_square ? Range{chart.x_low, chart.x_high} : range_of(chart.curves, &Curve::x)),
        y_(chart.is_square ? Range{chart.y_low, chart.y_high} : range_of(chart.curves, &Curve::y)) {}

  std::string draw() const {
    std::string out = "<svg viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height_) +
                      "\" role=\"img\" aria-label=\"" + escaped(chart_.title) + "\">\n<text class=\"title\" x=\"" +
                      coordinate(left) + "\" y=\"15\">" + escaped(chart_.title) + "</text>\n" + grid() + labels();
    for (const Circle& circle : chart_.circles) out += draw(circle);
    for (const Curve& curve : chart_.curves) out += draw(curve);
    return out + legend() + "</svg>\n";
  }

 private:
  double at_x(double value) const { return left + (value - x_.low) / x_.size() * (width - left - right); }
  double at_y(double value) const { return height_ - bottom - (value - y_.low) / y_.size() * (height_ - top - bottom); }

  std::string line(const char* kind, double x1, double y1, double x2, double y2) const {
    return std::string("<line class=\"") + kind + "\" x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) +
           "\" x2=\"" + coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\"/>\n";
  }

  // Numbers at both axes; the lines through 0 are drawn stronger.
  std::string grid() const {
    std::string out;
    const auto each_tick = [](const Range& range, auto visit) {
      const double step = tick_distance(range);
      for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * step; ++k)
        visit(k == 0 ? 0 : k * step, k == 0);  // not −0
    };
    each_tick(x_, [&](double x, bool is_zero) {
      out += line(is_zero && chart_.is_square ? "zero" : "grid", at_x(x), top, at_x(x), height_ - bottom);
      out += "<text class=\"tick\" text-anchor=\"middle\" x=\"" + coordinate(at_x(x)) + "\" y=\"" +
             coordinate(height_ - bottom + 13) + "\">" + design::decimal(x) + "</text>\n";
    });
    each_tick(y_, [&](double y, bool is_zero) {
      out += line(is_zero ? "zero" : "grid", left, at_y(y), width - right, at_y(y));
      out += "<text class=\"tick\" text-anchor=\"end\" x=\"" + coordinate(left - 5) + "\" y=\"" +
             coordinate(at_y(y) + 4) + "\">" + design::decimal(y) + "</text>\n";
    });
    return out;
  }

  std::string labels() const {
    return "<text class=\"tick\" text-anchor=\"end\" x=\"" + coordinate(width - right) + "\" y=\"" +
           coordinate(height_ - 6) + "\">" + escaped(chart_.x_label) + "</text>\n<text class=\"tick\" x=\"4\" y=\"" +
           coordinate(top - 6) + "\">" + escaped(chart_.y_label) + "</text>\n";
  }

  std::string legend() const {
    std::string out;
    double at = width - right;
    for (auto curve = chart_.curves.rbegin(); curve != chart_.curves.rend(); ++curve) {
      if (curve->label.empty()) continue;
      out += "<text class=\"legend c" + std::to_string(curve->colour) + "\" text-anchor=\"end\" x=\"" + coordinate(at) +
             "\" y=\"15\">" + escaped(curve->label) + "</text>\n";
      at -= 7.0 * static_cast<double>(letters(curve->label)) + 12;
    }
    return out;
  }

  std::string draw(const Circle& circle) const {
    return "<ellipse class=\"circle\" cx=\"" + coordinate(at_x(circle.x)) + "\" cy=\"" + coordinate(at_y(circle.y)) +
           "\" rx=\"" + coordinate(circle.radius / x_.size() * (width - left - right)) + "\" ry=\"" +
           coordinate(circle.radius / y_.size() * (height_ - top - bottom)) + "\"/>\n";
  }

  bool shows(double x, double y) const {
    if (!std::isfinite(x) || !std::isfinite(y)) return false;
    return !chart_.is_square || (x_.low <= x && x <= x_.high && y_.low <= y && y <= y_.high);
  }

  std::string draw(const Curve& curve) const {
    if (curve.mark == Mark::dots || curve.mark == Mark::crosses) return points(curve);
    std::string path;
    bool pen_is_down = false;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const bool shown = shows(curve.x[i], curve.y[i]);
      const std::string x = coordinate(at_x(curve.x[i])), y = coordinate(at_y(curve.y[i]));
      if (shown && pen_is_down && curve.mark == Mark::steps)
        path += "H" + x + "V" + y;
      else if (shown)
        path += (pen_is_down ? "L" : "M") + x + " " + y;
      pen_is_down = shown;
    }
    return "<path class=\"s" + std::to_string(curve.colour) + (curve.mark == Mark::dashes ? " dashes" : "") +
           "\" d=\"" + path + "\"/>\n";
  }

  std::string points(const Curve& curve) const {
    std::string path;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!shows(curve.x[i], curve.y[i])) continue;
      const double x = at_x(curve.x[i]), y = at_y(curve.y[i]);
      path += curve.mark == Mark::dots ? "M" + coordinate(x) + " " + coordinate(y) + "h0"
                                       : "M" + coordinate(x - 4) + " " + coordinate(y - 4) + "l8 8m0 -8l-8 8";
    }
    return "<path class=\"s" + std::to_string(curve.colour) + (curve.mark == Mark::dots ? " dots" : "") + "\" d=\"" +
           path + "\"/>\n";
  }

  const Chart& chart_;
  double height_;
  Range x_, y_;
};

}  // namespace

std::string svg(const Chart& chart) { return Picture(chart).draw(); }

}  // namespace lqg::emit
