// SPDX-License-Identifier: MIT
// Designs that are formally right and of little use: each has a note at the key to look at, and designs that are as
// they should be have none.
#include <cmath>
#include <limits>
#include <string>

#include <unity.h>

#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

Findings notes_of(const Problem& problem) {
  Findings findings;
  const bool is_solved = solve(problem, findings).has_value();
  TEST_ASSERT_TRUE_MESSAGE(is_solved, findings.empty() ? "" : findings.front().message.c_str());
  return findings;
}

void expect_note(const Problem& problem, const std::string& key, const std::string& part) {
  std::string all;
  for (const Finding& finding : notes_of(problem)) {
    if (finding.key == key && finding.message.find(part) != std::string::npos) return;
    all += finding.key + ": " + finding.message + "\n";
  }
  TEST_FAIL_MESSAGE((key + ": " + part + " is not among\n" + all).c_str());
}

void expect_no_notes(const Problem& problem) {
  for (const Finding& finding : notes_of(problem)) TEST_FAIL_MESSAGE((finding.key + ": " + finding.message).c_str());
}

// A motor with its angle and speed, ±20 V: the plant and weights of a 50 Hz servo.
Problem servo(double sample_time) {
  Problem problem = problem_of(Domain::continuous, sample_time, (MatrixXd(2, 2) << 0, 1, 0, -47.37).finished(),
                               Eigen::Vector2d(0, 2017), (MatrixXd(1, 2) << 1, 0).finished());
  problem.plant.inputs = {{"voltage", "V"}};
  problem.plant.outputs = {{"angle", "rad"}};
  problem.regulator->Q = Eigen::Vector2d(400, 4e-4).asDiagonal();
  problem.regulator->R = MatrixXd::Constant(1, 1, 1 / 400.0);
  problem.estimator->W = Eigen::Vector2d(0, 1).asDiagonal();
  problem.estimator->V = MatrixXd::Constant(1, 1, 1e-10);
  problem.limits = limits_of_size(VectorXd::Constant(1, -20), VectorXd::Constant(1, 20));
  problem.code.real = Scalar::float64;
  return problem;
}

void test_design_as_it_should_be_has_no_notes() { expect_no_notes(servo(0.001)); }

// The 1 of A is that of ẋ = v, and −47.37 that of a time constant.
void test_continuous_plant_that_is_declared_discrete() {
  Problem problem = servo(0.001);
  problem.plant.domain = Domain::discrete;
  problem.regulator->cost = Cost::discrete;
  problem.estimator->noise = Noise::discrete;
  expect_note(problem, "plant.domain", "z = -47.37");
  expect_note(problem, "lqr", "gain margin");
}

void test_second_that_is_typed_for_a_millisecond() { expect_note(servo(1), "lqr", "one sample later"); }

void test_fast_oscillation_between_the_samples() {
  Problem problem = problem_of(Domain::continuous, 0.1, (MatrixXd(2, 2) << 0, 1, -1e4, -0.1).finished(),
                               Eigen::Vector2d(0, 1), MatrixXd::Identity(1, 2));
  expect_note(problem, "plant.sample_time", "turns more than half a circle");
  problem.plant.A = Eigen::Vector2d(20, -1).asDiagonal();
  problem.plant.B = Eigen::Vector2d(1, 1);
  problem.plant.C = MatrixXd::Ones(1, 2);
  expect_note(problem, "plant.sample_time", "grows more than e-fold");
}

void test_samples_much_faster_than_the_loop() {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  Problem problem = problem_of(Domain::continuous, 1e-6, -one, one, one);
  problem.code.real = Scalar::float64;
  expect_note(problem, "plant.sample_time", "samples for its time constant");
}

void test_weights_far_apart() {
  Problem problem = servo(0.001);
  problem.regulator->Q = MatrixXd::Identity(2, 2) * 1e30;
  problem.regulator->R = MatrixXd::Constant(1, 1, 1e-30);
  expect_note(problem, "lqr.R", "as good as none");
  problem.regulator->Q = MatrixXd::Identity(2, 2) * 1e-30;
  problem.regulator->R = MatrixXd::Constant(1, 1, 1e30);
  problem.plant.A(0, 0) = -1;  // stable: there is nothing to do
  expect_note(problem, "lqr.R", "moves no pole");
}

