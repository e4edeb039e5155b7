// SPDX-License-Identifier: MIT
#include "emit/text/chart.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "design/finding.hpp"
#include "emit/text/chart_axis.hpp"
#include "emit/text/html.hpp"
#include "emit/text/simplify.hpp"

namespace lqg::emit {

namespace {

constexpr double width = 460, plot_height = 130;
constexpr double left = 62, right = 12, plot_width = width - left - right;
constexpr double legend_row = 14;  // a line of the legend

// One decimal of a unit of the picture.
std::string coordinate(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0, std::chars_format::fixed, 1);
  return std::string(text, end.ptr);
}

// What CSS calls a line's style.
const char* style_of(Mark mark) {
  switch (mark) {
    case Mark::dashes: return " dashes";
    case Mark::dash_dots: return " dash-dots";
    case Mark::dotted: return " dotted";
    case Mark::dots: return " dots";
    default: return "";
  }
}

bool is_points(Mark mark) { return mark > Mark::steps; }

// A point of 8 units as the part of a path that begins in its middle.
std::string point_at(Mark mark, double x, double y) {
  const auto from = [&](double dx, double dy) { return "M" + coordinate(x + dx) + " " + coordinate(y + dy); };
  switch (mark) {
    case Mark::dots: return from(0, 0) + "h0";
    case Mark::pluses: return from(-5, 0) + "h10m-5 -5v10";
    case Mark::rings: return from(-4, 0) + "a4 4 0 1 0 8 0a4 4 0 1 0 -8 0";
    case Mark::squares: return from(-4, -4) + "h8v8h-8z";
    default: return from(-4, -4) + "l8 8m0 -8l-8 8";
  }
}

struct LegendEntry {
  std::string label, sample;  // the sample: a path about (0, 0), with its class
};

std::string colour_class(int colour) { return "s" + std::to_string(colour % 7); }

class Picture {
 public:
  explicit Picture(const Chart& chart)
      : chart_(chart), window_(window_of(chart)), x_{window_.x_low, window_.x_high}, y_{window_.y_low, window_.y_high},
        top_(chart.y.label.empty() ? 26 : 36), bottom_(top_ + (chart.is_square ? plot_width : plot_height)) {}

  std::string draw() const {
    double height = bottom_ + 34;
    const std::string legend_lines = legend(height);
    std::string out = "<svg viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height) +
                      "\" role=\"img\" aria-label=\"" + escaped(chart_.title) + "\">\n<text class=\"title\" x=\"" +
                      coordinate(left) + "\" y=\"15\">" + escaped(chart_.title) + "</text>\n";
    for (const Band& band : chart_.bands) out += draw(band);
    out += grid() + labels();
    for (const Circle& circle : chart_.circles) out += draw(circle);
    for (const Role role : {Role::grid, Role::ghost, Role::data})
      for (const Curve& curve : chart_.curves)
        if (curve.role == role) out += draw(curve);
    for (const Guide& guide : chart_.guides) out += draw(guide);
    for (const Note& note : chart_.notes) out += draw(note);
    return out + events() + legend_lines + "</svg>\n";
  }

 private:
  double at_x(double value) const { return left + share_of(x_, chart_.x.is_logarithmic, value) * plot_width; }
  double at_y(double value) const { return bottom_ - share_of(y_, chart_.y.is_logarithmic, value) * (bottom_ - top_); }
  bool shows(double x, double y) const {
    if (!std::isfinite(x) || !std::isfinite(y)) return false;
    return x_.low <= x && x <= x_.high && y_.low <= y && y <= y_.high;
  }

  static std::string line(const char* kind, double x1, double y1, double x2, double y2) {
    return std::string("<line class=\"") + kind + "\" x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) +
           "\" x2=\"" + coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\"/>\n";
  }
  static std::string text(const char* kind, const char* anchor, double x, double y, const std::string& words) {
    if (words.empty()) return "";
    return std::string("<text class=\"") + kind + "\" text-anchor=\"" + anchor + "\" x=\"" + coordinate(x) + "\" y=\"" +
           coordinate(y) + "\">" + escaped(words) + "</text>\n";
  }

