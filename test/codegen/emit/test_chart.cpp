// SPDX-License-Identifier: MIT
// Curves as SVG.
#include <cmath>
#include <string>

#include <unity.h>

#include "emit/text/chart.hpp"

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
  // 62 and 12 beside the axes, 26 above and 34 below, of 460 × 190.
  TEST_ASSERT_EQUAL_STRING("M62.0 156.0L255.0 91.0L448.0 26.0", path_of(svg(chart_of({-1, 0, 1}))).c_str());
}

void test_ticks_of_a_small_range_have_the_digits_that_they_need() {
  const std::string picture = svg(chart_of({0, 0.002}));
  for (const char* tick : {">0<", ">0.0005<", ">0.001<", ">0.0015<", ">0.002<"})
    TEST_ASSERT_TRUE_MESSAGE(has(picture, tick), tick);
}

void test_steps_hold_a_value_until_the_next() {
  TEST_ASSERT_EQUAL_STRING("M62.0 156.0H448.0V26.0", path_of(svg(chart_of({0, 1}, Mark::steps))).c_str());
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
  RUN_TEST(test_zero_has_no_sign);
  return UNITY_END();
}
