// SPDX-License-Identifier: MIT
// NAME.html: well-formed, complete, without scripts, the same bytes every time.
#include <cctype>

#include <unity.h>

#include "design_text.hpp"
#include "emit/report/report.hpp"
#include "emit/text/html.hpp"
#include "emit/text/wording.hpp"

using namespace lqg_test;
using lqg::emit::Controller;
using lqg::emit::report;

namespace {

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

// Every tag is closed in its turn; <meta> stands alone.
void expect_well_formed(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<', 1); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    TEST_ASSERT_TRUE_MESSAGE(end != std::string::npos, "a tag without its end");
    const bool closes = html[at + 1] == '/';
    std::string name;
    for (std::size_t i = at + 1 + closes; std::isalnum(static_cast<unsigned char>(html[i])); ++i) name += html[i];
    TEST_ASSERT_FALSE_MESSAGE(name.empty(), "< without a name");
    if (closes) {
      TEST_ASSERT_FALSE_MESSAGE(open.empty(), name.c_str());
      TEST_ASSERT_EQUAL_STRING(open.back().c_str(), name.c_str());
      open.pop_back();
    } else if (html[end - 1] != '/' && name != "meta") {
      open.push_back(name);
    }
  }
  TEST_ASSERT_TRUE(open.empty());
}

void expect_sound(const Controller& controller) {
  const std::string html = report(controller);
  expect_well_formed(html);
  for (const char* word : {"<script", "nan", "NaN", ">inf", ">-inf", "http:", "https:"})
    TEST_ASSERT_FALSE_MESSAGE(has(html, word), word);
  TEST_ASSERT_TRUE(html == report(controller));
}

void test_random_designs_have_sound_reports() {
  for (int seed = 0; seed < 12; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    expect_sound(controller_of(random_design(random, 1 + seed % 5)));
  }
}

void test_poles_margins_and_gains_stand_in_it() {
  const Controller controller = controller_of(double_integrator());
  const std::string html = report(controller);
  for (const auto& pole : controller.solution.regulator->poles)
    TEST_ASSERT_TRUE(has(html, "<td>" + lqg::emit::decimal(pole.real())));
  TEST_ASSERT_TRUE(has(html, lqg::emit::decimal(*controller.solution.loop.at_input.disk)));
  const auto& K = controller.solution.regulator->K;
  for (int j = 0; j < K.cols(); ++j) TEST_ASSERT_TRUE(has(html, "<td>" + lqg::emit::number(K(0, j), false) + "</td>"));
  TEST_ASSERT_TRUE(has(html, controller.source.sha256));
}

void test_words_of_the_design_are_escaped() {
  DesignText design = double_integrator();
  design.brief = "a <b> & c";
  const std::string html = report(controller_of(design));
  TEST_ASSERT_TRUE(has(html, "a &lt;b&gt; &amp; c"));
  expect_well_formed(html);
}

void test_estimator_alone_has_no_kick_and_regulator_alone_no_noise() {
  DesignText design = double_integrator();
  design.Q.resize(0, 0);
  const Controller estimator = controller_of(design);
  expect_sound(estimator);
  TEST_ASSERT_TRUE(has(report(estimator), "At work") && !has(report(estimator), "After a kick"));
  design = double_integrator();
  design.W.resize(0, 0), design.C.resize(0, 0), design.G.resize(0, 0), design.outputs = "";
  const Controller regulator = controller_of(design);
  expect_sound(regulator);
  TEST_ASSERT_TRUE(!has(report(regulator), "At work") && has(report(regulator), "After a kick"));
}

// Its state doubles each sample, and no regulator holds it.
void test_a_plant_that_leaves_is_shown_as_far_as_numbers_go() {
  DesignText design = double_integrator();
  design.A(0, 0) = design.A(1, 1) = 2;
  design.Q.resize(0, 0);
  expect_sound(controller_of(design));
}

void test_letters_are_what_a_reader_sees() {
  TEST_ASSERT_EQUAL_size_t(3, lqg::emit::letters("x̂−"));  // the hat counts, too
  TEST_ASSERT_EQUAL_size_t(5, lqg::emit::letters("Größe"));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_random_designs_have_sound_reports);
  RUN_TEST(test_poles_margins_and_gains_stand_in_it);
  RUN_TEST(test_words_of_the_design_are_escaped);
  RUN_TEST(test_estimator_alone_has_no_kick_and_regulator_alone_no_noise);
  RUN_TEST(test_a_plant_that_leaves_is_shown_as_far_as_numbers_go);
  RUN_TEST(test_letters_are_what_a_reader_sees);
  return UNITY_END();
}