  // Numbers at both axes; the lines through 0 are drawn stronger.
  std::string grid() const {
    std::string out;
    for (const double x : ticks(x_, chart_.x.is_logarithmic)) {
      out += line(x == 0 && chart_.is_square ? "zero" : "grid", at_x(x), top_, at_x(x), bottom_);
      out += text("tick", "middle", at_x(x), bottom_ + 13, design::decimal(x));
    }
    for (const double y : ticks(y_, chart_.y.is_logarithmic)) {
      out += line(y == 0 ? "zero" : "grid", left, at_y(y), width - right, at_y(y));
      out += text("tick", "end", left - 5, at_y(y) + 4, design::decimal(y));
    }
    return out;
  }

  std::string labels() const {
    return text("tick", "end", width - right, bottom_ + 28, chart_.x.label) +
           text("tick", "start", left, top_ - 6, chart_.y.label);
  }

  std::string draw(const Band& band) const {
    const auto held = [&](double y) { return coordinate(at_y(std::clamp(y, y_.low, y_.high))); };
    const auto across = [&](double x) { return coordinate(at_x(std::clamp(x, x_.low, x_.high))); };
    const Band shown = reduced(band, 100);
    std::string path;
    for (std::size_t i = 0; i < shown.x.size(); ++i)
      path += (i ? "L" : "M") + across(shown.x[i]) + " " + held(shown.high[i]);
    for (std::size_t i = shown.x.size(); i-- > 0;) path += "L" + across(shown.x[i]) + " " + held(shown.low[i]);
    return "<path class=\"band b" + std::to_string(band.colour % 7) + "\" d=\"" + path + "z\"/>\n";
  }

  std::string draw(const Circle& circle) const {
    return "<ellipse class=\"circle\" cx=\"" + coordinate(at_x(circle.x)) + "\" cy=\"" + coordinate(at_y(circle.y)) +
           "\" rx=\"" + coordinate(circle.radius / x_.size() * plot_width) + "\" ry=\"" +
           coordinate(circle.radius / y_.size() * (bottom_ - top_)) + "\"/>\n";
  }

  std::string draw(const Guide& guide) const {
    const Range& range = guide.axis == Guide::Axis::x ? x_ : y_;
    if (!(range.low <= guide.at && guide.at <= range.high)) return "";
    if (guide.axis == Guide::Axis::y)
      return line("guide", left, at_y(guide.at), width - right, at_y(guide.at)) +
             text("note", "end", width - right - 2, at_y(guide.at) - 3, guide.label);
    const bool is_right = at_x(guide.at) > width / 2;
    return line("guide", at_x(guide.at), top_, at_x(guide.at), bottom_) +
           text("note", is_right ? "end" : "start", at_x(guide.at) + (is_right ? -3 : 3), top_ + 10, guide.label);
  }

  std::string draw(const Note& note) const {
    if (!shows(note.x, note.y)) return "";
    const double x = at_x(note.x), y = at_y(note.y), length = std::hypot(note.dx, note.dy);
    std::string arrow;
    if (length > 0) {
      const double c = 6 * note.dx / length, s = -6 * note.dy / length;
      arrow = "<path class=\"arrow\" d=\"M" + coordinate(x + c) + " " + coordinate(y + s) + "L" +
              coordinate(x - c / 2 - s / 2) + " " + coordinate(y - s / 2 + c / 2) + "L" +
              coordinate(x - c / 2 + s / 2) + " " + coordinate(y - s / 2 - c / 2) + "z\"/>\n";
    }
    const bool is_right = x + 5.5 * static_cast<double>(letters(note.text)) + 8 > width;
    return arrow + text("note", is_right ? "end" : "start", x + (is_right ? -7 : 7), y - 5, note.text);
  }

