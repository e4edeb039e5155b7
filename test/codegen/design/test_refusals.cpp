// SPDX-License-Identifier: MIT
// Impossible designs: each is refused for its reason, under its key, with the mode and the states that take
// part.
#include <cmath>
#include <string>

#include <unity.h>

#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

// Refused with exactly one error, at `key`, whose message has every one of `parts`.
void expect_refusal(const Problem& problem, const std::string& key, const std::vector<std::string>& parts) {
  Findings findings;
  TEST_ASSERT_FALSE_MESSAGE(solve(problem, findings).has_value(), "it was solved");
  TEST_ASSERT_EQUAL(1, findings.size());
  TEST_ASSERT_EQUAL_STRING(key.c_str(), findings[0].key.c_str());
  for (const std::string& part : parts)
    TEST_ASSERT_TRUE_MESSAGE(findings[0].message.find(part) != std::string::npos,
                             (findings[0].message + " | lacks: " + part).c_str());
}

Problem regulator_alone(Domain domain, double sample_time, const MatrixXd& A, const MatrixXd& B) {
  Problem problem = problem_of(domain, sample_time, A, B, MatrixXd::Identity(1, A.rows()));
  problem.estimator.reset();
  return problem;
}

Problem estimator_alone(Domain domain, double sample_time, const MatrixXd& A, const MatrixXd& C) {
  Problem problem = problem_of(domain, sample_time, A, MatrixXd::Zero(A.rows(), 1), C);
  problem.regulator.reset();
  return problem;
}

const MatrixXd unstable_second = Eigen::Vector2d(-1, 0.5).asDiagonal();
const MatrixXd oscillator = (MatrixXd(2, 2) << 0, 1, -4, 0).finished();

void test_unstable_mode_that_no_input_reaches() {
  Problem problem = regulator_alone(Domain::continuous, 0.1, unstable_second, Eigen::Vector2d(1, 0));
  problem.plant.states = {{"angle", ""}, {"drift", ""}};
  expect_refusal(problem, "plant.B", {"s = 0.5", "z = 1.05127", "state drift", "not stabilisable"});
}

void test_stable_mode_that_no_input_reaches_is_no_reason() {
  solved(regulator_alone(Domain::continuous, 0.1, Eigen::Vector2d(-1, -0.5).asDiagonal(), Eigen::Vector2d(1, 0)));
}

void test_stable_mode_that_no_input_makes_as_fast_as_asked_for() {
  Problem problem =
      regulator_alone(Domain::continuous, 0.1, Eigen::Vector2d(-1, -0.5).asDiagonal(), Eigen::Vector2d(1, 0));
  problem.regulator->decay = 1.06;
  expect_refusal(problem, "lqr.decay", {"s = -0.5", "state x1", "slower than asked for"});
  problem.regulator->decay.reset();
  problem.regulator->settling_time = 9;
  expect_refusal(problem, "lqr.settling_time", {"s = -0.5", "state x1", "slower than asked for"});
}

void test_undamped_pair_that_no_input_reaches() {
  MatrixXd A = MatrixXd::Zero(3, 3);
  A(0, 0) = -1;
  A.bottomRightCorner(2, 2) = oscillator;
  expect_refusal(regulator_alone(Domain::continuous, 0.1, A, Eigen::Vector3d(1, 0, 0)), "plant.B",
                 {"s = ±2j", "z = 0.980067 ± 0.198669j", "states x1, x2"});
}

void test_discrete_mode_on_the_circle_that_no_input_reaches() {
  expect_refusal(regulator_alone(Domain::discrete, 1, Eigen::Vector2d(0.5, -1).asDiagonal(), Eigen::Vector2d(1, 0)),
                 "plant.B", {"z = -1 (state x1)"});
}

// Both integrators of the second chain: one eigenvalue, one line.
void test_defective_mode_that_no_input_reaches() {
  MatrixXd A = MatrixXd::Zero(4, 4);
  A(0, 1) = A(2, 3) = 1;
  expect_refusal(regulator_alone(Domain::continuous, 0.1, A, Eigen::Vector4d(0, 1, 0, 0)), "plant.B",
                 {"s = 0 (z = 1; state"});
}

