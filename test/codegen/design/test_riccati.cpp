// SPDX-License-Identifier: MIT
// Riccati equations: what is returned solves the equation and stabilises, on the kinds of problems that catch
// solvers.
#include <unity.h>

#include "design/equations/riccati.hpp"
#include "design/numeric/factor.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

// Of 50 digits: what the condition of the problems here leaves for sure.
const double rounding = 1e-30;

RealMatrix scalar(const Real& value) { return RealMatrix::Constant(1, 1, value); }

RiccatiEquation equation_of(const MatrixXd& A, const MatrixXd& B, const MatrixXd& Q, const MatrixXd& R) {
  return {real(A), real(B), real(Q), real(R), zeros(A.rows(), B.cols())};
}

// Cross term included: [Q N; Nᵀ R] is semidefinite, R definite.
RiccatiEquation random_equation(std::uint64_t seed, double size_of_A) {
  Random random(seed);
  const Index nx = 1 + static_cast<Index>(seed % 7), nu = 1 + static_cast<Index>(seed % 3);
  const MatrixXd weight = random.semidefinite(nx + nu, nx + nu - static_cast<Index>(seed % 2));
  RiccatiEquation e = {real(size_of_A * random.matrix(nx, nx)), real(random.matrix(nx, nu)),
                       real(weight.topLeftCorner(nx, nx)), real(weight.bottomRightCorner(nu, nu)),
                       real(weight.topRightCorner(nx, nu))};
  e.R += Real(0.125) * identity(nu);
  return e;
}

Real spectral_radius(const RealMatrix& A) {
  Real largest;
  for (const ComplexReal& value : eigenvalues(A)) largest = std::max<Real>(largest, hypot(value.re, value.im));
  return largest;
}

// X = AᵀXA + Q − (AᵀXB + N)K with (R + BᵀXB)K = BᵀXA + Nᵀ, in the text of the definition.
void expect_solution(const RiccatiEquation& e, const RiccatiResult& found) {
  TEST_ASSERT_TRUE_MESSAGE(found.failure == RiccatiFailure::none, "no solution");
  const RealMatrix& X = found.X;
  const RealMatrix AXB = multiply(e.A.transpose(), multiply(X, e.B)) + e.N;
  const RealMatrix right = multiply(e.A.transpose(), multiply(X, e.A)) + e.Q - multiply(AXB, found.K);
  expect_small(distance(right, X), rounding, "the residual");
  const RealMatrix weight = e.R + multiply(e.B.transpose(), multiply(X, e.B));
  expect_small(distance(multiply(weight, found.K), AXB.transpose()), rounding, "the gain's residual");
  TEST_ASSERT_TRUE_MESSAGE(is_zero(X - X.transpose()), "X is not symmetric");
  TEST_ASSERT_TRUE_MESSAGE(least_scaled_eigenvalue(X) > -rounding, "X is not semidefinite");
  TEST_ASSERT_TRUE_MESSAGE(spectral_radius(e.A - multiply(e.B, found.K)) < 1, "the closed loop is not stable");
  TEST_ASSERT_TRUE(found.condition >= 1);
}

void check(const RiccatiEquation& e) { expect_solution(e, solve_discrete_riccati(e, RealMatrix())); }

void test_random_problems_stable_and_unstable() {
  const Digits scope(50);
  for (std::uint64_t seed = 1; seed <= 100; ++seed) check(random_equation(seed, seed % 2 ? 0.5 : 2));
}

// Delays: x₁⁺ = x₀, x₂⁺ = x₁.
void test_singular_A() {
  const Digits scope(50);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RiccatiEquation e = random_equation(seed, 1.5);
    e.A.row(0).setConstant(Real(0));
    check(e);
  }
  const MatrixXd A = (MatrixXd(3, 3) << 1.2, 0, 1, 1, 0, 0, 0, 1, 0).finished();
  check(equation_of(A, Eigen::Vector3d(1, 0, 0), MatrixXd::Identity(3, 3), MatrixXd::Identity(1, 1)));
}

