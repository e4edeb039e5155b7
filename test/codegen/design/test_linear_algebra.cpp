// SPDX-License-Identifier: MIT
// Products, solving, eigenvalues and triangular factors in many digits.
#include <cmath>

#include <unity.h>

#include "design/numeric/exact_reach.hpp"
#include "design/numeric/factor.hpp"
#include "design/numeric/modes.hpp"
#include "design/numeric/poles.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

const double rounding = 1e-45;  // of 50 digits, with five to spare for sums and condition

void test_products_of_a_transpose_agree_with_transposed_products() {
  const Digits scope(50);
  Random random(1);
  const RealMatrix a = real(random.matrix(4, 3)), b = real(random.matrix(4, 5)), p = real(random.semidefinite(4, 4));
  TEST_ASSERT_TRUE(is_zero(transpose_multiply(a, b) - multiply(a.transpose(), b)));
  TEST_ASSERT_TRUE(is_zero(multiply_transpose(a.transpose(), b.transpose()) - multiply(a.transpose(), b)));
  expect_small(distance(transpose_congruence(a, p), multiply(a.transpose(), multiply(p, a))), rounding, "aᵀpa");
  const RealMatrix congruent = congruence(a.transpose(), p);
  expect_small(distance(congruent, multiply(a.transpose(), multiply(p, a))), rounding, "apaᵀ");
  TEST_ASSERT_TRUE(is_zero(congruent - congruent.transpose()));
}

void test_solve_exchanges_rows_when_the_first_pivot_is_zero() {
  const Digits scope(50);
  const RealMatrix a = real((MatrixXd(2, 2) << 0, 2, 4, 1).finished());
  const std::optional<RealMatrix> x = solve(a, real(Eigen::Vector2d(6, 11)));
  TEST_ASSERT_TRUE(x.has_value());
  TEST_ASSERT_TRUE((*x)(0, 0) == 2 && (*x)(1, 0) == 3);
}

void test_solve_refuses_a_singular_matrix() {
  const Digits scope(50);
  TEST_ASSERT_FALSE(solve(real(MatrixXd::Constant(2, 2, 3)), identity(2)).has_value());
}

void test_solve_of_a_hilbert_matrix_loses_no_more_than_its_condition() {
  const Digits scope(50);
  const Index n = 10;
  RealMatrix hilbert(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) hilbert(i, j) = 1 / Real(i + j + 1);
  const RealMatrix ones = RealMatrix::Constant(n, 1, Real(1));
  const double condition = 2e13;  // J. Todd, "The condition of the finite segments of the Hilbert matrix", 1954
  expect_small(distance(*solve(hilbert, multiply(hilbert, ones)), ones), rounding * condition, "the error");
}

// The coefficients of Π(z − λ_i), highest first.
std::vector<Real> polynomial(const std::vector<ComplexReal>& roots) {
  std::vector<ComplexReal> c = {{Real(1), Real(0)}};
  for (const ComplexReal& root : roots) {
    c.push_back({Real(0), Real(0)});
    for (std::size_t k = c.size() - 1; k > 0; --k) {
      const ComplexReal before = c[k - 1];
      c[k].re -= root.re * before.re - root.im * before.im;
      c[k].im -= root.re * before.im + root.im * before.re;
    }
  }
  std::vector<Real> result;
  for (const ComplexReal& value : c) result.push_back(value.re);
  return result;
}

// The same from the matrix: M_k = A M_{k−1} + c_{k−1} I, c_k = −tr(A M_k)/k (Faddeev and Le Verrier).
std::vector<Real> characteristic_polynomial(const RealMatrix& A) {
  std::vector<Real> c = {Real(1)};
  RealMatrix M = zeros(A.rows(), A.rows());
  for (Index k = 1; k <= A.rows(); ++k) {
    M = multiply(A, M) + c.back() * identity(A.rows());
    c.push_back(-trace_of_product(A, M) / k);
  }
  return c;
}

