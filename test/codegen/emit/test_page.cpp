// SPDX-License-Identifier: MIT
// The page: data as HTML and as JSON for its script.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include <unity.h>

#include "emit/page/page.hpp"

using namespace lqg::emit;
using Json = nlohmann::json;

namespace {

// What a design file could say to end a script, to begin a comment, or to break a line of one.
const std::string hostile = "</script><!-- \xE2\x80\xA8 & \" < ' -->";

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

Chart chart_of(const std::string& id, std::vector<double> y) {
  Chart chart;
  chart.title = hostile;
  chart.id = id;
  std::vector<double> x;
  for (std::size_t i = 0; i < y.size(); ++i) x.push_back(0.1 * static_cast<double>(i));
  chart.curves.push_back({hostile, Mark::steps, 3, x, std::move(y)});
  return chart;
}

PageData page_of(std::vector<Chart> charts) {
  PageData data;
  data.title = data.brief = data.made = data.verdict = data.footer = hostile;
  data.notes = {{hostile, hostile}};
  data.figures = {{hostile, hostile, hostile, false}};
  PageView view;
  view.name = view.text = view.caption = hostile;
  view.charts = std::move(charts);
  view.tables = {{hostile, {hostile}, {{hostile}}}};
  view.matrices = {{"K", hostile, {hostile}, {hostile}, {{"1.5"}}, false}};
  data.sections = {{"only", hostile, {view}}};
  return data;
}

std::string embedded_json(const std::string& html) {
  const std::string tag = "id=\"lqg-data\">";
  const std::size_t from = html.find(tag) + tag.size();
  return html.substr(from, html.find("</script>", from) - from);
}

void test_the_json_of_the_page_reads_back_with_all_words_as_they_were() {
  const Json data = Json::parse(embedded_json(page_html(page_of({chart_of("a", {1, 2})}))));
  TEST_ASSERT_EQUAL_STRING(hostile.c_str(), data["charts"][0]["title"].get<std::string>().c_str());
  TEST_ASSERT_EQUAL_STRING(hostile.c_str(), data["charts"][0]["curves"][0]["label"].get<std::string>().c_str());
  TEST_ASSERT_EQUAL_STRING("steps", data["charts"][0]["curves"][0]["mark"].get<std::string>().c_str());
}

void test_words_of_the_design_end_no_script_and_open_no_tag() {
  const std::string html = page_html(page_of({chart_of("a", {1, 2})}));
  const std::string json = embedded_json(html);
  TEST_ASSERT_FALSE(has(json, "<"));
  for (const char c : json) TEST_ASSERT_TRUE(static_cast<unsigned char>(c) < 128);
  TEST_ASSERT_EQUAL_size_t(count(html, "<script"), count(html, "</script>"));
  TEST_ASSERT_FALSE(has(html, "<!--"));
  TEST_ASSERT_FALSE(has(html.substr(0, html.find("<script")), "--> "));
}

void test_the_page_knows_no_network_and_says_so_to_the_browser() {
  const std::string html = page_html(page_of({}));
  for (const char* word : {"http:", "https:", "src=", "href=", "url(", "@import"})
    TEST_ASSERT_FALSE_MESSAGE(has(html, word), word);
  TEST_ASSERT_TRUE(has(html, "default-src 'none'"));
  TEST_ASSERT_FALSE(has(html, "connect-src"));
  PageExtras extras;
  extras.may_connect = true;
  TEST_ASSERT_TRUE(has(page_html(page_of({}), extras), "connect-src 'self'"));
}

void test_the_licence_of_the_library_stands_in_the_page() {
  const std::string html = page_html(page_of({}));
  for (const char* word : {"Chart.js v", "Chart.js Contributors", "Permission is hereby granted, free of charge"})
    TEST_ASSERT_TRUE_MESSAGE(has(html, word), word);
}

void test_a_list_of_numbers_that_two_charts_have_stands_there_once() {
  const Json data =
      Json::parse(page_json(page_of({chart_of("a", {1, 2}), chart_of("b", {1, 2}), chart_of("c", {3, 4})})));
  TEST_ASSERT_EQUAL_size_t(3, data["lists"].size());  // x, and two of y
  TEST_ASSERT_EQUAL_INT(data["charts"][0]["curves"][0]["y"].get<int>(), data["charts"][1]["curves"][0]["y"].get<int>());
}

void test_numbers_have_six_digits_and_what_is_not_finite_is_null() {
  const Json data = Json::parse(page_json(page_of({chart_of("a", {1.0 / 3, -2e-7 / 3, INFINITY, NAN, -0.0})})));
  const Json& y = data["lists"][1];
  TEST_ASSERT_EQUAL_STRING("[0.333333,-6.66667e-08,null,null,0.0]", y.dump().c_str());
}

void test_a_chart_without_an_id_has_that_of_its_place() {
  const Json data = Json::parse(page_json(page_of({chart_of("a", {1}), chart_of("", {1})})));
  TEST_ASSERT_EQUAL_STRING("only-0-1", data["charts"][1]["id"].get<std::string>().c_str());
  TEST_ASSERT_TRUE(has(data["body"].get<std::string>(), "data-chart=\"only-0-1\""));
}

void test_a_page_for_a_script_has_no_pictures_and_one_for_people_has_all() {
  const PageData data = page_of({chart_of("a", {1, 2}), chart_of("b", {1, 2})});
  TEST_ASSERT_FALSE(has(Json::parse(page_json(data))["body"].get<std::string>(), "<svg"));
  const std::string html = page_html(data);
  TEST_ASSERT_EQUAL_size_t(2, count(html.substr(0, html.find("<script")), "<svg "));
}

void test_thirteen_charts_are_an_overview_and_twelve_are_not() {
  const auto body = [](std::size_t charts) {
    return page_html(page_of(std::vector<Chart>(charts, chart_of("", {1, 2}))));
  };
  TEST_ASSERT_FALSE(has(body(12), "\"charts many\""));
  TEST_ASSERT_TRUE(has(body(13), "\"charts many\""));
}

void test_the_last_of_an_odd_number_of_charts_leaves_no_empty_half_of_a_row() {
  const std::string html = page_html(page_of(std::vector<Chart>(3, chart_of("", {1, 2}))));
  TEST_ASSERT_EQUAL_size_t(1, count(html, "class=\"chart wide pictured\""));
}

void test_a_page_of_too_many_points_is_shortened_and_keeps_its_extremes() {
  std::vector<double> y(20000, 0);
  y[777] = -3, y[12345] = 8;
  PageData data = page_of({chart_of("a", y), chart_of("b", y)});
  shorten(data, 1000);
  const Curve& curve = data.sections[0].views[0].charts[1].curves[0];
  TEST_ASSERT_TRUE(curve.y.size() <= 500);
  TEST_ASSERT_EQUAL_DOUBLE(-3, *std::min_element(curve.y.begin(), curve.y.end()));
  TEST_ASSERT_EQUAL_DOUBLE(8, *std::max_element(curve.y.begin(), curve.y.end()));
}

void test_the_same_data_are_the_same_bytes() {
  const PageData data = page_of({chart_of("a", {1, 2, 3})});
  TEST_ASSERT_TRUE(page_html(data) == page_html(data));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_the_json_of_the_page_reads_back_with_all_words_as_they_were);
  RUN_TEST(test_words_of_the_design_end_no_script_and_open_no_tag);
  RUN_TEST(test_the_page_knows_no_network_and_says_so_to_the_browser);
  RUN_TEST(test_the_licence_of_the_library_stands_in_the_page);
  RUN_TEST(test_a_list_of_numbers_that_two_charts_have_stands_there_once);
  RUN_TEST(test_numbers_have_six_digits_and_what_is_not_finite_is_null);
  RUN_TEST(test_a_chart_without_an_id_has_that_of_its_place);
  RUN_TEST(test_a_page_for_a_script_has_no_pictures_and_one_for_people_has_all);
  RUN_TEST(test_thirteen_charts_are_an_overview_and_twelve_are_not);
  RUN_TEST(test_the_last_of_an_odd_number_of_charts_leaves_no_empty_half_of_a_row);
  RUN_TEST(test_a_page_of_too_many_points_is_shortened_and_keeps_its_extremes);
  RUN_TEST(test_the_same_data_are_the_same_bytes);
  return UNITY_END();
}
