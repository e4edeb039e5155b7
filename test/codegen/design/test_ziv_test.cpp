// SPDX-License-Identifier: MIT
// Ziv's test: what it lets pass, what it makes exact, and what it holds back.
#include <cmath>
#include <limits>

#include <unity.h>

#include "design/numeric/ziv_test.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

const unsigned coarse_digits = 50;

// 1/3 with an error of 10^exponent.
Real third(double exponent) { return 1 / Real(3) + power_of_ten(exponent); }

bool settled(const Real& coarse, Real& fine) { return passes_ziv_test(coarse, fine, Real(1), coarse_digits); }

void test_two_runs_that_agree_are_settled() {
  const Digits scope(100);
  Real fine = third(-90);
  TEST_ASSERT_TRUE(settled(third(-45), fine));
  TEST_ASSERT_TRUE(to_double(fine) == 1 / 3.0);
}

void test_run_that_lost_its_digits_is_held_back() {
  const Digits scope(100);
  Real fine = third(-90);
  TEST_ASSERT_FALSE(settled(third(-12), fine));
}

// Both round to the same double, but the coarse run is too far away to say where the exact number lies.
void test_agreement_by_accident_is_held_back() {
  const Digits scope(100);
  const Real eps = std::ldexp(1.0, -52);
  Real fine = 1 + eps * 0.49;
  TEST_ASSERT_TRUE(to_double(Real(1 + eps * 0.4)) == to_double(fine));
  TEST_ASSERT_FALSE(settled(1 + eps * 0.4, fine));
}

void test_number_that_is_settled_as_a_double_but_not_as_a_float_is_held_back() {
  const Digits scope(100);
  const Real near_middle = 1 + Real(std::ldexp(1.0, -24)) * (1 + power_of_ten(-30));
  Real fine = near_middle + power_of_ten(-45);
  TEST_ASSERT_FALSE(settled(near_middle - power_of_ten(-35), fine));
}

void test_rounding_around_zero_becomes_zero() {
  const Digits scope(100);
  Real fine = power_of_ten(-97);
  TEST_ASSERT_TRUE(settled(-power_of_ten(-48), fine));
  TEST_ASSERT_TRUE(fine.is_zero());
}

// 10^−40 beside 1 is far more than the rounding of 100 digits: a true number of which the coarse run knows
// too little.
void test_small_number_does_not_become_zero() {
  const Digits scope(100);
  Real fine = power_of_ten(-40);
  TEST_ASSERT_FALSE(settled(fine + power_of_ten(-47), fine));
  TEST_ASSERT_FALSE(fine.is_zero());
}

// 10^−65 beside 1 is hidden in the rounding of 50 digits; a rounding would have become 10^−98 by now.
void test_small_number_that_the_coarse_run_could_not_see_does_not_become_zero() {
  const Digits scope(100);
  Real fine = power_of_ten(-65);
  TEST_ASSERT_FALSE(settled(power_of_ten(-49), fine));
  TEST_ASSERT_FALSE(fine.is_zero());
}

void test_tiny_number_on_which_both_runs_agree_is_kept() {
  const Digits scope(100);
  Real fine = exp(Real(-700));
  TEST_ASSERT_TRUE(settled(fine * (1 + power_of_ten(-48)), fine));
  TEST_ASSERT_TRUE(to_double(fine) > 0);
}

void test_middle_between_two_doubles_is_a_tie_to_even() {
  const Digits scope(100);
  const Real middle = 1 + Real(std::ldexp(1.0, -53));
  Real fine = middle + power_of_ten(-95);
  TEST_ASSERT_TRUE(settled(middle - power_of_ten(-46), fine));
  TEST_ASSERT_TRUE(fine == middle && to_double(fine) == 1);
}

void test_middle_between_two_floats_is_a_tie_to_even() {
  const Digits scope(100);
  const Real middle = 1 + 3 * Real(std::ldexp(1.0, -24));
  Real fine = middle - power_of_ten(-95);
  TEST_ASSERT_TRUE(settled(middle + power_of_ten(-46), fine));
  TEST_ASSERT_TRUE(to_float(fine) == 1 + std::ldexp(1.0f, -22));
}

void test_number_near_a_tie_but_not_on_it_is_held_back() {
  const Digits scope(100);
  const Real middle = 1 + Real(std::ldexp(1.0, -53));
  Real fine = middle + power_of_ten(-40);
  TEST_ASSERT_FALSE(settled(middle - power_of_ten(-46), fine));
}

void test_negative_zero_loses_its_sign() {
  const Digits scope(100);
  Real fine = -Real(0);
  TEST_ASSERT_TRUE(settled(Real(0), fine));
  TEST_ASSERT_FALSE(std::signbit(to_double(fine)));
}

void test_what_is_not_finite_is_held_back() {
  const Digits scope(100);
  Real fine = std::numeric_limits<double>::quiet_NaN();
  TEST_ASSERT_FALSE(settled(fine, fine));
  fine = std::numeric_limits<double>::infinity();
  TEST_ASSERT_FALSE(settled(fine, fine));
}

