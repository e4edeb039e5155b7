// A plain P, tried in the target's numbers: silence before it is looked at decides how much is lost when outputs come back.
#include <unity.h>

#include "simulate/drop_outs.hpp"
#include "../design/problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

// Position measured to 1e-6; after k samples without it P₀₀ is about 1e-4 k³/3 · 1e-4, of which a float forgets ε P₀₀.
Problem precise_sensor(double initial_variance) {
  Problem problem = double_integrator(0.01);
  problem.regulator.reset();
  Estimator& estimator = *problem.estimator;
  estimator.gain = Gain::online;
  estimator.covariance = Covariance::plain;
  estimator.noise = Noise::discrete;
  estimator.W = MatrixXd::Identity(2, 2) * 1e-6;
  estimator.V = MatrixXd::Constant(1, 1, 1e-12);
  estimator.P0 = MatrixXd::Identity(2, 2) * initial_variance;
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
  const Findings findings = found_in(precise_sensor(1e-12));
  TEST_ASSERT_EQUAL_INT(1, static_cast<int>(findings.size()));
  TEST_ASSERT_TRUE(findings[0].severity == Severity::note);
}

void test_a_plain_covariance_that_breaks_at_the_start_is_refused() {
  const Findings findings = found_in(precise_sensor(1e6));
  TEST_ASSERT_EQUAL_INT(1, static_cast<int>(findings.size()));
  TEST_ASSERT_TRUE(findings[0].severity == Severity::error);
}

void test_factors_and_double_and_a_sensor_as_good_as_the_plant_need_no_note() {
  Problem factors = precise_sensor(1e-12), in_double = factors, fair = factors;
  factors.estimator->covariance = Covariance::ud;
  in_double.code.real = Scalar::float64;
  fair.estimator->V = MatrixXd::Constant(1, 1, 1e-4);
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
