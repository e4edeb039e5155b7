// SPDX-License-Identifier: MIT
// Curves as SVG.
#include <algorithm>
#include <cmath>
#include <string>

#include <unity.h>

#include "emit/text/chart.hpp"
#include "emit/text/simplify.hpp"

using namespace lqg::emit;

namespace {

Chart chart_of(std::vector<double> y, Mark mark = Mark::line) {
  Chart chart;
  chart.title = "a < b & \"c\"";
  std::vector<double> x;
  for (std::size_t i = 0; i < y.size(); ++i) x.push_back(static_cast<double>(i));
  chart.curves.push_back({"curve", mark, 1, x, std::move(y)});
  return chart;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

std::string path_of(const std::string& svg) {
  const std::size_t from = svg.find(" d=\"") + 4;
  return svg.substr(from, svg.find('"', from) - from);
}

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

void expect_only_numbers(const std::string& svg) {
  for (const char* word : {"nan", "inf", "e+", "e-"}) TEST_ASSERT_FALSE_MESSAGE(has(path_of(svg), word), word);
}

void test_a_line_goes_from_corner_to_corner_of_its_range() {
  // 62 and 12 beside the axes of 460, 26 above 130 of height; 3 % of the range above and below.
  TEST_ASSERT_EQUAL_STRING("M62.0 152.3L255.0 60.3L448.0 29.7", path_of(svg(chart_of({-1, 0.5, 1}))).c_str());
}

void test_ticks_of_a_small_range_have_the_digits_that_they_need() {
  const std::string picture = svg(chart_of({0, 0.002}));
  for (const char* tick : {">0<", ">0.0005<", ">0.001<", ">0.0015<", ">0.002<"})
    TEST_ASSERT_TRUE_MESSAGE(has(picture, tick), tick);
}

void test_steps_hold_a_value_until_the_next() {
  TEST_ASSERT_EQUAL_STRING("M62.0 152.3H448.0V29.7", path_of(svg(chart_of({0, 1}, Mark::steps))).c_str());
}

void test_a_number_that_is_not_finite_interrupts_the_line() {
  for (const double bad : {NAN, INFINITY, -INFINITY}) {
    const std::string picture = svg(chart_of({0, 1, bad, 1, 0}));
    TEST_ASSERT_EQUAL_size_t(2, count(path_of(picture), "M"));
    expect_only_numbers(picture);
  }
}

void test_curves_without_extent_are_drawn_all_the_same() {
  for (const std::vector<double>& y :
       std::vector<std::vector<double>>{{}, {0}, {3, 3}, {1e-300, 1e-300}, {1e18, 1e18}, {NAN}})
    expect_only_numbers(svg(chart_of(y)));
}

void test_a_square_chart_shows_what_lies_inside() {
  Chart chart = chart_of({0, 5, 0.5});
  chart.is_square = true;
  chart.x_low = chart.y_low = -3, chart.x_high = chart.y_high = 3;
  TEST_ASSERT_EQUAL_size_t(2, count(path_of(svg(chart)), "M"));
  chart.circles.push_back({0, 0, 1});
  TEST_ASSERT_TRUE(has(svg(chart), "rx=\"64.3\" ry=\"64.3\""));
}

void test_words_are_escaped() {
  TEST_ASSERT_TRUE(has(svg(chart_of({0, 1})), "a &lt; b &amp; &quot;c&quot;"));
  TEST_ASSERT_FALSE(has(svg(chart_of({0, 1})), "a <"));
}

void test_a_logarithmic_axis_has_decades_and_equal_ratios_are_equally_wide() {
  Chart chart;
  chart.x.is_logarithmic = true;
  chart.curves.push_back({"", Mark::line, 0, {0.01, 1, 100}, {0, 1, 1}});
  const std::string picture = svg(chart);
  for (const char* tick : {">0.01<", ">0.1<", ">1<", ">10<", ">100<"})
    TEST_ASSERT_TRUE_MESSAGE(has(picture, tick), tick);
  TEST_ASSERT_TRUE(has(path_of(picture), "L255.0 29.7"));  // 1 lies in the middle
}

void test_what_is_not_positive_interrupts_a_line_on_a_logarithmic_axis() {
  Chart chart;
  chart.y.is_logarithmic = true;
  chart.curves.push_back({"", Mark::line, 0, {0, 1, 2, 3, 4}, {1, 10, 0, -1, 100}});
  TEST_ASSERT_EQUAL_size_t(2, count(path_of(svg(chart)), "M"));
  expect_only_numbers(svg(chart));
}

void test_a_wide_band_makes_room_for_three_times_the_curves_and_no_more() {
  Chart chart = chart_of({0, 1});
  chart.bands.push_back({"±3σ", 0, {0, 1}, {-1000, -0.5}, {1000, 1.5}});
  const Window window = window_of(chart);
  TEST_ASSERT_EQUAL_DOUBLE(-1 - 0.09, window.y_low);
  TEST_ASSERT_EQUAL_DOUBLE(2 + 0.09, window.y_high);
}

void test_a_limit_that_is_far_away_stays_outside_and_one_that_is_near_is_shown() {
  Chart chart = chart_of({0, 1});
  chart.guides = {{Guide::Axis::y, 12, "far"}, {Guide::Axis::y, 1.4, "near"}};
  TEST_ASSERT_TRUE(window_of(chart).y_high > 1.4 && window_of(chart).y_high < 1.5);
  TEST_ASSERT_TRUE(has(svg(chart), ">near<"));
  TEST_ASSERT_FALSE(has(svg(chart), ">far<"));
}

void test_a_shorter_curve_keeps_its_least_and_its_largest_value_in_their_order() {
  Curve curve = {"", Mark::line, 0, {}, {}};
  for (int k = 0; k < 10000; ++k) curve.x.push_back(k), curve.y.push_back(std::sin(0.01 * k));
  curve.y[1234] = -7, curve.y[1235] = 9;
  const Curve shorter = reduced(curve, 100);
  TEST_ASSERT_TRUE(shorter.x.size() <= 100 && shorter.x.size() > 50);
  TEST_ASSERT_TRUE(std::is_sorted(shorter.x.begin(), shorter.x.end()));
  const auto low = std::find(shorter.y.begin(), shorter.y.end(), -7.0);
  TEST_ASSERT_TRUE(low != shorter.y.end() && *(low + 1) == 9);
  TEST_ASSERT_EQUAL_DOUBLE(1234, shorter.x[static_cast<std::size_t>(low - shorter.y.begin())]);
}

void test_a_straight_line_needs_two_points_and_a_spike_three_more() {
  std::vector<double> y;
  for (int k = 0; k <= 1000; ++k) y.push_back(k);
  TEST_ASSERT_EQUAL_size_t(1, count(path_of(svg(chart_of(y))), "L"));
  y[500] = -1000;
  TEST_ASSERT_EQUAL_size_t(4, count(path_of(svg(chart_of(y))), "L"));
}

void test_no_point_is_farther_from_the_simpler_line_than_the_tolerance() {
  std::vector<Point> line;
  for (int k = 0; k <= 300; ++k) line.push_back({0.1 * k, std::sin(0.1 * k)});
  const std::vector<std::size_t> needed = needed_points(line, 0.01);
  TEST_ASSERT_TRUE(needed.size() < 150 && needed.front() == 0 && needed.back() == 300);
  for (std::size_t i = 0; i + 1 < needed.size(); ++i) {
    const Point from = line[needed[i]], to = line[needed[i + 1]];
    const double dx = to.x - from.x, dy = to.y - from.y;
    for (std::size_t k = needed[i]; k < needed[i + 1]; ++k)
      TEST_ASSERT_TRUE(std::abs(dx * (line[k].y - from.y) - dy * (line[k].x - from.x)) <= 0.01 * std::hypot(dx, dy));
  }
}

void test_steps_that_hold_their_value_are_one_line() {
  const std::string path = path_of(svg(chart_of({0, 0, 0, 0, 1, 1, 1}, Mark::steps)));
  TEST_ASSERT_EQUAL_size_t(1, count(path, "V"));
  TEST_ASSERT_EQUAL_size_t(2, count(path, "H"));
}

void test_points_are_never_left_out() {
  Curve curve = {"", Mark::dots, 0, std::vector<double>(5000, 1.0), std::vector<double>(5000, 2.0)};
  TEST_ASSERT_EQUAL_size_t(5000, reduced(curve, 100).x.size());
}

void test_a_shorter_band_keeps_both_ends() {
  Band band;
  for (int k = 0; k < 1000; ++k) band.x.push_back(k), band.low.push_back(-k), band.high.push_back(k);
  const Band shorter = reduced(band, 10);
  TEST_ASSERT_EQUAL_size_t(10, shorter.x.size());
  TEST_ASSERT_EQUAL_DOUBLE(0, shorter.x.front());
  TEST_ASSERT_EQUAL_DOUBLE(999, shorter.high.back());
}

void test_a_legend_names_each_label_once_and_grey_curves_never() {
  Chart chart = chart_of({0, 1});
  chart.curves.push_back({"", Mark::line, 0, {0, 1}, {0, 0}, Role::ghost});
  chart.curves.push_back({"curve", Mark::line, 1, {0, 1}, {1, 0}});
  const std::string picture = svg(chart);
  TEST_ASSERT_EQUAL_size_t(1, count(picture, ">curve<"));
  TEST_ASSERT_TRUE(has(picture, "class=\"ghost\""));
}

void test_an_event_is_a_mark_on_the_axis() {
  Chart chart = chart_of({0, 1, 2});
  chart.events = {{1, "reset"}, {99, "reset"}};  // one of them is outside
  TEST_ASSERT_TRUE(has(svg(chart), "<path class=\"event\" d=\"M255.0 149.0l-3 6h6z\"/>"));
  TEST_ASSERT_EQUAL_size_t(1, count(svg(chart), ">reset<"));
}

void test_zero_has_no_sign() { TEST_ASSERT_FALSE(has(svg(chart_of({-1, 1})), ">-0<")); }

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_line_goes_from_corner_to_corner_of_its_range);
  RUN_TEST(test_ticks_of_a_small_range_have_the_digits_that_they_need);
  RUN_TEST(test_steps_hold_a_value_until_the_next);
  RUN_TEST(test_a_number_that_is_not_finite_interrupts_the_line);
  RUN_TEST(test_curves_without_extent_are_drawn_all_the_same);
  RUN_TEST(test_a_square_chart_shows_what_lies_inside);
  RUN_TEST(test_words_are_escaped);
  RUN_TEST(test_a_logarithmic_axis_has_decades_and_equal_ratios_are_equally_wide);
  RUN_TEST(test_what_is_not_positive_interrupts_a_line_on_a_logarithmic_axis);
  RUN_TEST(test_a_wide_band_makes_room_for_three_times_the_curves_and_no_more);
  RUN_TEST(test_a_limit_that_is_far_away_stays_outside_and_one_that_is_near_is_shown);
  RUN_TEST(test_a_shorter_curve_keeps_its_least_and_its_largest_value_in_their_order);
  RUN_TEST(test_a_straight_line_needs_two_points_and_a_spike_three_more);
  RUN_TEST(test_no_point_is_farther_from_the_simpler_line_than_the_tolerance);
  RUN_TEST(test_steps_that_hold_their_value_are_one_line);
  RUN_TEST(test_points_are_never_left_out);
  RUN_TEST(test_a_shorter_band_keeps_both_ends);
  RUN_TEST(test_a_legend_names_each_label_once_and_grey_curves_never);
  RUN_TEST(test_an_event_is_a_mark_on_the_axis);
  RUN_TEST(test_zero_has_no_sign);
  return UNITY_END();
}