void test_poles_that_were_not_found_are_held_back() {
  const Digits scope(100);
  const Real unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<ComplexReal> fine = {{unknown, unknown}};
  TEST_ASSERT_FALSE(passes_ziv_test({{unknown, unknown}}, fine));
  TEST_ASSERT_FALSE(passes_ziv_test({{Real(0.5), Real(0)}}, fine));
}

void test_matrices_of_different_shapes_are_held_back() {
  const Digits scope(100);
  RealMatrix fine = zeros(2, 1);
  TEST_ASSERT_FALSE(passes_ziv_test(zeros(2, 2), fine, coarse_digits));
}

void test_one_entry_holds_its_matrix_back() {
  const Digits scope(100);
  RealMatrix coarse = RealMatrix::Constant(2, 2, Real(1)), fine = coarse;
  TEST_ASSERT_TRUE(passes_ziv_test(coarse, fine, coarse_digits));
  coarse(1, 0) += power_of_ten(-10);
  TEST_ASSERT_FALSE(passes_ziv_test(coarse, fine, coarse_digits));
}

void test_poles_are_compared_with_their_nearest() {
  const Digits scope(100);
  const Real e = power_of_ten(-30);
  std::vector<ComplexReal> fine = {{Real(0.5), Real(0.25)}, {Real(0.5), Real(-0.25)}, {Real(0.75), Real(0)}};
  const std::vector<ComplexReal> coarse = {{0.75 + e, Real(0)}, {0.5 - e, 0.25 + e}, {Real(0.5), Real(-0.25)}};
  TEST_ASSERT_TRUE(passes_ziv_test(coarse, fine));
}

// Of a double pole each run knows half of its digits.
void test_double_pole_becomes_real() {
  const Digits scope(100);
  const Real coarse_error = power_of_ten(-25), fine_error = power_of_ten(-50);
  std::vector<ComplexReal> fine = {{Real(0.3), fine_error}, {Real(0.3), -fine_error}};
  TEST_ASSERT_TRUE(passes_ziv_test({{Real(0.3), coarse_error}, {Real(0.3), -coarse_error}}, fine));
  TEST_ASSERT_TRUE(fine[0].im.is_zero() && fine[1].im.is_zero());
}

void test_pole_that_moved_is_held_back() {
  const Digits scope(100);
  std::vector<ComplexReal> fine = {{Real(0.3), Real(0)}};
  TEST_ASSERT_FALSE(passes_ziv_test({{Real(0.3) + power_of_ten(-12), Real(0)}}, fine));
}

// 50 digits found one of two poles at 0 exactly; the nearest to the other's 10^−100 is that one.
void test_poles_at_zero_are_settled_whichever_is_exact() {
  const Digits scope(100);
  std::vector<ComplexReal> fine = {{power_of_ten(-100), Real(0)}, {Real(0), Real(0)}};
  TEST_ASSERT_TRUE(passes_ziv_test({{Real(0), Real(0)}, {power_of_ten(-50), Real(0)}}, fine));
  TEST_ASSERT_TRUE(fine[0].re.is_zero() && fine[1].re.is_zero());
}

void test_rounding_to_double_and_float_is_to_nearest_and_gradual() {
  const Digits scope(50);
  TEST_ASSERT_TRUE(to_double(power_of_ten(-320)) == 1e-320);
  TEST_ASSERT_TRUE(to_float(power_of_ten(-44)) == 1e-44f);
  TEST_ASSERT_TRUE(to_double(Real(1) / 10) == 0.1);
  TEST_ASSERT_TRUE(to_float(Real(1) / 10) == 0.1f);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_two_runs_that_agree_are_settled);
  RUN_TEST(test_run_that_lost_its_digits_is_held_back);
  RUN_TEST(test_agreement_by_accident_is_held_back);
  RUN_TEST(test_number_that_is_settled_as_a_double_but_not_as_a_float_is_held_back);
  RUN_TEST(test_rounding_around_zero_becomes_zero);
  RUN_TEST(test_small_number_does_not_become_zero);
  RUN_TEST(test_small_number_that_the_coarse_run_could_not_see_does_not_become_zero);
  RUN_TEST(test_tiny_number_on_which_both_runs_agree_is_kept);
  RUN_TEST(test_middle_between_two_doubles_is_a_tie_to_even);
  RUN_TEST(test_middle_between_two_floats_is_a_tie_to_even);
  RUN_TEST(test_number_near_a_tie_but_not_on_it_is_held_back);
  RUN_TEST(test_negative_zero_loses_its_sign);
  RUN_TEST(test_what_is_not_finite_is_held_back);
  RUN_TEST(test_poles_that_were_not_found_are_held_back);
  RUN_TEST(test_matrices_of_different_shapes_are_held_back);
  RUN_TEST(test_one_entry_holds_its_matrix_back);
  RUN_TEST(test_poles_are_compared_with_their_nearest);
  RUN_TEST(test_double_pole_becomes_real);
  RUN_TEST(test_pole_that_moved_is_held_back);
  RUN_TEST(test_poles_at_zero_are_settled_whichever_is_exact);
  RUN_TEST(test_rounding_to_double_and_float_is_to_nearest_and_gradual);
  return UNITY_END();
}
