// SPDX-License-Identifier: MIT
// Laws with a memory, end to end: integral action, references, weighted changes, slew limits, delays, tables of gains.
#include <cmath>
#include <cstdlib>

#include <unity.h>

#include "emit/c/header.hpp"
#include "emitted.hpp"
#include "servo_design.hpp"

using namespace lqg_test;
using Eigen::VectorXd;
using lqg::design::Problem;
using lqg::design::Solution;
using lqg::emit::Controller;

namespace {

const std::vector<Language> as_c_only = {Language::c}, as_both = {Language::c, Language::cxx};

void test_integral_action_within_limits() {
  expect_emitted_to_pass(changed(limited_double_integrator(), integrate_position), as_both);
}

void test_integral_action_of_an_output_with_feedthrough_in_both_forms() {
  DesignText design = limited_double_integrator();
  design.D = Eigen::MatrixXd::Constant(1, 1, 0.1);
  design.real = "double";
  for (const char* form : {"filter", "predictor"}) {
    design.form = form, design.arithmetic = design.form == "filter" ? "fused" : "plain";
    expect_emitted_to_pass(changed(design, integrate_position), as_c_only);
    expect_emitted_to_pass(changed(design, weigh_changes), as_c_only);
  }
}

void test_integral_action_beside_a_carried_covariance() {
  DesignText design = limited_double_integrator();
  design.gain = "online";
  for (const char* covariance : {"ud", "plain"}) {
    design.covariance = covariance;
    expect_emitted_to_pass(changed(design, integrate_position), as_c_only);
  }
}

void test_feed_forward_alone_and_beside_integral_action() {
  expect_emitted_to_pass(changed(double_integrator(), track_position), as_both);
  expect_emitted_to_pass(changed(limited_double_integrator(),
                                 [](Problem& problem, Solution& solution) {
                                   track_position(problem, solution);
                                   integrate_position(problem, solution);
                                 }),
                         as_c_only);
}

void test_weighted_changes_with_and_without_integral_action() {
  expect_emitted_to_pass(changed(limited_double_integrator(), weigh_changes), as_both);
  expect_emitted_to_pass(changed(double_integrator(),
                                 [](Problem& problem, Solution& solution) {
                                   problem.regulator->input_rate = Eigen::MatrixXd::Identity(1, 1);
                                   solution.regulator->K = matrix({{0.1, 0.3, 0.3}});
                                 }),
                         as_c_only);
}

void limit_rate(Problem& problem, Solution&) {
  if (!problem.limits) problem.limits = lqg::design::Limits{};
  problem.limits->u_rate = VectorXd::Constant(1, 0.7);
}

void test_slew_limits_alone_and_within_others() {
  expect_emitted_to_pass(changed(double_integrator(), limit_rate), as_both);
  expect_emitted_to_pass(changed(limited_double_integrator(),
                                 [](Problem& problem, Solution& solution) {
                                   limit_rate(problem, solution);
                                   weigh_changes(problem, solution);
                                 }),
                         as_c_only);
}

DesignText regulator_alone(DesignText design) {
  design.W.resize(0, 0);
  return design;
}

void test_regulators_alone_keep_their_own_memory() {
  const DesignText design = regulator_alone(limited_double_integrator());
  expect_emitted_to_pass(changed(design, integrate_position), as_both);
  expect_emitted_to_pass(changed(design, weigh_changes), as_c_only);
  expect_emitted_to_pass(changed(design, limit_rate), as_c_only);
  DesignText with_D = design;
  with_D.D = Eigen::MatrixXd::Constant(1, 1, 0.1), with_D.arithmetic = "fused";
  expect_emitted_to_pass(changed(with_D, integrate_position), as_c_only);
}

void test_inputs_on_their_way_are_states() {
  expect_emitted_to_pass(changed(double_integrator(), delay_input), as_both);
  expect_emitted_to_pass(changed(regulator_alone(double_integrator()), delay_input), as_c_only);
}

// K of a horizon of five samples, and then the last.
void schedule_law(Problem&, Solution& solution) {
  auto& regulator = *solution.regulator;
  for (int k = 0; k < 5; ++k) {
    auto K = regulator.K;
    for (Eigen::Index i = 0; i < K.size(); ++i) K.data()[i] *= lqg::design::Real(1 + 0.1 * (5 - k));
    regulator.K_schedule.push_back(K);
  }
}

void test_gains_of_a_horizon() {
  expect_emitted_to_pass(changed(limited_double_integrator(), schedule_law), as_both);
  expect_emitted_to_pass(changed(regulator_alone(double_integrator()), schedule_law), as_both);
  for (const auto& kind : {integrate_position, weigh_changes, track_position})
    expect_emitted_to_pass(changed(limited_double_integrator(),
                                   [&](Problem& problem, Solution& solution) {
                                     kind(problem, solution);
                                     schedule_law(problem, solution);
                                   }),
                           as_c_only);
  expect_emitted_to_pass(changed(regulator_alone(limited_double_integrator()),
                                 [](Problem& problem, Solution& solution) {
                                   integrate_position(problem, solution);
                                   schedule_law(problem, solution);
                                 }),
                         as_c_only);
}

// The gain of the position alone changes.
void schedule_filter(Problem& problem, Solution& solution) {
  problem.estimator->gain = lqg::design::Gain::schedule;
  auto& estimator = *solution.estimator;
  for (int k = 0; k < 4; ++k) {
    auto L = estimator.L;
    L(0, 0) += lqg::design::Real(0.1 * (4 - k));
    estimator.L_schedule.push_back(L);
    estimator.M_schedule.push_back(estimator.M);
  }
}

void test_gains_of_a_transient() {
  expect_emitted_to_pass(changed(double_integrator(), schedule_filter), as_both);
  DesignText design = limited_double_integrator();
  design.Swv = Eigen::MatrixXd::Constant(1, 1, 0.01), design.form = "predictor", design.real = "double";
  expect_emitted_to_pass(changed(design,
                                 [](Problem& problem, Solution& solution) {
                                   integrate_position(problem, solution);
                                   schedule_law(problem, solution);
                                   schedule_filter(problem, solution);
                                 }),
                         as_c_only);
}

// Rows that are all the same, or the held one, are no table.
void test_gains_that_do_not_change_are_no_table() {
  const Controller controller = changed(double_integrator(), [](Problem&, Solution& solution) {
    solution.regulator->K_schedule.assign(7, solution.regulator->K);
  });
  TEST_ASSERT_EQUAL_size_t(1, controller.laws.size());
  TEST_ASSERT_TRUE(lqg::emit::header(controller).find("sample;") == std::string::npos);
}

// ---- what the loop does

// Runs the body of a main over `self` in both styles and hands what it printed to `expect`.
void run_in_both_styles(Controller controller, const std::string& body,
                        const std::function<void(const std::string&)>& expect) {
  for (const auto style : {lqg::design::Style::unrolled, lqg::design::Style::compact}) {
    controller.style = style;
    expect(run_with_header(controller,
                           "#include <math.h>\n#include <stdio.h>\n#include \"loop.h\"\n\n"
                           "int main(void)\n{\n    static loop_t self;\n    float y[1] = {0}, u[1] = {0};\n"
                           "    unsigned status = 0;\n\n    (void)y;\n    (void)u;\n    (void)status;\n"
                           "    loop_init(&self);\n" +
                               body + "    return 0;\n}\n"));
  }
}

// 500 samples at the limit of 0.5 with an error of 1000, before a plant that does not move: without a correction ξ were
// 50000. With it ξ stays where H takes back in each sample what the error adds, 2 ξ = 0.5 + 100/0.3. Once the error has
// gone, a sample leaves 1 − 2 · 0.3 of what is beyond the limit.
void test_an_integral_does_not_wind_up_at_a_limit() {
  run_in_both_styles(changed(limited_double_integrator(), integrate_position), R"(
    float most = 0;
    for (int k = 0; k < 520; k++) {
        self.r[0] = k < 500 ? 1000 : 0;
        (void)loop_update(&self, y);
        self.x[0] = self.x[1] = 0;
        (void)loop_control(&self, u);
        (void)loop_predict(&self, u);
        most = self.xi[0] > most ? self.xi[0] : most;
    }
    printf("%.9g %.9g", (double)most, (double)self.xi[0]);
)",
                     [](const std::string& text) {
                       double most = 0, xi = 0;
                       TEST_ASSERT_EQUAL_INT(2, std::sscanf(text.c_str(), "%lf %lf", &most, &xi));
                       TEST_ASSERT_DOUBLE_WITHIN(1e-3, (0.5 + 100 / 0.3) / 2, most);
                       TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.25, xi);
                     });
}