// Doubling alone gives X = 0 and a closed-loop pole at 2. The stabilising X is r(a² − 1)/b², its pole 1/a.
void test_unstable_mode_without_weight() {
  const Digits scope(50);
  const RiccatiEquation e = {scalar(2), scalar(1), scalar(0), scalar(1), scalar(0)};
  const RiccatiResult found = solve_discrete_riccati(e, RealMatrix());
  expect_solution(e, found);
  expect_small(abs(found.X(0, 0) - 3), rounding, "X − 3");
  expect_small(abs(found.closed(0, 0) - 0.5), rounding, "the pole − 1/2");
}

void test_unstable_modes_without_weight_beside_weighted_ones() {
  const Digits scope(50);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RiccatiEquation e = random_equation(7 * seed + 4, 2);  // nx = 5
    e.N = zeros(e.A.rows(), e.B.cols());
    e.Q = zeros(e.A.rows(), e.A.rows());
    e.Q(0, 0) = 1;
    e.A.col(1).setConstant(Real(0));  // feeds nothing but itself: not seen by Q
    e.A(1, 1) = 1.5;
    check(e);
  }
}

void test_extreme_ratios_of_Q_to_R() {
  const Digits scope(50);
  for (const double ratio : {1e-24, 1e-12, 1e12, 1e24})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      RiccatiEquation e = random_equation(seed, 1.5);
      e.N *= 0;
      e.Q *= Real(ratio);
      check(e);
    }
}

void test_badly_scaled_states() {
  const Digits scope(50);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RiccatiEquation e = random_equation(seed, 1.5);
    RealMatrix scale = identity(e.A.rows());
    for (Index i = 0; i < e.A.rows(); ++i) scale(i, i) = power_of_ten(static_cast<double>(i % 3 - 1) * 8);
    const RealMatrix inverse = *solve(scale, identity(e.A.rows()));
    e.A = multiply(inverse, multiply(e.A, scale));
    e.B = multiply(inverse, e.B);
    e.Q = congruence(scale, e.Q);
    e.N = multiply(scale, e.N);
    const RiccatiResult found = solve_discrete_riccati(e, RealMatrix());
    TEST_ASSERT_TRUE(found.failure == RiccatiFailure::none);
    TEST_ASSERT_TRUE(spectral_radius(found.closed) < 1);
    // The same problem in other units has the same solution in those units.
    const RiccatiResult plain = solve_discrete_riccati(random_equation(seed, 1.5), RealMatrix());
    expect_small(distance(multiply(found.K, inverse), plain.K), 1e-20, "the gain's change with the units");
  }
}

// An integrator with a weight of 1e-20: X = (q + √(q² + 4qr))/2, the pole is 1e-10 inside the circle.
void test_closed_loop_pole_next_to_the_circle() {
  const Digits scope(50);
  const Real q = 1e-20;
  const RiccatiEquation e = {scalar(1), scalar(1), scalar(q), scalar(1), scalar(0)};
  const RiccatiResult found = solve_discrete_riccati(e, RealMatrix());
  expect_solution(e, found);
  const Real exact = (q + sqrt(q * q + 4 * q)) / 2;
  expect_small(abs(found.X(0, 0) / exact - 1), rounding, "the error of X");
  TEST_ASSERT_TRUE(found.closed(0, 0) > 1 - 2e-10);
  TEST_ASSERT_TRUE(found.condition > 1e9);
}

void test_R_of_zero_where_the_next_state_has_weight() {
  const Digits scope(50);
  const MatrixXd A = (MatrixXd(2, 2) << 1, 1, 0, 1).finished();
  const RiccatiEquation e = equation_of(A, Eigen::Vector2d(0, 1), MatrixXd::Identity(2, 2), MatrixXd::Zero(1, 1));
  check(e);
}