void expect_same_polynomial(const RealMatrix& A, double bound) {
  const std::vector<Real> expected = characteristic_polynomial(A), found = polynomial(eigenvalues(A));
  TEST_ASSERT_EQUAL(expected.size(), found.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    expect_small(abs(found[k] - expected[k]), bound, "a coefficient's difference");
}

void test_eigenvalues_of_random_matrices_have_their_characteristic_polynomial() {
  const Digits scope(50);
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    expect_same_polynomial(
        real(Random(seed).matrix(1 + static_cast<Index>(seed % 9), 1 + static_cast<Index>(seed % 9))), rounding * 100);
}

// Shifts go in circles on a cyclic permutation: the exceptional ones must break it.
void test_eigenvalues_of_a_cyclic_permutation() {
  const Digits scope(50);
  RealMatrix A = zeros(8, 8);
  for (Index i = 0; i < 8; ++i) A((i + 1) % 8, i) = 1;
  expect_same_polynomial(A, rounding);
}

void test_eigenvalues_of_a_graded_matrix_keep_the_small_ones() {
  const Digits scope(50);
  const MatrixXd A = (MatrixXd(3, 3) << 1e15, 1, 0, 1, 1, 1e-15, 0, 1e-15, 1e-15).finished();
  const std::vector<ComplexReal> found = eigenvalues(real(A));
  Real least = 1;
  for (const ComplexReal& value : found) least = std::min<Real>(least, abs(value.re));
  // λ ≈ a₃₃ − a₂₃a₃₂/(a₂₂ − a₁₂a₂₁/a₁₁ − a₃₃), and the next order is 1e-45 beside it.
  const Real expected = Real(1e-15) - Real(1e-15) * Real(1e-15) / (1 - 1 / Real(1e15) - Real(1e-15));
  expect_small(abs(least - expected) / expected, 1e-29, "the difference");
}

void test_eigenvalues_of_a_jordan_block_have_a_part_of_the_digits() {
  const Digits scope(50);
  RealMatrix A = 0.5 * identity(4);
  for (Index i = 0; i < 3; ++i) A(i, i + 1) = 1;
  A(3, 0) = 1e-48;
  for (const ComplexReal& value : eigenvalues(A))
    expect_small(abs(hypot(value.re - 0.5, value.im) - 1e-12), 1e-20, "the distance from 0.5, less 1e-12");
}

// Three Jordan chains at 0, in other coordinates: of each eigenvalue a third, a fourth … of the digits is there, and a
// sweep brings no more than a bit of it.
void test_eigenvalues_of_several_jordan_chains_are_found() {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (Index length = 2; length <= 5; ++length) {
      const Digits scope(100);
      const Index chains = 3, n = chains * length + 1;
      RealMatrix J = zeros(n, n);
      for (Index i = 0; i + 1 < n; ++i)
        if ((i + 1) % length != 0) J(i, i + 1) = 1;
      J(n - 1, n - 1) = 0.5;
      const RealMatrix S = real(Random(seed).matrix(n, n));
      int zeros_found = 0;
      for (const ComplexReal& value : eigenvalues(*solve(S, multiply(J, S)))) {
        TEST_ASSERT_TRUE(isfinite(value.re) && isfinite(value.im));
        zeros_found += hypot(value.re, value.im) < 1e-10;
      }
      TEST_ASSERT_EQUAL(chains * length, zeros_found);
    }
}

void test_upper_factors_of_a_singular_matrix_have_zero_pivots() {
  const Digits scope(50);
  const RealMatrix P = real(Random(5).semidefinite(5, 2)) / Real(3);
  const Factors factors = upper_factors(P);
  const RealMatrix d = factors.d.asDiagonal();
  expect_small(distance(congruence(factors.U, d), P), rounding, "U d Uᵀ − P");
  int zeros_found = 0;
  for (Index i = 0; i < 5; ++i) {
    TEST_ASSERT_TRUE(factors.d(i) >= 0 && factors.U(i, i) == 1);
    zeros_found += factors.d(i).is_zero();
    for (Index j = 0; j < i; ++j) TEST_ASSERT_TRUE(factors.U(i, j).is_zero());
  }
  TEST_ASSERT_EQUAL(3, zeros_found);
}

void test_upper_factors_keep_a_pivot_that_is_small_and_no_rounding() {
  const Digits scope(50);
  RealMatrix P = RealMatrix::Constant(2, 2, Real(1));
  P(0, 0) += power_of_ten(-30);
  const Factors factors = upper_factors(P);
  expect_small(abs(factors.d(0) / power_of_ten(-30) - 1), 1e-18, "the pivot's error");
}

void test_definiteness_is_judged_whatever_the_units() {
  const Digits scope(50);
  const MatrixXd good = (MatrixXd(2, 2) << 1e-20, 0.99e-10, 0.99e-10, 1).finished();
  const MatrixXd bad = (MatrixXd(2, 2) << 1e-20, 1.01e-10, 1.01e-10, 1).finished();
  TEST_ASSERT_TRUE(least_scaled_eigenvalue(real(good)) > 0.009);
  TEST_ASSERT_TRUE(least_scaled_eigenvalue(real(bad)) < -0.009);
}

void test_mode_behind_a_tiny_coupling_is_reached() {
  const Digits scope(50);
  const MatrixXd A = (MatrixXd(2, 2) << 2, 1e-12, 0, 3).finished();
  TEST_ASSERT_EQUAL(0, unreached_modes(real(A), real(Eigen::Vector2d(0, 1e-9))).dimension);
}

void test_unreached_pair_is_found_with_its_states() {
  const Digits scope(50);
  // States 1 and 3 turn by themselves; 0 and 2 are driven.
  const MatrixXd A = (MatrixXd(4, 4) << 1, 5, 1, 0,  //
                      0, 0.6, 0, 0.8,                //
                      0, 1, 2, 2,                    //
                      0, -0.8, 0, 0.6)
                         .finished();
  const std::vector<Mode> modes = unreached_modes(real(A), real(Eigen::Vector4d(0, 0, 1, 0))).modes;
  TEST_ASSERT_EQUAL(1, modes.size());
  TEST_ASSERT_TRUE(abs(modes[0].value.re - Real(0.6)) < rounding && abs(modes[0].value.im - Real(0.8)) < rounding);
  TEST_ASSERT_EQUAL(2, modes[0].states.size());
  TEST_ASSERT_EQUAL(1, modes[0].states[0]);
  TEST_ASSERT_EQUAL(3, modes[0].states[1]);
}

// The rank of [B, AB, …] with the same entries in many digits, by elimination with the largest pivot.
Index rank_in_many_digits(const MatrixXd& A, const MatrixXd& B) {
  const Digits scope(400);
  RealMatrix krylov = real(B), power = real(B);
  for (Index k = 1; k < A.rows(); ++k) krylov = beside(krylov, power = multiply(real(A), power));
  Index rank = 0;
  for (Index j = 0; j < krylov.cols() && rank < krylov.rows(); ++j) {
    Index pivot = rank;
    for (Index i = rank; i < krylov.rows(); ++i)
      if (abs(krylov(i, j)) > abs(krylov(pivot, j))) pivot = i;
    if (abs(krylov(pivot, j)) < power_of_ten(-300)) continue;
    krylov.row(rank).swap(krylov.row(pivot));
    for (Index i = rank + 1; i < krylov.rows(); ++i)
      krylov.row(i) -= (krylov(i, j) / krylov(rank, j)) * krylov.row(rank).eval();
    ++rank;
  }
  return rank;
}

void test_reached_dimension_is_exact() {
  TEST_ASSERT_EQUAL(2, reached_dimension(Eigen::Vector2d(1.5, 0.5).asDiagonal(), Eigen::Vector2d(1e-300, 1)));
  TEST_ASSERT_EQUAL(1, reached_dimension(Eigen::Vector2d(1.5, 1.5).asDiagonal(), Eigen::Vector2d(0.1, 0.3)));
  TEST_ASSERT_EQUAL(0, reached_dimension(MatrixXd::Identity(3, 3), MatrixXd::Zero(3, 2)));
  // 0.1 + 0.2 and 0.3 differ in the last bit.
  TEST_ASSERT_EQUAL(2, reached_dimension(Eigen::Vector2d(0.1 + 0.2, 0.3).asDiagonal(), Eigen::Vector2d(1, 1)));
}

void test_reached_dimension_of_random_pairs() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Index n = 2 + static_cast<Index>(seed % 5);
    MatrixXd A = random.matrix(n, n), B = random.matrix(n, 1 + static_cast<Index>(seed % 2));
    if (seed % 3 != 0) A.bottomLeftCorner(1, n - 1).setZero();  // the last state feeds, and is fed by, nothing …
    if (seed % 3 == 1) B.row(n - 1).setZero();                  // … and no input
    TEST_ASSERT_EQUAL(rank_in_many_digits(A, B), reached_dimension(A, B));
  }
}

