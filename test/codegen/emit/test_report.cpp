// SPDX-License-Identifier: MIT
// NAME.html: well-formed, complete, without a network, the same bytes every time.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <unity.h>

#include "design_text.hpp"
#include "emit/report/innovations.hpp"
#include "emit/report/report.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/html.hpp"
#include "emit/text/wording.hpp"

using namespace lqg_test;
using lqg::emit::Controller;
using lqg::emit::report;

namespace {

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

// What people see without scripts.
std::string visible(const std::string& html) { return html.substr(0, html.find("<script")); }

// Every tag is closed in its turn, up to the scripts; <meta> stands alone.
void expect_well_formed(const std::string& whole) {
  const std::string html = visible(whole) + "</body></html>";
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
  for (const char* word : {"nan<", "NaN", ">nan", ">inf", ">-inf", "nan ", "inf "})
    TEST_ASSERT_FALSE_MESSAGE(has(visible(html), word), word);
  for (const char* word : {"http:", "https:", "src=", "href=", "url("})
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

std::vector<std::string> sections(const Controller& controller) {
  std::vector<std::string> out;
  for (const auto& section : lqg::emit::page_data(controller).sections) out.push_back(section.id);
  return out;
}

bool has_section(const Controller& controller, const char* id) {
  const std::vector<std::string> all = sections(controller);
  return std::find(all.begin(), all.end(), id) != all.end();
}

void test_an_estimator_alone_has_no_loop_and_a_regulator_alone_no_estimator() {
  DesignText design = double_integrator();
  design.Q.resize(0, 0);
  const Controller estimator = controller_of(design);
  expect_sound(estimator);
  TEST_ASSERT_TRUE(has_section(estimator, "estimator") && !has_section(estimator, "margins"));
  design = double_integrator();
  design.W.resize(0, 0), design.C.resize(0, 0), design.G.resize(0, 0), design.outputs = "";
  const Controller regulator = controller_of(design);
  expect_sound(regulator);
  TEST_ASSERT_TRUE(has_section(regulator, "margins") && !has_section(regulator, "estimator"));
}

const lqg::emit::Chart& chart_with(const lqg::emit::PageData& page, const std::string& id) {
  for (const auto& section : page.sections)
    for (const auto& view : section.views)
      for (const auto& chart : view.charts)
        if (chart.id == id) return chart;
  TEST_FAIL_MESSAGE(id.c_str());
  return page.sections.front().views.front().charts.front();
}

// The margins are those of the design, in many digits; the curve is in double.
void test_the_gain_is_0_dB_at_the_crossover_and_the_phase_misses_180_by_the_margin() {
  const Controller controller = controller_of(double_integrator());
  const auto& margins = controller.solution.loop.at_input;
  const lqg::emit::PageData page = lqg::emit::page_data(controller);
  const auto& guides = chart_with(page, "loop0-gain").guides;
  const double crossover = *margins.crossover / (2 * std::acos(-1.0) * 0.1);
  TEST_ASSERT_TRUE(std::any_of(guides.begin(), guides.end(), [&](const lqg::emit::Guide& guide) {
    return std::abs(guide.at - crossover) < 1e-6 * crossover;
  }));
  const auto& phase = chart_with(page, "loop0-phase").curves.front();
  const auto after = std::lower_bound(phase.x.begin(), phase.x.end(), crossover) - phase.x.begin();
  TEST_ASSERT_DOUBLE_WITHIN(1, *margins.phase_deg - 180, phase.y[static_cast<std::size_t>(after)]);
  const std::string words = "phase " + lqg::emit::decimal(*margins.phase_deg) + "° from −180°";
  TEST_ASSERT_TRUE(has(report(controller), words));
}

// |S − T| < 2/d: the curve of L stays outside of the circle of the disk margin, and touches it.
void test_the_nyquist_curve_touches_the_circle_of_the_disk_margin() {
  const lqg::emit::PageData page = lqg::emit::page_data(controller_of(double_integrator()));
  const lqg::emit::Chart& chart = chart_with(page, "loop0-nyquist");
  const lqg::emit::Circle& circle = chart.circles.front();
  double nearest = INFINITY;
  for (std::size_t k = 0; k < chart.curves[1].x.size(); ++k)
    nearest = std::min(nearest, std::hypot(chart.curves[1].x[k] - circle.x, chart.curves[1].y[k] - circle.y));
  TEST_ASSERT_TRUE(nearest > circle.radius * (1 - 1e-9));
  TEST_ASSERT_TRUE(nearest < circle.radius * 1.01);
}

// Of the symplectic pencil with ρ = 1 the poles are those of the design.
void test_the_root_locus_goes_through_the_poles_of_the_design() {
  const Controller controller = controller_of(double_integrator());
  const lqg::emit::PageData page = lqg::emit::page_data(controller);
  const lqg::emit::Chart& chart = chart_with(page, "root-locus");
  const lqg::emit::Curve& dear = chart.curves[1];
  const std::size_t count = controller.solution.regulator->poles.size();
  for (std::size_t i = 0; i < count; ++i) {  // the first points of ρ ≥ 1
    TEST_ASSERT_EQUAL_STRING("ρ = 1", dear.texts[i].c_str());
    double nearest = INFINITY;
    for (const auto& pole : controller.solution.regulator->poles)
      nearest = std::min(nearest, std::abs(pole - std::complex<double>(dear.x[i], dear.y[i])));
    TEST_ASSERT_TRUE(nearest < 1e-9);
  }
}

// The Kalman filter's own equation: what the first samples tend to.
void test_the_deviations_end_at_those_of_the_steady_filter() {
  const Controller controller = controller_of(double_integrator());
  const lqg::emit::PageData page = lqg::emit::page_data(controller);
  const lqg::emit::Curve& curve = chart_with(page, "deviation-0").curves.front();
  const double steady = std::sqrt(lqg::design::to_double(controller.solution.estimator->P_posterior(0, 0)));
  TEST_ASSERT_DOUBLE_WITHIN(0.05 * steady, steady, curve.y.back());
}

// With the titles and every q; what is not there, a cost, has no column.
void test_margin_against_cost_stands_in_it_with_recovery() {
  TEST_ASSERT_FALSE(has(report(controller_of(double_integrator())), "Margin against cost"));
  std::string text = toml(double_integrator());
  text.replace(text.find("[kalman]"), 8, "[kalman]\nrecovery = 0.25");
  const Controller controller = controller_of(text);
  expect_sound(controller);
  const std::string html = visible(report(controller));
  for (const char* words : {"Margin against cost", "0.25, this design", "0.0025", "cost, beside q = 0", "+0 %"})
    TEST_ASSERT_TRUE_MESSAGE(has(html, words), words);
}

const lqg::emit::Chart& chart_in(const lqg::emit::PageSection& section, const std::string& id) {
  const std::vector<lqg::emit::Chart>& charts = section.views.front().charts;
  const auto found = std::find_if(charts.begin(), charts.end(), [&](const auto& chart) { return chart.id == id; });
  TEST_ASSERT_TRUE_MESSAGE(found != charts.end(), id.c_str());
  return *found;
}

void expect_limits(const lqg::emit::Chart& chart, double size, const char* words) {
  TEST_ASSERT_EQUAL(2, chart.guides.size());
  TEST_ASSERT_EQUAL_DOUBLE(-size, chart.guides[0].at);
  TEST_ASSERT_EQUAL_DOUBLE(size, chart.guides[1].at);
  TEST_ASSERT_EQUAL_STRING(words, chart.guides[0].label.c_str());
  TEST_ASSERT_EQUAL_STRING("clipped", chart.curves[0].label.c_str());
  TEST_ASSERT_EQUAL_STRING("foreseen", chart.curves[1].label.c_str());
}

void test_foresight_shows_all_that_is_limited_beside_clipping() {
  const Controller controller = controller_of(R"(
name = "mass"
[plant]
domain = "continuous"
sample_time = 0.1
A = [[0, 1], [0, 0]]
B = [[0], [1]]
C = [[2, 0]]
states  = ["place [m]", "speed [m/s]"]
inputs  = ["force [N]"]
outputs = ["twice [m]"]
[lqr]
Q = [1, 0.1]
R = [0.1]
[kalman]
process_noise     = [1e-4, 1e-2]
measurement_noise = [1e-3]
[limits]
u_min  = [-1]
u_max  = [1]
u_rate = [4]
horizon = 6
states  = { speed = 0.5 }
outputs = { twice = 3 }
output_rates = { twice = 0.9 }
)");
  const lqg::emit::PageSection section = lqg::emit::foresight_section(controller);
  std::string ids;
  for (const lqg::emit::Chart& chart : section.views.front().charts)
    ids += chart.id.substr(9) + " " + chart.title + ", ";
  TEST_ASSERT_EQUAL_STRING(
      "-u0 force [N], -u0-rate rate of force [N/s], -x0 place [m], -x1 speed [m/s], -y0 twice [m], "
      "-y0-rate rate of twice [m/s], ",
      ids.c_str());
  const auto& u = chart_in(section, "foresight-u0");
  const auto& rate = chart_in(section, "foresight-u0-rate");
  const auto& place = chart_in(section, "foresight-x0");
  const auto& twice = chart_in(section, "foresight-y0");
  const auto& speed_of_it = chart_in(section, "foresight-y0-rate");
  expect_limits(u, 1, "limit");
  expect_limits(rate, 4, "limit");
  expect_limits(chart_in(section, "foresight-x1"), 0.5, "soft limit");
  expect_limits(twice, 3, "soft limit");
  expect_limits(speed_of_it, 0.9, "soft limit");
  TEST_ASSERT_TRUE(place.guides.empty());
  for (std::size_t law = 0; law < 2; ++law) {
    const std::vector<double>&force = u.curves[law].y, &y = twice.curves[law].y;
    TEST_ASSERT_TRUE(force.size() > 20);
    for (std::size_t k = 0; k < force.size(); ++k) {
      TEST_ASSERT_TRUE(std::abs(force[k]) <= 1);
      TEST_ASSERT_DOUBLE_WITHIN(1e-9, (force[k] - (k > 0 ? force[k - 1] : 0)) / 0.1, rate.curves[law].y[k]);
      TEST_ASSERT_TRUE(std::abs(rate.curves[law].y[k]) < 4 * (1 + 1e-5));
      TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2 * place.curves[law].y[k], y[k]);
      TEST_ASSERT_DOUBLE_WITHIN(1e-9, k > 0 ? (y[k] - y[k - 1]) / 0.1 : 0, speed_of_it.curves[law].y[k]);
    }
  }
  expect_sound(controller);
}

void test_notes_of_the_design_stand_in_it() {
  lqg::design::Findings findings;
  lqg::design::add_note(findings, "lqr.R", "is <small>");
  const std::string html = report(controller_of(double_integrator()), findings);
  TEST_ASSERT_TRUE(has(html, "<code>lqr.R</code>: is &lt;small&gt;"));
}

void test_ids_of_charts_differ_from_each_other() {
  Random random(7);
  const lqg::emit::PageData page = lqg::emit::page_data(controller_of(random_design(random, 4)));
  std::set<std::string> ids;
  for (const auto& section : page.sections)
    for (const auto& view : section.views)
      for (const auto& chart : view.charts) TEST_ASSERT_TRUE_MESSAGE(ids.insert(chart.id).second, chart.id.c_str());
  TEST_ASSERT_TRUE(ids.size() > 10);
}

// M. Abramowitz, I. A. Stegun, "Handbook of Mathematical Functions", table 26.8.
void test_chi_squared_has_the_values_of_the_table() {
  TEST_ASSERT_DOUBLE_WITHIN(5e-5, 3.84146, lqg::emit::chi_squared(1, 0.05));
  TEST_ASSERT_DOUBLE_WITHIN(5e-5, 14.4494, lqg::emit::chi_squared(6, 0.025));
  TEST_ASSERT_DOUBLE_WITHIN(5e-5, 1.23734, lqg::emit::chi_squared(6, 0.975));
}

void test_a_signal_that_changes_its_sign_each_sample_has_a_correlation_of_plus_and_minus_1() {
  std::vector<double> signal;
  for (int k = 0; k < 1000; ++k) signal.push_back(k % 2 ? 1 : -1);
  const std::vector<double> found = lqg::emit::autocorrelation(signal, 3);
  for (int lag = 0; lag < 4; ++lag)
    TEST_ASSERT_DOUBLE_WITHIN(0.01, lag % 2 ? -1 : 1, found[static_cast<std::size_t>(lag)]);
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
  RUN_TEST(test_an_estimator_alone_has_no_loop_and_a_regulator_alone_no_estimator);
  RUN_TEST(test_the_gain_is_0_dB_at_the_crossover_and_the_phase_misses_180_by_the_margin);
  RUN_TEST(test_the_nyquist_curve_touches_the_circle_of_the_disk_margin);
  RUN_TEST(test_the_root_locus_goes_through_the_poles_of_the_design);
  RUN_TEST(test_the_deviations_end_at_those_of_the_steady_filter);
  RUN_TEST(test_margin_against_cost_stands_in_it_with_recovery);
  RUN_TEST(test_foresight_shows_all_that_is_limited_beside_clipping);
  RUN_TEST(test_notes_of_the_design_stand_in_it);
  RUN_TEST(test_ids_of_charts_differ_from_each_other);
  RUN_TEST(test_chi_squared_has_the_values_of_the_table);
  RUN_TEST(test_a_signal_that_changes_its_sign_each_sample_has_a_correlation_of_plus_and_minus_1);
  RUN_TEST(test_a_plant_that_leaves_is_shown_as_far_as_numbers_go);
  RUN_TEST(test_letters_are_what_a_reader_sees);
  return UNITY_END();
}