// With x̂ = 0 the law is 2 ξ = 6, and 0.25 is applied.
void expect_integral_after_another_input(void (*change)(Problem&, Solution&), double expected) {
  const auto is_expected = [&](const std::string& xi) {
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, expected, std::strtod(xi.c_str(), nullptr));
  };
  run_in_both_styles(changed(limited_double_integrator(), change), R"(
    self.xi[0] = 3;
    (void)loop_control(&self, u);
    u[0] = 0.25f;
    (void)loop_predict(&self, u);
    printf("%.9g", (double)self.xi[0]);
)",
                     is_expected);
}

// 3 + 0.3 (0.25 − 6)
void test_another_input_than_asked_for_acts_on_the_integral_by_H() {
  expect_integral_after_another_input(integrate_position, 1.275);
}

void test_conditioned_law_asks_for_what_was_applied() {
  expect_integral_after_another_input(
      [](Problem& problem, Solution& solution) {
        integrate_position(problem, solution);
        solution.regulator->H.resize(0, 0);
      },
      0.125);
}

void test_control_goes_on_where_the_hand_was() {
  for (const auto& kind : {integrate_position, weigh_changes})
    run_in_both_styles(changed(limited_double_integrator(), kind), R"(
    const float x[2] = {0.4f, -0.2f}, by_hand[1] = {0.37f};

    self.r[0] = 0.9f;
    status |= loop_set_state(&self, x);
    status |= loop_set_input(&self, by_hand);
    status |= loop_control(&self, u);
    printf("%u %.9g", status, (double)u[0]);
)",
                       [](const std::string& text) {
                         TEST_ASSERT_TRUE(text.substr(0, 2) == "0 ");
                         TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.37, std::strtod(text.c_str() + 2, nullptr));
                       });
}