void test_unstable_mode_that_no_output_sees() {
  expect_refusal(estimator_alone(Domain::continuous, 0.1, unstable_second, Eigen::RowVector2d(1, 0)), "plant.C",
                 {"s = 0.5", "state x1", "not detectable"});
}

void test_position_that_is_not_measured() {
  Problem problem = two_mass();
  problem.plant.C << 0, 1, 0, 0, 0, 0, 0, 1;
  expect_refusal(problem, "plant.C", {"s = 0 (z = 1; states dy1, dy2)"});
}

void test_integrator_without_weight() {
  Problem problem = double_integrator(0.1);
  problem.regulator->Q = Eigen::Vector2d(0, 1).asDiagonal();
  problem.plant.states = {{"position", "m"}, {"speed", "m/s"}};
  expect_refusal(problem, "lqr.Q", {"s = 0 (z = 1; state position)", "carries no weight"});
}

void test_integrator_without_weight_under_the_continuous_cost() {
  Problem problem = double_integrator(0.1);
  problem.regulator->Q = Eigen::Vector2d(0, 1).asDiagonal();
  problem.regulator->cost = Cost::continuous;
  expect_refusal(problem, "lqr.Q", {"s = 0 (z = 1; state x0)", "carries no weight"});
}

void test_discrete_oscillation_without_weight() {
  Problem problem =
      regulator_alone(Domain::discrete, 1, (MatrixXd(2, 2) << 0, 1, -1, 0).finished(), Eigen::Vector2d(0, 1));
  problem.regulator->Q.setZero();
  expect_refusal(problem, "lqr.Q", {"z = ±1j (states x0, x1)"});
}

void test_unstable_mode_without_weight_is_no_reason() {
  Problem problem = regulator_alone(Domain::discrete, 1, MatrixXd::Constant(1, 1, 2), MatrixXd::Identity(1, 1));
  problem.regulator->Q.setZero();
  TEST_ASSERT_TRUE(solved(problem).regulator->poles[0] == 0.5);
}

void test_integrator_that_no_noise_drives() {
  Problem problem = double_integrator(0.1);
  problem.estimator->W = MatrixXd::Zero(2, 2);
  expect_refusal(problem, "kalman.process_noise", {"s = 0 (z = 1; state", "no process noise"});
}

void test_constant_bias_that_no_noise_drives() {
  Problem problem =
      estimator_alone(Domain::discrete, 1, Eigen::Vector2d(0.5, 1).asDiagonal(), Eigen::RowVector2d(1, 1));
  problem.estimator->W = Eigen::Vector2d(1, 0).asDiagonal();
  expect_refusal(problem, "kalman.process_noise", {"z = 1 (state x1)"});
}

// Half a turn a sample: both states only change their sign, and one input cannot turn them apart.
void test_sample_time_that_hides_an_oscillation_from_its_input() {
  Problem problem = regulator_alone(Domain::continuous, std::acos(-1.0) / 2, oscillator, Eigen::Vector2d(0, 1));
  expect_refusal(problem, "plant.sample_time", {"(z = -1;", "can be stabilised", "sample time"});
}

void test_sample_time_of_a_whole_turn_hides_an_oscillation_from_every_held_input() {
  Problem problem = regulator_alone(Domain::continuous, std::acos(-1.0), oscillator, MatrixXd::Identity(2, 2));
  expect_refusal(problem, "plant.sample_time", {"(z = 1;"});
}

void test_sample_time_that_hides_an_oscillation_from_the_output() {
  Problem problem = estimator_alone(Domain::continuous, std::acos(-1.0) / 2, oscillator, Eigen::RowVector2d(1, 0));
  expect_refusal(problem, "plant.sample_time", {"(z = -1;", "can be seen"});
}