void test_input_that_is_thirteen_decades_off() {
  Problem problem = servo(0.001);
  problem.plant.A(0, 0) = -1;
  problem.plant.B *= 1e-13;
  expect_note(problem, "lqr.R", "moves no pole");
  problem.plant.B *= 1e26;
  expect_note(problem, "lqr.R", "as good as none");
}

void test_settling_time_of_a_tenth_of_a_sample() {
  Problem problem = servo(0.001);
  problem.regulator->settling_time = 1e-4;
  expect_note(problem, "lqr.settling_time", "within one sample");
}

// x⁺ = 1.5 x + u, u = −1.5 x, nearly: a sample later z² − 1.5 z + 1.5 = 0, |z|² = 1.5.
void test_loop_that_one_sample_of_delay_makes_unstable() {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  Problem problem = regulator_alone(problem_of(Domain::discrete, 1, 1.5 * one, one, one));
  problem.regulator->R *= 1e-6;
  expect_note(problem, "lqr", "one sample later");
}

// x⁺ = a x + u + w, u = −K x̂ with V ≈ 0: u has K times the rms of x = √(W/(1 − (a − K)²)).
void test_noise_that_takes_the_input_to_its_limits() {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  Problem problem = problem_of(Domain::discrete, 1, 0.95 * one, one, one);
  problem.estimator->V *= 1e-12;
  problem.regulator->R *= 10;
  Findings findings;
  const double K = static_cast<double>(solve(problem, findings)->regulator->K(0, 0));
  const double rms = K / std::sqrt(1 - (0.95 - K) * (0.95 - K));
  problem.limits = limits_of_size(VectorXd::Constant(1, -2.2 * rms), VectorXd::Constant(1, 1e3));
  expect_no_notes(problem);
  problem.limits->u_min(0) = -1.8 * rms;
  expect_note(problem, "limits.u_min[0]", "the noises alone move");
}

void test_reference_that_asks_for_more_than_the_limits_allow() {
  Problem problem = servo(0.001);
  problem.regulator->track = {0};
  expect_note(problem, "limits.u_max[0]", "a reference of 1 for angle asks at once for");
  problem.plant.A(0, 0) = -1;  // the angle is held by 47.37/2017 V
  problem.limits->u_max(0) = 0.02;
  problem.estimator->W *= 1e-12;
  expect_note(problem, "limits.u_max[0]", "a reference of 1 for angle takes for ever 0.0234");
  problem.regulator->track.clear();
  problem.regulator->integral = Integral{{0}, MatrixXd::Identity(1, 1)};
  expect_note(problem, "limits.u_max[0]", "a reference of 1 for angle takes for ever 0.0234");
}

// 1 + 3e-7 is 1 + 3.58e-7 as a float: what the filter's model grows by is a fifth off, as is then the filter's pole, 1
// − 3e-7.
void test_rounding_that_moves_the_slowest_pole() {
  Problem problem = problem_of(Domain::discrete, 1e-3, Eigen::Vector2d(1 + 3e-7, 0.5).asDiagonal(),
                               Eigen::Vector2d(1e-5, 1), MatrixXd::Ones(1, 2));
  problem.regulator->Q = Eigen::Vector2d(2.7e5, 1).asDiagonal();
  problem.regulator->R *= 1e8;
  problem.estimator->W *= 1e-16;
  problem.code.real = Scalar::float32;
  expect_note(problem, "code.real", "moves the slowest pole");
  problem.code.real = Scalar::float64;
  for (const Finding& finding : notes_of(problem))
    TEST_ASSERT_TRUE_MESSAGE(finding.key != "code.real", finding.message.c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_design_as_it_should_be_has_no_notes);
  RUN_TEST(test_continuous_plant_that_is_declared_discrete);
  RUN_TEST(test_second_that_is_typed_for_a_millisecond);
  RUN_TEST(test_fast_oscillation_between_the_samples);
  RUN_TEST(test_samples_much_faster_than_the_loop);
  RUN_TEST(test_weights_far_apart);
  RUN_TEST(test_input_that_is_thirteen_decades_off);
  RUN_TEST(test_settling_time_of_a_tenth_of_a_sample);
  RUN_TEST(test_loop_that_one_sample_of_delay_makes_unstable);
  RUN_TEST(test_noise_that_takes_the_input_to_its_limits);
  RUN_TEST(test_reference_that_asks_for_more_than_the_limits_allow);
  RUN_TEST(test_rounding_that_moves_the_slowest_pole);
  return UNITY_END();
}
