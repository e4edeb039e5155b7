// SPDX-License-Identifier: MIT
#include "view/merge_charts.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace lqg::view {

namespace {

using emit::Chart;
using emit::Curve;
using emit::Mark;
using emit::Role;

constexpr int colours = 7;  // of the page's palette
const std::array<Mark, 4> lines = {Mark::line, Mark::dashes, Mark::dash_dots, Mark::dotted};

bool is_data(const Curve& curve) { return curve.role == Role::data; }

bool is_line(Mark mark) { return std::find(lines.begin(), lines.end(), mark) != lines.end(); }

// Whether the curves of one design are told apart without their colours. A staircase looks like a line in the legend.
bool has_mark_for_each(const Chart& chart) {
  std::set<Mark> marks;
  for (const Curve& curve : chart.curves)
    if (is_data(curve) && !curve.label.empty() &&
        !marks.insert(curve.mark == Mark::steps ? Mark::line : curve.mark).second)
      return false;
  return true;
}

std::string owned(const std::string& label, const std::string& owner) {
  return label.empty() ? owner : label + ", " + owner;
}

// A chart with one curve needs no label when it is alone.
void label_curves(Chart& chart, const std::string& owner) {
  const bool has_labels = std::any_of(chart.curves.begin(), chart.curves.end(),
                                      [](const Curve& curve) { return is_data(curve) && !curve.label.empty(); });
  bool is_first = true;
  for (Curve& curve : chart.curves) {
    if (!is_data(curve)) continue;
    if (has_labels ? !curve.label.empty() : is_first) curve.label = owned(curve.label, owner);
    is_first = false;
  }
}

template <class Element, class Same>
void add_new(std::vector<Element>& list, const std::vector<Element>& more, const Same& same) {
  for (const Element& element : more)
    if (std::none_of(list.begin(), list.end(), [&](const Element& other) { return same(other, element); }))
      list.push_back(element);
}

// The range of both; the whole range of the data, low = high = 0, where one of them asks for that.
void widen(double& low, double& high, double other_low, double other_high) {
  const bool has_both = low < high && other_low < other_high;
  low = has_both ? std::min(low, other_low) : 0;
  high = has_both ? std::max(high, other_high) : 0;
}

// Limits that two designs share, whose runs may differ in length.
bool has_same_ends(const emit::Band& a, const emit::Band& b) {
  if (a.low.empty() || b.low.empty()) return a.low.empty() && b.low.empty();
  return a.low.front() == b.low.front() && a.low.back() == b.low.back() && a.high.front() == b.high.front() &&
         a.high.back() == b.high.back();
}

void make_square(Chart& chart) {
  const double width = chart.x_high - chart.x_low, height = chart.y_high - chart.y_low;
  const double more_x = std::max(0.0, height - width) / 2, more_y = std::max(0.0, width - height) / 2;
  chart.x_low -= more_x, chart.x_high += more_x;
  chart.y_low -= more_y, chart.y_high += more_y;
}

}  // namespace

Chart owned_chart(Chart chart, const std::string& owner, std::size_t number) {
  const bool by_colour = has_mark_for_each(chart);
  const int colour = static_cast<int>(number) % colours;
  label_curves(chart, owner);
  for (Curve& curve : chart.curves) {
    if (!is_data(curve)) continue;
    if (by_colour)
      curve.colour = colour;
    else if (is_line(curve.mark))
      curve.mark = lines[number % lines.size()];
    else
      curve.colour = (curve.colour + colour) % colours;
  }
  for (emit::Band& band : chart.bands) {
    band.label = band.label.empty() ? "" : owned(band.label, owner);
    if (by_colour) band.colour = colour;
  }
  if (number > 0) chart.notes.clear();
  for (emit::EventMark& event : chart.events) event.label = owned(event.label, owner);
  return chart;
}

void lay_over(Chart& chart, const Chart& other) {
  for (const Curve& curve : other.curves)
    if (is_data(curve)) chart.curves.push_back(curve);
  add_new(chart.bands, other.bands, has_same_ends);
  chart.events.insert(chart.events.end(), other.events.begin(), other.events.end());
  add_new(chart.guides, other.guides,
          [](const emit::Guide& a, const emit::Guide& b) { return a.axis == b.axis && a.at == b.at; });
  add_new(chart.circles, other.circles, [](const emit::Circle& a, const emit::Circle& b) {
    return a.x == b.x && a.y == b.y && a.radius == b.radius;
  });
  widen(chart.x_low, chart.x_high, other.x_low, other.x_high);
  widen(chart.y_low, chart.y_high, other.y_low, other.y_high);
  if (chart.is_square) make_square(chart);
}

}  // namespace lqg::view
