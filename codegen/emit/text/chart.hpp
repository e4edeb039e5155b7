// SPDX-License-Identifier: MIT
// A chart as data, for both who draw it: svg() below makes a picture that needs neither a script nor a library;
// emit/page hands the same data to the script of the page.
#pragma once

#include <string>
#include <vector>

namespace lqg::emit {

// How a curve is drawn: four lines, a staircase that holds each value until the next, and five points.
enum class Mark { line, dashes, dash_dots, dotted, steps, dots, crosses, pluses, rings, squares };

// Beside the data: grey curves behind them that the data are compared with, and curves that are part of the axes, such
// as the grid of damping in a z plane. Neither stands in the legend without a label.
enum class Role { data, ghost, grid };

struct Curve {
  std::string label;  // for the legend; empty: not in it
  Mark mark = Mark::line;
  int colour = 0;  // of the page's palette, --curve-0 to --curve-6
  std::vector<double> x, y;
  Role role = Role::data;
  std::string owner = {};               // the design that it is of, where several are in one page; empty: the only one
  std::vector<std::string> texts = {};  // point by point what a reader of the live page is told of it; or empty
};

// An area between two curves, behind them: limits, ±3σ around an estimate. Two points are enough for a band of constant
// height.
struct Band {
  std::string label;
  int colour = 0;
  std::vector<double> x, low, high;
  std::string owner = {};
};

// A straight line through the whole chart with a word beside it: a limit, a crossover, a margin, a set point.
struct Guide {
  enum class Axis { x, y } axis = Axis::y;  // the axis on which `at` lies: `y` is a horizontal line
  double at = 0;
  std::string label;
};

// A word at a point, and an arrow there in the direction (dx, dy) where that is not 0: frequencies on a Nyquist curve.
struct Note {
  double x = 0, y = 0;
  std::string text;
  double dx = 0, dy = 0;
};

// Something that happened, a mark on the axis of x: a reset, an output that was left out.
struct EventMark {
  double at = 0;
  std::string label;
};

struct Circle {
  double x = 0, y = 0, radius = 1;
};

struct Axis {
  std::string label = {};  // with its unit: "t [s]"
  bool is_logarithmic = false;
};

struct Chart {
  std::string title;
  std::string id;     // of this chart in every page of the same sort of design: letters, digits and -; empty: none
  std::string group;  // charts of one group have the same x, and share a crosshair and a zoom: "time"; empty: none
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<Band> bands;
  std::vector<Circle> circles;  // in the units of the axes, behind the curves
  std::vector<Guide> guides;
  std::vector<Note> notes;
  std::vector<EventMark> events;
  bool is_square = false;  // one scale for both axes
  // What is shown first, of the axes where low < high; else what the curves and bands need. A square chart has both.
  double x_low = 0, x_high = 0, y_low = 0, y_high = 0;
};

// What svg() shows first, and what the page's script begins with: low < high; > 0 on a logarithmic axis.
struct Window {
  double x_low, x_high, y_low, y_high;
};
Window window_of(const Chart& chart);

// Points that are not finite, outside of the window, or not > 0 on a logarithmic axis interrupt a line. Coordinates
// have one decimal; points that would not be seen are left out.
std::string svg(const Chart& chart);

// Shorter curves that look the same: of each of `most`/2 buckets the first point that is the least and the first that
// is the largest, in their order. Not of points, and not of curves with fewer points than `most`.
Curve reduced(const Curve& curve, std::size_t most);

// Bands are smooth: `most` > 1 points of it, evenly, with both ends.
Band reduced(const Band& band, std::size_t most);

}  // namespace lqg::emit
