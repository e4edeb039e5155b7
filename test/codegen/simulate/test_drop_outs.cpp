// SPDX-License-Identifier: MIT
// A plain P, tried in the target's numbers: silence before it is looked at decides how much is lost when outputs come
// back.
#include <unity.h>

#include "simulate/drop_outs.hpp"
#include "../design/problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

// Positions measured to 3e-5; the covariance grows to 1e3 and more while they are missing, of which a float forgets ε
// P.
Problem precise_sensors(double initial_variance) {
  Problem problem = two_mass();
  problem.regulator.reset();
  Estimator& estimator = *problem.estimator;
  estimator.gain = Gain::online;
  estimator.covariance = Covariance::plain;
  estimator.V = MatrixXd::Identity(2, 2) * 1e-9;
  estimator.P0 = MatrixXd::Identity(4, 4) * initial_variance;
  problem.code.real = Scalar::float32;
  return problem;
}

Findings found_in(const Problem& problem) {
  Findings findings;
  const auto controller = lqg::controller::controller_of(problem, solved(problem), {}, findings);
  TEST_ASSERT_TRUE(controller.has_value());
  findings.clear();
  lqg::simulate::check_drop_outs(*controller, findings);
  for (const Finding& finding : findings) TEST_ASSERT_EQUAL_STRING("kalman.covariance", finding.key.c_str());
  return findings;
}

void test_a_plain_covariance_that_breaks_after_a_drop_out_is_noted() {
  const Findings findings = found_in(precise_sensors(1e-12));
  TEST_ASSERT_EQUAL_INT(1, static_cast<int>(findings.size()));
  TEST_ASSERT_TRUE(findings[0].severity == Severity::note);
}

void test_a_plain_covariance_that_breaks_at_the_start_is_refused() {
  const Findings findings = found_in(precise_sensors(1e6));
  TEST_ASSERT_EQUAL_INT(1, static_cast<int>(findings.size()));
  TEST_ASSERT_TRUE(findings[0].severity == Severity::error);
}

void test_factors_and_double_and_a_sensor_as_good_as_the_plant_need_no_note() {
  Problem factors = precise_sensors(1e-12), in_double = factors, fair = factors;
  factors.estimator->covariance = Covariance::ud;
  in_double.code.real = Scalar::float64;
  fair.estimator->V = MatrixXd::Identity(2, 2);
  in_double.estimator->V *= 1e3;
  for (const Problem& problem : {factors, in_double, fair}) TEST_ASSERT_TRUE(found_in(problem).empty());
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_plain_covariance_that_breaks_after_a_drop_out_is_noted);
  RUN_TEST(test_a_plain_covariance_that_breaks_at_the_start_is_refused);
  RUN_TEST(test_factors_and_double_and_a_sensor_as_good_as_the_plant_need_no_note);
  return UNITY_END();
}