void test_inputs_on_their_way_follow_the_hand() {
  run_in_both_styles(changed(double_integrator(), delay_input), R"(
    u[0] = 0.75f;
    status = loop_set_input(&self, u);
    printf("%u %g %g", status, (double)self.x[LOOP_X_FORCE_DELAYED_2], (double)self.x[LOOP_X_FORCE_DELAYED_1]);
)",
                     [](const std::string& text) { TEST_ASSERT_EQUAL_STRING("0 0.75 0.75", text.c_str()); });
}

// 0.7 per second are 0.07 a sample.
void test_an_input_moves_no_faster_than_its_slew_limit() {
  run_in_both_styles(changed(double_integrator(), limit_rate), R"(
    float last = 0, most = 0;

    self.x[0] = -100;
    for (int k = 0; k < 20; k++) {
        status |= loop_control(&self, u);
        most = u[0] - last > most ? u[0] - last : most;
        last = u[0];
        self.x[0] = -100;
        (void)loop_predict(&self, u);
    }
    printf("%u %.9g %.9g", status, (double)most, (double)last);
)",
                     [](const std::string& text) {
                       double most = 0, last = 0;
                       unsigned status = 0;
                       TEST_ASSERT_EQUAL_INT(3, std::sscanf(text.c_str(), "%u %lf %lf", &status, &most, &last));
                       TEST_ASSERT_EQUAL_UINT(8, status);
                       TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.07, most);
                       TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.4, last);
                     });
}

// NaN in r, in y, and in the u that is given to predict: u stays finite, r as it was, and the loop begins anew.
void test_nothing_that_is_not_finite_stays() {
  run_in_both_styles(changed(limited_double_integrator(), weigh_changes), R"(
    self.r[0] = (float)NAN;
    y[0] = 1;
    status |= loop_update(&self, y);
    status |= loop_control(&self, u);
    printf("%u %d ", status, isfinite(u[0]) && isfinite(self.xi[0]));
    self.r[0] = 0.5f;
    u[0] = (float)NAN;
    status = loop_predict(&self, u);
    printf("%u %g %g %g", status, (double)self.r[0], (double)self.xi[0], (double)self.u_applied[0]);
)",
                     [](const std::string& text) { TEST_ASSERT_EQUAL_STRING("32 1 16 0.5 0 0", text.c_str()); });
}

// The time goes on when the state is reset; the filter's transient begins anew.
void test_counters_stop_at_the_end_and_know_a_reset() {
  run_in_both_styles(changed(double_integrator(),
                             [](Problem& problem, Solution& solution) {
                               schedule_law(problem, solution);
                               schedule_filter(problem, solution);
                             }),
                     R"(
    for (int k = 0; k < 20; k++)
        status |= loop_step(&self, y, u);
    printf("%u %u %u ", status, self.sample, self.gain_row);
    u[0] = (float)NAN;
    status = loop_predict(&self, u);
    printf("%u %u %u", status, self.sample, self.gain_row);
)",
                     [](const std::string& text) { TEST_ASSERT_EQUAL_STRING("0 5 4 16 5 0", text.c_str()); });
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_integral_action_within_limits);
  RUN_TEST(test_integral_action_of_an_output_with_feedthrough_in_both_forms);
  RUN_TEST(test_integral_action_beside_a_carried_covariance);
  RUN_TEST(test_feed_forward_alone_and_beside_integral_action);
  RUN_TEST(test_weighted_changes_with_and_without_integral_action);
  RUN_TEST(test_slew_limits_alone_and_within_others);
  RUN_TEST(test_regulators_alone_keep_their_own_memory);
  RUN_TEST(test_inputs_on_their_way_are_states);
  RUN_TEST(test_gains_of_a_horizon);
  RUN_TEST(test_gains_of_a_transient);
  RUN_TEST(test_gains_that_do_not_change_are_no_table);
  RUN_TEST(test_an_integral_does_not_wind_up_at_a_limit);
  RUN_TEST(test_another_input_than_asked_for_acts_on_the_integral_by_H);
  RUN_TEST(test_conditioned_law_asks_for_what_was_applied);
  RUN_TEST(test_control_goes_on_where_the_hand_was);
  RUN_TEST(test_inputs_on_their_way_follow_the_hand);
  RUN_TEST(test_an_input_moves_no_faster_than_its_slew_limit);
  RUN_TEST(test_nothing_that_is_not_finite_stays);
  RUN_TEST(test_counters_stop_at_the_end_and_know_a_reset);
  return UNITY_END();
}