void test_two_inputs_can_hold_what_one_cannot() {
  solved(regulator_alone(Domain::continuous, std::acos(-1.0) / 2, oscillator, MatrixXd::Identity(2, 2)));
}

void test_sample_time_near_half_a_turn_is_no_reason() {
  solved(regulator_alone(Domain::continuous, 1.57, oscillator, Eigen::Vector2d(0, 1)));
}

void test_continuous_gain_that_is_too_fast_for_the_sample_time() {
  Problem problem = double_integrator(10);
  problem.regulator->cost = Cost::continuous;
  expect_refusal(problem, "lqr.cost", {"does not stabilise the sampled plant"});
}

void test_continuous_cost_needs_R() {
  Problem problem = double_integrator(0.1);
  problem.regulator->R.setZero();
  problem.regulator->cost = Cost::continuous;
  expect_refusal(problem, "lqr.R", {"positive definite"});
}

void test_discrete_plant_has_no_trajectory_between_its_samples() {
  Problem problem = regulator_alone(Domain::discrete, 1, MatrixXd::Constant(1, 1, 2), MatrixXd::Identity(1, 1));
  problem.regulator->cost = Cost::sampled;
  expect_refusal(problem, "lqr.cost", {"\"discrete\""});
  problem = estimator_alone(Domain::discrete, 1, MatrixXd::Constant(1, 1, 2), MatrixXd::Identity(1, 1));
  problem.estimator->noise = Noise::continuous;
  expect_refusal(problem, "kalman.noise", {"\"discrete\""});
}

void test_indefinite_weights_and_covariances() {
  Problem problem = double_integrator(0.1);
  problem.regulator->Q(1, 1) = -0.25;
  expect_refusal(problem, "lqr.Q", {"-0.25"});
  problem = double_integrator(0.1);
  problem.regulator->R(0, 0) = -2;
  expect_refusal(problem, "lqr.R", {"-2"});
  problem = double_integrator(0.1);
  problem.regulator->N << 1.01, 0;
  expect_refusal(problem, "lqr.N", {"together"});
  problem = double_integrator(0.1);
  problem.estimator->W(0, 0) = -3;
  expect_refusal(problem, "kalman.process_noise", {"-3"});
  problem = double_integrator(0.1);
  problem.estimator->V.setZero();
  expect_refusal(problem, "kalman.measurement_noise", {"every output"});
}

// x⁺ = x + v + u/2, v⁺ = v + u.
Problem discrete_integrators(double weight_x, double weight_v) {
  Problem problem =
      regulator_alone(Domain::discrete, 1, (MatrixXd(2, 2) << 1, 1, 0, 1).finished(), Eigen::Vector2d(0.5, 1));
  problem.regulator->Q = Eigen::Vector2d(weight_x, weight_v).asDiagonal();
  return problem;
}

void test_weight_a_rounding_below_zero_on_a_mode_on_the_limit() {
  Problem problem = double_integrator(0.1);
  problem.regulator->Q = Eigen::Vector2d(-1e-17, 1).asDiagonal();
  expect_refusal(problem, "lqr.Q", {"s = 0 (z = 1; state x0)", "carries no weight"});
}

void test_weight_a_rounding_below_zero_on_a_stable_mode_is_no_reason() {
  Problem problem =
      regulator_alone(Domain::continuous, 0.1, Eigen::Vector2d(-1, -2).asDiagonal(), Eigen::Vector2d(1, 1));
  problem.regulator->Q = Eigen::Vector2d(-1e-17, 1).asDiagonal();
  solved(problem);
}

void test_integrator_without_weight_under_free_inputs() {
  Problem problem = discrete_integrators(0, 1);
  problem.regulator->R.setZero();
  expect_refusal(problem, "lqr.Q", {"z = 1 (state x0)", "carries no weight"});
}