// P. Benner, A. J. Laub, V. Mehrmann, "A collection of benchmark examples for the numerical solution of
// algebraic Riccati equations II: discrete-time case" (1995), example 1.1.
void test_first_example_of_the_discrete_collection() {
  const Digits scope(50);
  const MatrixXd A = (MatrixXd(2, 2) << 4, 3, -4.5, -3.5).finished();
  const MatrixXd Q = (MatrixXd(2, 2) << 9, 6, 6, 4).finished();
  const RiccatiResult found =
      solve_discrete_riccati(equation_of(A, Eigen::Vector2d(1, -1), Q, MatrixXd::Identity(1, 1)), RealMatrix());
  expect_small(distance(found.X, real(Q) * ((1 + sqrt(Real(5))) / 2)), rounding, "the error of X");
}

void check_continuous(const RiccatiEquation& e, const RealMatrix& exact_X) {
  const RiccatiResult found = solve_continuous_riccati(e, RealMatrix());
  TEST_ASSERT_TRUE(found.failure == RiccatiFailure::none);
  expect_small(distance(found.X, exact_X), rounding, "the error of X");
}

// The same authors, "… I: continuous-time case" (1995), examples 1.1 and 1.2.
void test_first_examples_of_the_continuous_collection() {
  const Digits scope(50);
  const MatrixXd integrators = (MatrixXd(2, 2) << 0, 1, 0, 0).finished();
  check_continuous(
      equation_of(integrators, Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 2).asDiagonal(), MatrixXd::Identity(1, 1)),
      real((MatrixXd(2, 2) << 2, 1, 1, 2).finished()));
  const MatrixXd A = (MatrixXd(2, 2) << 4, 3, -4.5, -3.5).finished();
  const MatrixXd Q = (MatrixXd(2, 2) << 9, 6, 6, 4).finished();
  check_continuous(equation_of(A, Eigen::Vector2d(1, -1), Q, MatrixXd::Identity(1, 1)), real(Q) * (1 + sqrt(Real(2))));
}

void test_continuous_unstable_mode_without_weight() {
  const Digits scope(50);
  const RiccatiEquation e = {scalar(1), scalar(1), scalar(0), scalar(1), scalar(0)};
  const RiccatiResult found = solve_continuous_riccati(e, RealMatrix());
  expect_small(abs(found.X(0, 0) - 2), rounding, "X − 2");
  expect_small(abs(found.closed(0, 0) + 1), rounding, "the pole + 1");
}

void test_continuous_random_problems() {
  const Digits scope(50);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const RiccatiEquation e = random_equation(seed, seed % 2 ? 1 : 100);
    const RiccatiResult found = solve_continuous_riccati(e, RealMatrix());
    TEST_ASSERT_TRUE(found.failure == RiccatiFailure::none);
    const RealMatrix XA = multiply(found.X, e.A), KRK = transpose_congruence(found.K, e.R);
    expect_small(distance(XA + XA.transpose() + e.Q, KRK), rounding, "the residual");
    for (const ComplexReal& pole : eigenvalues(found.closed)) TEST_ASSERT_TRUE(pole.re < 0);
  }
}

void test_start_with_fewer_digits_is_taken_to_all_digits() {
  RiccatiResult coarse;
  {
    const Digits scope(50);
    coarse = solve_discrete_riccati(random_equation(12, 2), RealMatrix());
  }
  const Digits scope(100);
  const RiccatiEquation e = random_equation(12, 2);
  const RiccatiResult fine = solve_discrete_riccati(e, coarse.X), cold = solve_discrete_riccati(e, RealMatrix());
  expect_small(distance(fine.X, cold.X), 1e-85, "the difference of X");
}

void test_start_that_does_not_stabilise_is_left_alone() {
  const Digits scope(50);
  const RiccatiEquation e = {scalar(2), scalar(1), scalar(0), scalar(1), scalar(0)};
  expect_solution(e, solve_discrete_riccati(e, scalar(0)));
}

