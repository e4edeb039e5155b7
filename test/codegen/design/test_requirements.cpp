// SPDX-License-Identifier: MIT
// What the design file requires of the loop, and what the target's numbers make of it.
#include <cmath>
#include <string>

#include <unity.h>

#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

void expect_errors(const Problem& problem, const std::vector<std::string>& expected) {
  Findings findings;
  TEST_ASSERT_FALSE(solve(problem, findings).has_value());
  TEST_ASSERT_EQUAL(expected.size(), findings.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string found = findings[i].key + ": " + findings[i].message;
    TEST_ASSERT_TRUE_MESSAGE(found.find(expected[i]) != std::string::npos, found.c_str());
  }
}

void test_requirements_that_the_loop_meets_exactly() {
  Problem problem = two_mass();
  const LoopSolution loop = solved(problem).loop;
  problem.requirements = {loop.at_input.gain_dB, loop.at_input.phase_deg, loop.at_input.disk, std::abs(loop.poles[0])};
  solved(problem);
}

void test_every_missed_requirement_is_told_with_both_numbers() {
  Problem problem = two_mass();
  const LoopSolution loop = solved(problem).loop;
  problem.requirements = {40, 80, 1.9, 0.5};
  char pole[32];
  std::snprintf(pole, sizeof pole, "%.6g", std::abs(loop.poles[0]));
  expect_errors(problem, {"require.gain_margin_dB: requires at least 40 dB, the loop has ",
                          "require.phase_margin_deg: requires at least 80°, the loop has ",
                          "require.disk_margin: requires at least 1.9, the loop has ",
                          std::string("require.max_pole: requires no pole beyond |z| = 0.5, the loop has ") + pole});
}

// A difference that six digits do not show.
void test_requirement_missed_by_a_last_bit_shows_it() {
  Problem problem = two_mass();
  const double disk = *solved(problem).loop.at_input.disk;
  problem.requirements.disk_margin = std::nextafter(disk, 2);
  char text[128];
  std::snprintf(text, sizeof text, "requires at least %.17g, the loop has %.17g", std::nextafter(disk, 2), disk);
  expect_errors(problem, {text});
}

void test_margins_of_a_filter_alone_cannot_be_required() {
  Problem problem = two_mass();
  problem.regulator.reset();
  problem.requirements.gain_margin_dB = 6;
  expect_errors(problem, {"require.gain_margin_dB: there is no stable loop"});
  problem.requirements = {{}, {}, {}, 0.99};
  solved(problem);
}

void test_margin_that_nothing_exhausts_is_met() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::discrete, 1, 0 * one, one, one);
  problem.estimator.reset();
  problem.requirements.gain_margin_dB = 100;
  solved(problem);
}

void test_rounded_loop_of_a_tame_design_is_the_exact_one_to_some_digits() {
  Problem problem = two_mass();
  problem.code.real = lqg::design::Scalar::float32;
  const LoopSolution loop = solved(problem).loop;
  TEST_ASSERT_TRUE(loop.rounded.has_value());
  TEST_ASSERT_EQUAL(loop.poles.size(), loop.rounded->poles.size());
  for (std::size_t i = 0; i < loop.poles.size(); ++i)  // two pairs are nearly one: the root of a float's rounding
    TEST_ASSERT_TRUE(std::abs(loop.poles[i] - loop.rounded->poles[i]) < 1e-4);
  TEST_ASSERT_DOUBLE_WITHIN(1e-5 * *loop.at_output.disk, *loop.at_output.disk, *loop.rounded->at_output.disk);
  TEST_ASSERT_DOUBLE_WITHIN(1e-5 * *loop.at_input.gain_dB, *loop.at_input.gain_dB, *loop.rounded->at_input.gain_dB);
  TEST_ASSERT_DOUBLE_WITHIN(1e-5 * *loop.cost_per_sample, *loop.cost_per_sample, *loop.rounded->cost_per_sample);
  TEST_ASSERT_TRUE(*loop.cost_per_sample != *loop.rounded->cost_per_sample);
}

// e^20 in one period: K is −A to the last bits of a float, and what these leave of it is more than 1.
void test_loop_that_float_makes_unstable_is_refused() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::continuous, 1, 20 * one, one, one);
  problem.estimator.reset();
  solved(problem);
  problem.code.real = lqg::design::Scalar::float32;
  expect_errors(problem, {"code.real: the loop with the numbers rounded to float is unstable: a pole at z = "});
}

// L = 1/3, and 1 − 3L is what a float leaves of it.
void test_filter_alone_that_float_makes_unstable_is_refused() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::continuous, 1, 20 * one, one, 3 * one);
  problem.regulator.reset();
  solved(problem);
  problem.code.real = lqg::design::Scalar::float32;
  expect_errors(problem, {"code.real: the filter with the numbers rounded to float is unstable: a pole at z = "});
}

// 10^−9 s of a plant that moves in seconds: in float nothing ever happens.
void test_plant_that_stands_still_in_float_is_refused() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::continuous, 1e-9, -one, one, one);
  solved(problem);
  problem.code.real = lqg::design::Scalar::float32;
  expect_errors(problem, {"code.real: A becomes the identity in float: the sampled plant cannot be represented"});
}

// Nor in double or any other digits; the gains need not be tried.
void test_plant_that_stands_still_in_every_number_is_refused_for_that() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  const Problem problem = problem_of(Domain::continuous, 1e-300, -one, one, one);
  expect_errors(problem, {"code.real: A becomes the identity in double: the sampled plant cannot be represented"});
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_requirements_that_the_loop_meets_exactly);
  RUN_TEST(test_every_missed_requirement_is_told_with_both_numbers);
  RUN_TEST(test_requirement_missed_by_a_last_bit_shows_it);
  RUN_TEST(test_margins_of_a_filter_alone_cannot_be_required);
  RUN_TEST(test_margin_that_nothing_exhausts_is_met);
  RUN_TEST(test_rounded_loop_of_a_tame_design_is_the_exact_one_to_some_digits);
  RUN_TEST(test_loop_that_float_makes_unstable_is_refused);
  RUN_TEST(test_filter_alone_that_float_makes_unstable_is_refused);
  RUN_TEST(test_plant_that_stands_still_in_float_is_refused);
  RUN_TEST(test_plant_that_stands_still_in_every_number_is_refused_for_that);
  return UNITY_END();
}
