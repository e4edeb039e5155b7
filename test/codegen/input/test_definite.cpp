// SPDX-License-Identifier: MIT
// Symmetry and definiteness, at the edges of their tolerances.
#include <cmath>
#include <string>

#include <unity.h>

#include "input/definite.hpp"

using namespace lqg::input;
using Eigen::MatrixXd;

namespace {

MatrixXd two_by_two(double a, double b, double c, double d) {
  MatrixXd result(2, 2);
  result << a, b, c, d;
  return result;
}

void expect_good(const MatrixXd& Q, bool strictly) {
  const auto culprit = indefinite(Q, strictly);
  TEST_ASSERT_FALSE_MESSAGE(culprit.has_value(), culprit ? culprit->c_str() : "");
}

void expect_bad(const char* culprit, const MatrixXd& Q, bool strictly) {
  const auto found = indefinite(Q, strictly);
  TEST_ASSERT_TRUE(found.has_value());
  TEST_ASSERT_EQUAL_STRING(culprit, found->c_str());
}

void test_asymmetry_is_relative_to_the_entries() {
  TEST_ASSERT_EQUAL_DOUBLE(0, worst_asymmetry(two_by_two(1, 2, 2, 1)).size);
  TEST_ASSERT_TRUE(worst_asymmetry(two_by_two(0, 1, 1 + 2e-9, 0)).size > symmetry_tolerance);
  TEST_ASSERT_TRUE(worst_asymmetry(two_by_two(0, 1, 1 + 5e-10, 0)).size < symmetry_tolerance);
  TEST_ASSERT_TRUE(worst_asymmetry(two_by_two(0, 1e-300, 2e-300, 0)).size > symmetry_tolerance);
}

// Dust off the diagonal is measured by √|q_ii q_jj|, not by itself.
void test_asymmetry_of_dust_is_small_beside_the_diagonal() {
  TEST_ASSERT_TRUE(worst_asymmetry(two_by_two(1e6, 1e-17, 0, 1e-6)).size < symmetry_tolerance);
  TEST_ASSERT_TRUE(worst_asymmetry(two_by_two(1e6, 1e-8, 0, 1e-6)).size > symmetry_tolerance);
}

void test_worst_asymmetry_is_found_among_several() {
  MatrixXd Q = MatrixXd::Identity(3, 3);
  Q(0, 1) = 1e-12;
  Q(2, 1) = 0.5;
  const Asymmetry worst = worst_asymmetry(Q);
  TEST_ASSERT_EQUAL_INT(1, worst.row);
  TEST_ASSERT_EQUAL_INT(2, worst.column);
}

void test_symmetrised_keeps_a_symmetric_matrix_to_the_bit() {
  const MatrixXd Q = two_by_two(4.9406564584124654e-324, 1.7e308, 1.7e308, 0.1);
  TEST_ASSERT_TRUE(symmetrised(Q) == Q);
  TEST_ASSERT_TRUE(symmetrised(two_by_two(1, 2, 4, 1)) == two_by_two(1, 3, 3, 1));
}

void test_product_typed_with_ten_digits_is_semidefinite() {
  // CᵀC of C = [1/3 2/7 0.123456789]
  const double c[] = {1.0 / 3, 2.0 / 7, 0.123456789};
  MatrixXd Q(3, 3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Q(i, j) = std::round(c[i] * c[j] * 1e11) / 1e11;
  expect_good(Q, false);
}

void test_eigenvalue_below_zero_is_named() {
  expect_bad("the eigenvalue -1", two_by_two(1, 2, 2, 1), false);
  expect_bad("the eigenvalue -1e+300", two_by_two(1e300, 2e300, 2e300, 1e300), false);
  expect_bad("the eigenvalue -1e-300", two_by_two(1e-300, 2e-300, 2e-300, 1e-300), true);
}

void test_entry_below_zero_on_the_diagonal_is_named_however_small() {
  expect_bad("[1][1] = -1e-30", two_by_two(1e9, 0, 0, -1e-30), false);
  expect_bad("[0][0] = 0", two_by_two(0, 0, 0, 1), true);
  expect_good(two_by_two(0, 0, 0, 1), false);
}

// A correlation of 10 hides behind units: 1e6 of one, 1e-8 of the other.
void test_units_do_not_hide_what_is_indefinite() {
  TEST_ASSERT_TRUE(indefinite(two_by_two(1e6, 1, 1, 1e-8), false).has_value());
  expect_good(two_by_two(1e12, 0.1, 0.1, 1e-12), true);
}

void test_zero_on_the_diagonal_allows_zeros_beside_it_only() {
  expect_good(two_by_two(0, 1e-12, 1e-12, 1), false);
  TEST_ASSERT_TRUE(indefinite(two_by_two(0, 1e-3, 1e-3, 1), false).has_value());
  expect_good(MatrixXd::Zero(3, 3), false);
}

void test_singular_matrix_is_not_definite() {
  expect_good(two_by_two(1, 1, 1, 1), false);
  TEST_ASSERT_TRUE(indefinite(two_by_two(1, 1, 1, 1), true).has_value());
  TEST_ASSERT_TRUE(indefinite(two_by_two(1.0 / 9, 2.0 / 9, 2.0 / 9, 4.0 / 9), true).has_value());
  expect_good(two_by_two(1, 1 - 1e-12, 1 - 1e-12, 1), true);
}

void test_joint_matrix_has_the_cross_term_twice() {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  TEST_ASSERT_TRUE(joint(one, 0.5 * one, 2 * one) == two_by_two(1, 0.5, 0.5, 2));
  expect_good(joint(one, one, one), false);
  expect_bad("the eigenvalue -0.1", joint(one, 1.1 * one, one), false);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_asymmetry_is_relative_to_the_entries);
  RUN_TEST(test_asymmetry_of_dust_is_small_beside_the_diagonal);
  RUN_TEST(test_worst_asymmetry_is_found_among_several);
  RUN_TEST(test_symmetrised_keeps_a_symmetric_matrix_to_the_bit);
  RUN_TEST(test_product_typed_with_ten_digits_is_semidefinite);
  RUN_TEST(test_eigenvalue_below_zero_is_named);
  RUN_TEST(test_entry_below_zero_on_the_diagonal_is_named_however_small);
  RUN_TEST(test_units_do_not_hide_what_is_indefinite);
  RUN_TEST(test_zero_on_the_diagonal_allows_zeros_beside_it_only);
  RUN_TEST(test_singular_matrix_is_not_definite);
  RUN_TEST(test_joint_matrix_has_the_cross_term_twice);
  return UNITY_END();
}
