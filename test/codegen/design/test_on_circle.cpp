// SPDX-License-Identifier: MIT
// Points of the unit circle in double, beside those of MPFR.
#include <cmath>

#include <unity.h>

#include "design/numeric/digits.hpp"
#include "design/numeric/on_circle.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

// To the bit: the chance of a tie that the many digits behind a double do not break is 1 in 2^40 of each.
void expect_rounded(const Real& angle) {
  const std::complex<double> found = on_circle(angle);
  TEST_ASSERT_TRUE(found.real() == to_double(cos(angle)));
  TEST_ASSERT_TRUE(found.imag() == to_double(sin(angle)));
}

Real half_turn() { return atan(Real(1)) * 4; }

void test_random_angles_of_the_half_circle_are_correctly_rounded() {
  const Digits scope(37);
  Random random(11);
  for (int i = 0; i < 20000; ++i) expect_rounded(half_turn() * (random.uniform() + 1) / 2);
}

void test_small_angles_keep_all_digits_of_their_sine() {
  const Digits scope(37);
  for (double angle = 1; angle > 1e-300; angle *= 0.37) expect_rounded(Real(angle) / 3);
}

void test_angles_near_a_half_turn_keep_all_digits_of_their_sine() {
  const Digits scope(37);
  for (double rest = 1; rest > 1e-15; rest *= 0.61) expect_rounded(half_turn() - Real(rest) / 3);
}

void test_angles_near_a_quarter_turn_keep_all_digits_of_their_cosine() {
  const Digits scope(37);
  for (double rest = 1; rest > 1e-15; rest *= 0.61) {
    expect_rounded(half_turn() / 2 - Real(rest) / 3);
    expect_rounded(half_turn() / 2 + Real(rest) / 3);
  }
}

// Where the table's neighbouring angles are equally near.
void test_angles_in_the_middle_between_those_of_the_table() {
  const Digits scope(37);
  for (int k = 0; k < 64; ++k)
    for (const double side : {-1e-12, 0.0, 1e-12}) expect_rounded(half_turn() * (k + 0.5) / 64 * (1 + side));
}

void test_ends_of_the_half_circle() {
  const Digits scope(37);
  TEST_ASSERT_TRUE(on_circle(Real(0)) == std::complex<double>(1, 0));
  TEST_ASSERT_TRUE(on_circle(half_turn()).real() == -1);
  TEST_ASSERT_TRUE(std::abs(on_circle(half_turn()).imag()) < 1e-35);
}

void test_angles_beyond_the_half_circle() {
  const Digits scope(37);
  for (const double angle : {-7.0, -1e-9, -0.5, 3.2, 4.7, 100.0}) expect_rounded(Real(angle));
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_random_angles_of_the_half_circle_are_correctly_rounded);
  RUN_TEST(test_small_angles_keep_all_digits_of_their_sine);
  RUN_TEST(test_angles_near_a_half_turn_keep_all_digits_of_their_sine);
  RUN_TEST(test_angles_near_a_quarter_turn_keep_all_digits_of_their_cosine);
  RUN_TEST(test_angles_in_the_middle_between_those_of_the_table);
  RUN_TEST(test_ends_of_the_half_circle);
  RUN_TEST(test_angles_beyond_the_half_circle);
  return UNITY_END();
}