void test_a_pole_of_either_half_plane_is_told_with_one_sign() {
  for (const double imaginary : {2.0, -2.0}) {
    TEST_ASSERT_EQUAL_STRING("0.5 ± 2j", short_complex({Real(0.5), Real(imaginary)}, Real(1)).c_str());
    TEST_ASSERT_EQUAL_STRING("±2j", short_complex({Real(0), Real(imaginary)}, Real(1)).c_str());
  }
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_products_of_a_transpose_agree_with_transposed_products);
  RUN_TEST(test_solve_exchanges_rows_when_the_first_pivot_is_zero);
  RUN_TEST(test_solve_refuses_a_singular_matrix);
  RUN_TEST(test_solve_of_a_hilbert_matrix_loses_no_more_than_its_condition);
  RUN_TEST(test_eigenvalues_of_random_matrices_have_their_characteristic_polynomial);
  RUN_TEST(test_eigenvalues_of_a_cyclic_permutation);
  RUN_TEST(test_eigenvalues_of_a_graded_matrix_keep_the_small_ones);
  RUN_TEST(test_eigenvalues_of_a_jordan_block_have_a_part_of_the_digits);
  RUN_TEST(test_eigenvalues_of_several_jordan_chains_are_found);
  RUN_TEST(test_upper_factors_of_a_singular_matrix_have_zero_pivots);
  RUN_TEST(test_upper_factors_keep_a_pivot_that_is_small_and_no_rounding);
  RUN_TEST(test_definiteness_is_judged_whatever_the_units);
  RUN_TEST(test_mode_behind_a_tiny_coupling_is_reached);
  RUN_TEST(test_unreached_pair_is_found_with_its_states);
  RUN_TEST(test_reached_dimension_is_exact);
  RUN_TEST(test_reached_dimension_of_random_pairs);
  RUN_TEST(test_a_pole_of_either_half_plane_is_told_with_one_sign);
  return UNITY_END();
}
