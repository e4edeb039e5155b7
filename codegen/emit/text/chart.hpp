// SPDX-License-Identifier: MIT
// Curves as SVG, for a page that needs neither a script nor a library.
#pragma once

#include <string>
#include <vector>

namespace lqg::emit {

enum class Mark { line, dashes, steps, dots, crosses };

struct Curve {
  std::string label;  // for the legend; empty: not in it
  Mark mark = Mark::line;
  int colour = 0;  // of the page's palette, --curve-0 to --curve-3
  std::vector<double> x, y;
};

struct Circle {
  double x = 0, y = 0, radius = 1;
};

struct Chart {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  std::vector<Circle> circles;                          // in the units of the axes, behind the curves
  bool is_square = false;                               // one scale for both axes, the range is that of x_low … y_high
  double x_low = 0, x_high = 0, y_low = 0, y_high = 0;  // of a square chart; else made of the curves
};

// Points that are not finite, or outside of a square chart, interrupt a line. Coordinates have one decimal.
std::string svg(const Chart& chart);

}  // namespace lqg::emit
