// SPDX-License-Identifier: MIT
// Matrices whose entries are more exact than doubles.
#include <unity.h>

#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"
#include "design/sampled/samples.hpp"
#include "problems.hpp"

using namespace lqg::design;

namespace {

RealMatrix thirds() {
  RealMatrix thirds(1, 2);
  thirds << Real(1) / 3, Real(0.5);
  return thirds;
}

// A plant of one state at ẋ = −x/3 + u.
Problem slow_decay(const ExactMatrix& A) {
  Problem problem;
  problem.plant.sample_time = 0.1;
  problem.plant.A = A;
  problem.plant.B = problem.plant.C = problem.plant.G = Eigen::MatrixXd::Identity(1, 1);
  problem.plant.D = problem.plant.H = Eigen::MatrixXd::Zero(1, 1);
  return problem;
}

void test_all_digits_of_a_third_come_back() {
  const Digits scope(450);
  const ExactMatrix matrix = ExactMatrix::of(thirds());
  TEST_ASSERT_EQUAL_DOUBLE(1.0 / 3, matrix(0, 0));
  const Digits fewer(200);
  TEST_ASSERT_TRUE(abs(real(matrix)(0, 0) - Real(1) / 3) < power_of_ten(-199));
}

void test_what_doubles_can_hold_keeps_nothing_else() {
  const Digits scope(450);
  TEST_ASSERT_NULL(ExactMatrix::of(real(Eigen::MatrixXd(Eigen::MatrixXd::Constant(2, 2, 0.1)))).exact());
}

void test_an_entry_that_was_changed_is_its_double() {
  const Digits scope(450);
  ExactMatrix matrix = ExactMatrix::of(thirds());
  matrix(0, 0) = 0.25;
  TEST_ASSERT_TRUE(real(matrix)(0, 0) == Real(0.25));
  matrix = Eigen::MatrixXd::Constant(1, 2, 1.0 / 3);
  TEST_ASSERT_TRUE(real(matrix)(0, 1) == Real(1.0 / 3));
}

// e^(−T/3). From the double next to −1/3 it would differ in the 19th digit.
void test_a_plant_is_sampled_without_rounding_before() {
  const Digits scope(100);
  RealMatrix A(1, 1);
  A << Real(-1) / 3;
  const Real sampled = sample(slow_decay(ExactMatrix::of(A))).plant.A(0, 0);
  const Real T(0.1), expected = exp(-T / 3), of_double = exp(-T * Real(1.0 / 3));
  TEST_ASSERT_TRUE(abs(sampled - expected) < power_of_ten(-95));
  TEST_ASSERT_TRUE(abs(sampled - of_double) > power_of_ten(-19));
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_all_digits_of_a_third_come_back);
  RUN_TEST(test_what_doubles_can_hold_keeps_nothing_else);
  RUN_TEST(test_an_entry_that_was_changed_is_its_double);
  RUN_TEST(test_a_plant_is_sampled_without_rounding_before);
  return UNITY_END();
}