  std::string events() const {
    std::string path;
    for (const EventMark& event : chart_.events)
      if (x_.low <= event.at && event.at <= x_.high)
        path += "M" + coordinate(at_x(event.at)) + " " + coordinate(bottom_ - 7) + "l-3 6h6z";
    return path.empty() ? "" : "<path class=\"event\" d=\"" + path + "\"/>\n";
  }

  std::vector<LegendEntry> entries() const {
    std::vector<LegendEntry> out;
    const auto add = [&](const std::string& label, const std::string& sample) {
      for (const LegendEntry& entry : out)
        if (entry.label == label) return;
      if (!label.empty()) out.push_back({label, sample});
    };
    for (const Curve& curve : chart_.curves)
      add(curve.label, "class=\"" + class_of(curve) + "\" d=\"" +
                           (is_points(curve.mark) ? point_at(curve.mark, 8, 0) : std::string("M0 0h16")) + "\"");
    for (const Band& band : chart_.bands)
      add(band.label, "class=\"band b" + std::to_string(band.colour % 7) + "\" d=\"M0 -4h16v8h-16z\"");
    for (const EventMark& event : chart_.events) add(event.label, "class=\"event\" d=\"M8 -3l-3 6h6z\"");
    return out;
  }

  // Lines below the chart; each makes the picture higher.
  std::string legend(double& height) const {
    std::string out;
    double at = width;
    for (const LegendEntry& entry : entries()) {
      const double needed = 6.2 * static_cast<double>(letters(entry.label)) + 34;
      if (at + needed > width) at = left, height += legend_row;
      out += "<g transform=\"translate(" + coordinate(at) + " " + coordinate(height - 8) + ")\"><path " + entry.sample +
             "/><text x=\"20\" y=\"4\">" + escaped(entry.label) + "</text></g>\n";
      at += needed;
    }
    return out;
  }

  static std::string class_of(const Curve& curve) {
    const std::string colour = curve.role == Role::data    ? colour_class(curve.colour)
                               : curve.role == Role::ghost ? "ghost"
                                                           : "grid-curve";
    return colour + style_of(curve.mark);
  }

  std::string draw(const Curve& curve) const {
    const std::string path = is_points(curve.mark) ? points(curve) : line_of(curve);
    return "<path class=\"" + class_of(curve) + "\" d=\"" + path + "\"/>\n";
  }

  // Pieces of the curve without a gap.
  std::vector<std::vector<Point>> pieces(const Curve& curve) const {
    std::vector<std::vector<Point>> out;
    bool pen_is_down = false;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const bool shown = shows(curve.x[i], curve.y[i]);
      if (shown && !pen_is_down) out.emplace_back();
      if (shown) out.back().push_back({at_x(curve.x[i]), at_y(curve.y[i])});
      pen_is_down = shown;
    }
    return out;
  }

  std::string line_of(const Curve& curve) const {
    constexpr double invisible = 0.15;  // of a unit of the picture
    std::string path;
    for (const std::vector<Point>& piece : pieces(curve)) {
      if (curve.mark == Mark::steps)
        path += staircase(piece);
      else
        for (const std::size_t i : needed_points(piece, invisible))
          path += (i == 0 ? "M" : "L") + coordinate(piece[i].x) + " " + coordinate(piece[i].y);
    }
    return path;
  }

  // Each value is held until the next that is another.
  static std::string staircase(const std::vector<Point>& piece) {
    std::string path, level;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const std::string x = coordinate(piece[i].x), y = coordinate(piece[i].y);
      if (i == 0)
        path += "M" + x + " " + y;
      else if (y != level)
        path += "H" + x + "V" + y;
      else if (i + 1 == piece.size())
        path += "H" + x;
      level = y;
    }
    return path;
  }

  std::string points(const Curve& curve) const {
    std::string path;
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      if (shows(curve.x[i], curve.y[i])) path += point_at(curve.mark, at_x(curve.x[i]), at_y(curve.y[i]));
    return path;
  }

  const Chart& chart_;
  Window window_;
  Range x_, y_;
  double top_, bottom_;
};

}  // namespace

std::string svg(const Chart& chart) { return Picture(chart).draw(); }

}  // namespace lqg::emit