// P0 knows the difference of two growing modes; so it stays.
void test_schedule_from_a_start_that_leaves_an_unstable_mode_certain() {
  Problem problem =
      estimator_alone(Domain::discrete, 1, Eigen::Vector2d(1.5, 1.2).asDiagonal(), Eigen::RowVector2d(1, 1));
  problem.estimator->W.setZero();
  problem.estimator->gain = Gain::schedule;
  problem.estimator->P0 = MatrixXd::Ones(2, 2);
  expect_refusal(problem, "kalman.initial_covariance", {"z = 1.5", "z = 1.2", "never become the steady ones"});
  problem.estimator->P0(0, 0) = 1.5;
  solved(problem);
}

// With R = 0 the poles go to the zeros from u to what is weighed: x has one at z = −1.
void test_zero_on_the_circle_under_free_inputs() {
  Problem problem = discrete_integrators(1, 0);
  problem.regulator->R.setZero();
  expect_refusal(problem, "lqr.Q", {"tends to z = -1", "no stabilising gain is optimal"});
}

// (x0 − x1)² of x⁺ = [x1; u]: u = x1 keeps it 0 for ever, and x where it is. The pole at 1 is one as a double with few
// digits.
void test_pole_that_tends_to_exactly_one() {
  Problem problem =
      regulator_alone(Domain::discrete, 1, (MatrixXd(2, 2) << 0, 1, 0, 0).finished(), Eigen::Vector2d(0, 1));
  problem.regulator->Q = (MatrixXd(2, 2) << 1, -1, -1, 1).finished();
  problem.regulator->R.setZero();
  expect_refusal(problem, "lqr.Q", {"tends to z = 1 ", "no stabilising gain is optimal"});
}

// The gain that is held need not be optimal for ever: the integrator stays where it is.
void test_pole_at_one_under_a_gain_that_is_held_is_no_reason() {
  Problem problem = regulator_alone(Domain::discrete, 1, MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2));
  problem.regulator->Q = (MatrixXd(2, 2) << 1, 1, 1, 1).finished() / 3;
  problem.regulator->horizon = 3;
  Findings findings;
  TEST_ASSERT_TRUE(solve(problem, findings).has_value());
}

void test_free_inputs_are_no_reason_where_every_state_is_weighed() {
  Problem problem = discrete_integrators(1, 1);
  problem.regulator->R.setZero();
  solved(problem);
}

void test_output_without_noise_is_named() {
  Problem problem = two_mass();
  problem.plant.outputs = {{"near", "m"}, {"far", "m"}};
  problem.estimator->V(1, 1) = 0;
  expect_refusal(problem, "kalman.measurement_noise", {"every output", "far has none"});
  problem.estimator->V.setOnes();
  expect_refusal(problem, "kalman.measurement_noise", {"far has only that of the outputs before it"});
}

void test_weight_that_is_not_symmetric() {
  Problem problem = double_integrator(0.1);
  problem.regulator->Q(0, 1) = 1e-3;
  expect_refusal(problem, "lqr.Q", {"symmetric"});
}

// CᵀC of C = [1/3 2/3], typed with four digits: its least eigenvalue is −1e-5 of the largest … and with ten
// it passes.
void test_weight_of_typed_digits_passes_when_they_are_many() {
  Problem problem = double_integrator(0.1);
  problem.regulator->Q << 0.1111111111, 0.2222222222, 0.2222222222, 0.4444444443;
  solved(problem);
}

void expect_overflow(double rate, lqg::design::Scalar real, const char* part) {
  Problem problem = regulator_alone(Domain::continuous, 1, MatrixXd::Constant(1, 1, rate), MatrixXd::Identity(1, 1));
  problem.code.real = real;
  Findings findings;
  TEST_ASSERT_FALSE(solve(problem, findings).has_value());
  TEST_ASSERT_EQUAL_STRING("plant", findings[0].key.c_str());
  TEST_ASSERT_EQUAL_STRING(part, findings[0].message.c_str());
}

void test_sampled_plant_too_large_for_the_target() {
  expect_overflow(100, lqg::design::Scalar::float32, "plant.A has an entry too large for float");
  expect_overflow(1000, lqg::design::Scalar::float64, "plant.A has an entry too large for double");
}