// The doubles 0.6 and 0.8 are no cosine and sine: this one turns outwards by 2e-17 a step.
void test_undamped_mode_is_told_from_one_unstable_in_the_last_bit() {
  const Digits scope(50);
  const MatrixXd A = (MatrixXd(2, 2) << 0.6, 0.8, -0.8, 0.6).finished();
  check(equation_of(A, Eigen::Vector2d(0, 1), MatrixXd::Zero(2, 2), MatrixXd::Identity(1, 1)));
}

void test_undamped_mode_without_weight_has_no_solution() {
  const Digits scope(50);
  const MatrixXd A = (MatrixXd(2, 2) << 0, 1, -1, 0).finished();
  const RiccatiEquation e = equation_of(A, Eigen::Vector2d(0, 1), MatrixXd::Zero(2, 2), MatrixXd::Identity(1, 1));
  TEST_ASSERT_FALSE(solve_discrete_riccati(e, RealMatrix()).failure == RiccatiFailure::none);
}

void test_mode_that_no_input_reaches_has_no_solution() {
  const Digits scope(50);
  const RiccatiEquation e = equation_of(Eigen::Vector2d(1.5, 0.5).asDiagonal(), Eigen::Vector2d(0, 1),
                                        MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1));
  TEST_ASSERT_TRUE(solve_discrete_riccati(e, RealMatrix()).failure == RiccatiFailure::no_start);
}

void test_input_without_weight_and_effect_is_named() {
  const Digits scope(50);
  RiccatiEquation e = equation_of(MatrixXd::Constant(1, 1, 0.5), Eigen::RowVector2d(1, 0), MatrixXd::Identity(1, 1),
                                  MatrixXd::Identity(2, 2));
  e.R(1, 1) = 0;
  const RiccatiFailure failure = solve_discrete_riccati(e, RealMatrix()).failure;
  TEST_ASSERT_TRUE(failure == RiccatiFailure::not_definite);
}

void test_stein_equation_of_an_unstable_matrix_has_no_sum() {
  const Digits scope(50);
  TEST_ASSERT_FALSE(solve_stein(scalar(1), scalar(1)).has_value());
  TEST_ASSERT_FALSE(solve_stein(scalar(-1.01), scalar(1)).has_value());
  const std::optional<RealMatrix> X = solve_stein(scalar(Real(0.5)), scalar(3));
  TEST_ASSERT_TRUE(X.has_value());
  expect_small(abs((*X)(0, 0) - 4), 1e-48, "the sum − 4");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_random_problems_stable_and_unstable);
  RUN_TEST(test_singular_A);
  RUN_TEST(test_unstable_mode_without_weight);
  RUN_TEST(test_unstable_modes_without_weight_beside_weighted_ones);
  RUN_TEST(test_extreme_ratios_of_Q_to_R);
  RUN_TEST(test_badly_scaled_states);
  RUN_TEST(test_closed_loop_pole_next_to_the_circle);
  RUN_TEST(test_R_of_zero_where_the_next_state_has_weight);
  RUN_TEST(test_first_example_of_the_discrete_collection);
  RUN_TEST(test_first_examples_of_the_continuous_collection);
  RUN_TEST(test_continuous_unstable_mode_without_weight);
  RUN_TEST(test_continuous_random_problems);
  RUN_TEST(test_start_with_fewer_digits_is_taken_to_all_digits);
  RUN_TEST(test_start_that_does_not_stabilise_is_left_alone);
  RUN_TEST(test_undamped_mode_is_told_from_one_unstable_in_the_last_bit);
  RUN_TEST(test_undamped_mode_without_weight_has_no_solution);
  RUN_TEST(test_mode_that_no_input_reaches_has_no_solution);
  RUN_TEST(test_input_without_weight_and_effect_is_named);
  RUN_TEST(test_stein_equation_of_an_unstable_matrix_has_no_sum);
  return UNITY_END();
}
