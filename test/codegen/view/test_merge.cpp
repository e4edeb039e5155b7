// SPDX-License-Identifier: MIT
// Pages over each other: nothing of any design is lost, and a person can tell whose it is.
#include <set>
#include <string>

#include <unity.h>

#include "view/merge.hpp"
#include "view/merge_charts.hpp"

using namespace lqg;
using namespace lqg::view;

namespace {

emit::Chart chart(const std::string& id, std::vector<emit::Curve> curves) {
  emit::Chart chart;
  chart.id = id;
  chart.title = id;
  chart.curves = std::move(curves);
  return chart;
}

emit::Curve curve(const std::string& label, double y, emit::Mark mark = emit::Mark::line, int colour = 0) {
  return {label, mark, colour, {0, 1}, {0, y}};
}

OwnedPage page(const std::string& owner, emit::PageView view) {
  emit::PageData data;
  data.title = owner;
  data.sections = {{"s", "Section", {std::move(view)}}};
  return {owner, data};
}

emit::PageView view_of(std::vector<emit::Chart> charts, std::vector<emit::PageTable> tables = {}) {
  emit::PageView view;
  view.charts = std::move(charts);
  view.tables = std::move(tables);
  return view;
}

void test_charts_with_one_id_become_one_with_the_curves_of_all() {
  const auto sections = merged_sections({page("a", view_of({chart("x", {curve("", 1)})})),
                                         page("b", view_of({chart("x", {curve("", 2)}), chart("z", {curve("", 3)})}))});
  TEST_ASSERT_EQUAL_UINT(1, sections.size());
  const auto& charts = sections[0].views[0].charts;
  TEST_ASSERT_EQUAL_UINT(2, charts.size());
  TEST_ASSERT_EQUAL_UINT(2, charts[0].curves.size());
  TEST_ASSERT_EQUAL_STRING("a", charts[0].curves[0].label.c_str());
  TEST_ASSERT_EQUAL_STRING("b", charts[0].curves[1].label.c_str());
  TEST_ASSERT_EQUAL_DOUBLE(2, charts[0].curves[1].y[1]);
  TEST_ASSERT_EQUAL_STRING("b", charts[1].curves[0].label.c_str());
}

// Each curve with a label of its own is drawn in a way of its own.
void expect_all_different(const emit::Chart& merged) {
  std::set<std::string> labels;
  std::set<std::pair<int, int>> ways;
  for (const emit::Curve& one : merged.curves) {
    labels.insert(one.label);
    ways.insert({one.colour, static_cast<int>(one.mark)});
  }
  TEST_ASSERT_EQUAL_UINT(merged.curves.size(), labels.size());
  TEST_ASSERT_EQUAL_UINT(merged.curves.size(), ways.size());
}

void test_no_two_curves_look_the_same() {
  for (const bool has_colours : {false, true}) {
    const auto of = [&](const char* owner, std::size_t number) {
      return owned_chart(chart("x", {curve("S", 1, emit::Mark::line, 0),
                                     curve("T", 2, has_colours ? emit::Mark::line : emit::Mark::dashes, 1)}),
                         owner, number);
    };
    emit::Chart merged = of("a", 0);
    lay_over(merged, of("b", 1));
    lay_over(merged, of("c", 2));
    TEST_ASSERT_EQUAL_UINT(6, merged.curves.size());
    TEST_ASSERT_EQUAL_STRING("T, b", merged.curves[3].label.c_str());
    expect_all_different(merged);
  }
}

void test_the_grid_stands_once_and_has_no_owner() {
  emit::Curve grid = curve("", 5);
  grid.role = emit::Role::grid;
  emit::Chart merged = owned_chart(chart("x", {grid, curve("", 1)}), "a", 0);
  lay_over(merged, owned_chart(chart("x", {grid, curve("", 2)}), "b", 1));
  TEST_ASSERT_EQUAL_UINT(3, merged.curves.size());
  TEST_ASSERT_EQUAL_STRING("", merged.curves[0].label.c_str());
}

void test_a_staircase_and_a_line_keep_their_colours() {
  const emit::Chart own =
      owned_chart(chart("x", {curve("true", 1), curve("reference", 2, emit::Mark::steps, 6)}), "b", 1);
  TEST_ASSERT_TRUE(own.curves[0].mark == emit::Mark::dashes && own.curves[0].colour == 0);
  TEST_ASSERT_TRUE(own.curves[1].colour != own.curves[0].colour || own.curves[1].mark != own.curves[0].mark);
}

void test_limits_that_both_have_stand_once() {
  emit::Chart a = chart("x", {curve("", 1)}), b = a;
  a.bands = {{"within limits", 0, {0, 1}, {-1, -1}, {1, 1}}};
  b.bands = {{"within limits", 0, {0, 2}, {-1, -1}, {1, 1}}, {"3σ", 0, {0, 2}, {-3, -1}, {3, 1}}};
  lay_over(a, b);
  TEST_ASSERT_EQUAL_UINT(2, a.bands.size());
}

void test_a_window_holds_both_and_a_square_stays_one() {
  emit::Chart a = chart("x", {curve("", 1)}), b = a;
  a.is_square = b.is_square = true;
  a.x_low = -1, a.x_high = 1, a.y_low = -1, a.y_high = 1;
  b.x_low = -3, b.x_high = 1, b.y_low = -2, b.y_high = 2;
  lay_over(a, b);
  TEST_ASSERT_EQUAL_DOUBLE(-3, a.x_low);
  TEST_ASSERT_EQUAL_DOUBLE(a.x_high - a.x_low, a.y_high - a.y_low);
  TEST_ASSERT_TRUE(a.y_low <= -2 && a.y_high >= 2);
  b.x_low = b.x_high = 0;
  a.is_square = false;
  lay_over(a, b);
  TEST_ASSERT_TRUE(a.x_low == 0 && a.x_high == 0);
}

void test_rows_of_tables_become_columns_of_designs() {
  const emit::PageTable first = {"t", {"signal", "overshoot", "rms"}, {{"angle", "5 %", "1"}, {"speed", "7 %", "2"}}};
  const emit::PageTable second = {"t", {"signal", "overshoot", "rms"}, {{"speed", "8 %", "3"}, {"mass", "1 %", "4"}}};
  const auto sections = merged_sections({page("a", view_of({}, {first})), page("b", view_of({}, {second}))});
  const emit::PageTable& table = sections[0].views[0].tables[0];
  TEST_ASSERT_EQUAL_STRING("a", table.head[1].c_str());
  TEST_ASSERT_EQUAL_UINT(6, table.rows.size());
  TEST_ASSERT_EQUAL_STRING("angle, overshoot", table.rows[0][0].c_str());
  TEST_ASSERT_EQUAL_STRING("5 %", table.rows[0][1].c_str());
  TEST_ASSERT_EQUAL_STRING("–", table.rows[0][2].c_str());
  TEST_ASSERT_EQUAL_STRING("speed, rms", table.rows[3][0].c_str());
  TEST_ASSERT_EQUAL_STRING("2", table.rows[3][1].c_str());
  TEST_ASSERT_EQUAL_STRING("3", table.rows[3][2].c_str());
}

void test_figures_stand_in_columns_with_what_is_required() {
  OwnedPage a = page("a", view_of({})), b = page("b", view_of({}));
  a.page.figures = {{"Phase margin", "40°", "at least 30°", true}};
  b.page.figures = {{"RAM", "8 bytes"}, {"Phase margin", "20°"}};
  const emit::PageTable table = figure_table({a, b});
  TEST_ASSERT_EQUAL_UINT(2, table.rows.size());
  TEST_ASSERT_EQUAL_STRING("40° (at least 30°)", table.rows[0][1].c_str());
  TEST_ASSERT_EQUAL_STRING("20°", table.rows[0][2].c_str());
  TEST_ASSERT_EQUAL_STRING("–", table.rows[1][1].c_str());
}

void test_a_section_of_matrices_only_is_left_out() {
  emit::PageView matrices;
  matrices.matrices = {{"K", "", {"u"}, {"x"}, {{"1"}}}};
  TEST_ASSERT_EQUAL_UINT(0, merged_sections({page("a", matrices), page("b", matrices)}).size());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_charts_with_one_id_become_one_with_the_curves_of_all);
  RUN_TEST(test_no_two_curves_look_the_same);
  RUN_TEST(test_the_grid_stands_once_and_has_no_owner);
  RUN_TEST(test_a_staircase_and_a_line_keep_their_colours);
  RUN_TEST(test_limits_that_both_have_stand_once);
  RUN_TEST(test_a_window_holds_both_and_a_square_stays_one);
  RUN_TEST(test_rows_of_tables_become_columns_of_designs);
  RUN_TEST(test_figures_stand_in_columns_with_what_is_required);
  RUN_TEST(test_a_section_of_matrices_only_is_left_out);
  return UNITY_END();
}