void test_variance_too_small_for_float() {
  Problem problem = estimator_alone(Domain::discrete, 1, MatrixXd::Constant(1, 1, 1), MatrixXd::Identity(1, 1));
  problem.estimator->V *= 1e-60;
  problem.estimator->gain = Gain::online;
  problem.code.real = lqg::design::Scalar::float32;
  expect_refusal(problem, "kalman.measurement_noise", {"too small for float"});
}

void test_entry_too_small_for_float_is_a_note() {
  Problem problem =
      regulator_alone(Domain::continuous, 1, Eigen::Vector2d(-1, -200).asDiagonal(), Eigen::Vector2d(1, 1));
  problem.code.real = lqg::design::Scalar::float32;
  Findings findings;
  TEST_ASSERT_TRUE(solve(problem, findings).has_value());
  TEST_ASSERT_FALSE(findings.empty());
  TEST_ASSERT_FALSE(has_error(findings));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_unstable_mode_that_no_input_reaches);
  RUN_TEST(test_stable_mode_that_no_input_reaches_is_no_reason);
  RUN_TEST(test_stable_mode_that_no_input_makes_as_fast_as_asked_for);
  RUN_TEST(test_undamped_pair_that_no_input_reaches);
  RUN_TEST(test_discrete_mode_on_the_circle_that_no_input_reaches);
  RUN_TEST(test_defective_mode_that_no_input_reaches);
  RUN_TEST(test_unstable_mode_that_no_output_sees);
  RUN_TEST(test_position_that_is_not_measured);
  RUN_TEST(test_integrator_without_weight);
  RUN_TEST(test_integrator_without_weight_under_the_continuous_cost);
  RUN_TEST(test_discrete_oscillation_without_weight);
  RUN_TEST(test_unstable_mode_without_weight_is_no_reason);
  RUN_TEST(test_integrator_that_no_noise_drives);
  RUN_TEST(test_constant_bias_that_no_noise_drives);
  RUN_TEST(test_sample_time_that_hides_an_oscillation_from_its_input);
  RUN_TEST(test_sample_time_of_a_whole_turn_hides_an_oscillation_from_every_held_input);
  RUN_TEST(test_sample_time_that_hides_an_oscillation_from_the_output);
  RUN_TEST(test_two_inputs_can_hold_what_one_cannot);
  RUN_TEST(test_sample_time_near_half_a_turn_is_no_reason);
  RUN_TEST(test_continuous_gain_that_is_too_fast_for_the_sample_time);
  RUN_TEST(test_continuous_cost_needs_R);
  RUN_TEST(test_discrete_plant_has_no_trajectory_between_its_samples);
  RUN_TEST(test_indefinite_weights_and_covariances);
  RUN_TEST(test_weight_a_rounding_below_zero_on_a_mode_on_the_limit);
  RUN_TEST(test_weight_a_rounding_below_zero_on_a_stable_mode_is_no_reason);
  RUN_TEST(test_integrator_without_weight_under_free_inputs);
  RUN_TEST(test_schedule_from_a_start_that_leaves_an_unstable_mode_certain);
  RUN_TEST(test_zero_on_the_circle_under_free_inputs);
  RUN_TEST(test_pole_that_tends_to_exactly_one);
  RUN_TEST(test_pole_at_one_under_a_gain_that_is_held_is_no_reason);
  RUN_TEST(test_free_inputs_are_no_reason_where_every_state_is_weighed);
  RUN_TEST(test_output_without_noise_is_named);
  RUN_TEST(test_weight_that_is_not_symmetric);
  RUN_TEST(test_weight_of_typed_digits_passes_when_they_are_many);
  RUN_TEST(test_sampled_plant_too_large_for_the_target);
  RUN_TEST(test_variance_too_small_for_float);
  RUN_TEST(test_entry_too_small_for_float_is_a_note);
  return UNITY_END();
}
