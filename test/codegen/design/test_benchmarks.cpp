// SPDX-License-Identifier: MIT
// The benchmark collections of Riccati equations, with the solutions that their makers know in closed form:
// P. Benner, A. J. Laub, V. Mehrmann, "A collection of benchmark examples for the numerical solution of algebraic
// Riccati equations", I: continuous-time case (CAREX), II: discrete-time case (DAREX), reports SPC 95_22 and 95_23, TU
// Chemnitz-Zwickau, 1995. Built from their formulas, with parameters at their far ends; numbered as in SLICOT's
// generators BB01AD and BB02AD, whose data and solutions were compared with these.
#include <cmath>
#include <initializer_list>

#include <unity.h>

#include "design/equations/riccati.hpp"
#include "problems.hpp"

namespace {

using namespace design_test;
using namespace lqg::design;

constexpr unsigned digits = 100;
constexpr double accuracy = 1e-50;  // half of the digits for the worst conditioned of them

RealMatrix matrix(Index rows, std::initializer_list<Real> row_by_row) {
  const Index columns = static_cast<Index>(row_by_row.size()) / rows;
  RealMatrix result(rows, columns);
  Index at = 0;
  for (const Real& value : row_by_row) {
    result(at / columns, at % columns) = value;
    ++at;
  }
  return result;
}

RealMatrix diagonal(std::initializer_list<Real> values) {
  RealMatrix result = zeros(static_cast<Index>(values.size()), static_cast<Index>(values.size()));
  Index at = 0;
  for (const Real& value : values) {
    result(at, at) = value;
    ++at;
  }
  return result;
}

RiccatiEquation equation(const RealMatrix& A, const RealMatrix& B, const RealMatrix& Q, const RealMatrix& R) {
  return {A, B, Q, R, zeros(A.rows(), B.cols())};
}

// V diag V with the reflection V = I − 2/3 v vᵀ, v = [1 1 1]ᵀ.
RealMatrix reflected(std::initializer_list<Real> values) {
  const RealMatrix V = identity(3) - RealMatrix::Constant(3, 3, Real(2) / 3);
  return multiply(multiply(V, diagonal(values)), V);
}

Real largest_of(const std::vector<ComplexReal>& poles, Real (*part)(const ComplexReal&)) {
  Real largest = part(poles.front());
  for (const ComplexReal& pole : poles) largest = std::max<Real>(largest, part(pole));
  return largest;
}

void expect_stable(const RiccatiResult& found, bool discrete) {
  const std::vector<ComplexReal> poles = eigenvalues(found.closed);
  const Real size = largest_of(poles, [](const ComplexReal& z) { return Real(hypot(z.re, z.im)); });
  const Real right = largest_of(poles, [](const ComplexReal& s) { return s.re; });
  TEST_ASSERT_TRUE_MESSAGE(discrete ? size < 1 : right < 0, "the closed loop is not stable");
}

void expect_discrete(const RiccatiEquation& e, const RealMatrix& X) {
  const RiccatiResult found = solve_discrete_riccati(e, RealMatrix());
  TEST_ASSERT_TRUE(found.failure == RiccatiFailure::none);
  expect_small(distance(found.X, X), accuracy, "X");
  expect_stable(found, true);
}

void expect_continuous(const RiccatiEquation& e, const RealMatrix& X) {
  const RiccatiResult found = solve_continuous_riccati(e, RealMatrix());
  TEST_ASSERT_TRUE(found.failure == RiccatiFailure::none);
  expect_small(distance(found.X, X), accuracy, "X");
  expect_stable(found, false);
}

// ---- DAREX

void test_darex_1_1_dead_beat_with_R_zero() {
  const Digits scope(digits);
  expect_discrete(equation(matrix(2, {2, -1, 1, 0}), matrix(2, {1, 0}), diagonal({0, 1}), zeros(1, 1)), identity(2));
}

// [Q N; Nᵀ R] is indefinite, and there is no minimum.
void test_darex_1_2_has_no_minimum() {
  const Digits scope(digits);
  RiccatiEquation e =
      equation(matrix(2, {0, 1, 0, -1}), matrix(2, {1, 0, 2, 1}), matrix(2, {-4, -4, -4, 7}), matrix(2, {9, 3, 3, 1}));
  e.Q /= Real(11);
  e.N = matrix(2, {3, 1, -1, 7});
  TEST_ASSERT_TRUE(solve_discrete_riccati(e, RealMatrix()).failure != RiccatiFailure::none);
}

void test_darex_1_3_Q_singular() {
  const Digits scope(digits);
  expect_discrete(equation(matrix(2, {0, 1, 0, 0}), matrix(2, {0, 1}), matrix(2, {1, 2, 2, 4}), identity(1)),
                  matrix(2, {1, 2, 2, 2 + sqrt(Real(5))}));
}

// In BB02AD's data A(1, 2) is 0.01, which its solution does not satisfy; 0.1 is what belongs to it.
void test_darex_1_4_R_singular_and_Q_indefinite() {
  const Digits scope(digits);
  const RealMatrix A = matrix(3, {0, Real(1) / 10, 0, 0, 0, Real(1) / 10, 0, 0, 0});
  expect_discrete(equation(A, matrix(3, {1, 0, 0, 0, 0, 1}), diagonal({1e5, 1e3, -10}), diagonal({0, 1})),
                  diagonal({1e5, 1e3, 0}));
}

void test_darex_2_1_uncontrollable_and_unobservable() {
  const Digits scope(digits);
  for (const double r : {1e-12, 1.0, 1e6, 1e12}) {
    const RealMatrix Q = matrix(2, {9, 6, 6, 4});
    expect_discrete(equation(matrix(2, {4, 3, -4.5, -3.5}), matrix(2, {1, -1}), Q, matrix(1, {r})),
                    (1 + sqrt(1 + 4 * Real(r))) / 2 * Q);
  }
}

void test_darex_2_3_badly_scaled() {
  const Digits scope(digits);
  for (const double epsilon : {1e-6, 1.0, 1e6, 1e12})
    expect_discrete(equation(matrix(2, {0, epsilon, 0, 0}), matrix(2, {0, 1}), identity(2), identity(1)),
                    diagonal({1, 1 + Real(epsilon) * Real(epsilon)}));
}

void test_darex_2_4_weights_far_from_one() {
  const Digits scope(digits);
  const auto x = [](int a) { return Real((a * a + sqrt(Real(a * a * a * a + 4))) / 2); };
  for (const double epsilon : {1e-12, 1e6, 1e12})
    expect_discrete(equation(reflected({0, 1, 3}), identity(3), epsilon * identity(3), epsilon * identity(3)),
                    epsilon * reflected({x(0), x(1), x(3)}));
}

// A mode as near to the circle as 1/tau, and a delay of three samples.
void test_darex_2_5_paper_machine() {
  const Digits scope(digits);
  for (const double tau : {10.0, 1e8, 1e15}) {
    const Real a = 1 - 1 / Real(tau), b = 1 / Real(tau), r = 0.25;
    RealMatrix A = zeros(4, 4), B = zeros(4, 1), Q = zeros(4, 4);
    A(0, 0) = a;
    A(1, 0) = A(2, 1) = A(3, 2) = 1;
    B(0, 0) = b;
    Q(3, 3) = 1;
    const Real half = (b * b + a * a * r - r) / 2;  // b²x² − 2 half x − r = 0
    const Real x = (half + sqrt(half * half + b * b * r)) / (b * b);
    expect_discrete(equation(A, B, Q, matrix(1, {r})), diagonal({x, 1, 1, 1}));
  }
}

void test_darex_4_1_chain_of_a_hundred_states() {
  const Digits scope(digits);
  const Index n = 100;
  RealMatrix A = zeros(n, n), B = zeros(n, 1), X = zeros(n, n);
  for (Index i = 0; i + 1 < n; ++i) A(i, i + 1) = 1;
  for (Index i = 0; i < n; ++i) X(i, i) = static_cast<double>(i + 1);
  B(n - 1, 0) = 1;
  const RiccatiResult found = solve_discrete_riccati(equation(A, B, identity(n), identity(1)), RealMatrix());
  TEST_ASSERT_TRUE(found.failure == RiccatiFailure::none);
  expect_small(distance(found.X, X), accuracy, "X");
}

// ---- CAREX

void test_carex_1_1_double_integrator() {
  const Digits scope(digits);
  expect_continuous(equation(matrix(2, {0, 1, 0, 0}), matrix(2, {0, 1}), diagonal({1, 2}), identity(1)),
                    matrix(2, {2, 1, 1, 2}));
}

void test_carex_1_2_uncontrollable_and_unobservable() {
  const Digits scope(digits);
  const RealMatrix Q = matrix(2, {9, 6, 6, 4});
  expect_continuous(equation(matrix(2, {4, 3, -4.5, -3.5}), matrix(2, {1, -1}), Q, identity(1)),
                    (1 + sqrt(Real(2))) * Q);
}

void test_carex_2_1_hardly_stabilisable() {
  const Digits scope(digits);
  for (const double epsilon : {1.0, 1e-6, 1e-12}) {
    const Real square = Real(epsilon) * Real(epsilon), root = sqrt(1 + square);
    const Real x12 = 1 / (2 + root), x22 = (1 - square * x12 * x12) / 4;
    expect_continuous(equation(matrix(2, {1, 0, 0, -2}), matrix(2, {epsilon, 0}), matrix(2, {1, 1, 1, 1}), identity(1)),
                      matrix(2, {(1 + root) / square, x12, x12, x22}));
  }
}

void test_carex_2_3_ill_conditioned() {
  const Digits scope(digits);
  for (const double epsilon : {1.0, 1e6, 1e12}) {
    const Real root = sqrt(1 + 2 * Real(epsilon));
    expect_continuous(equation(matrix(2, {0, epsilon, 0, 0}), matrix(2, {0, 1}), identity(2), identity(1)),
                      matrix(2, {root / epsilon, 1, 1, root}));
  }
}

void test_carex_2_4_hamiltonian_near_the_axis() {
  const Digits scope(digits);
  for (const double epsilon : {1.0, 1e-7, 1e-12}) {
    const auto x = [&](const Real& a) { return Real(a + sqrt(a * a + Real(epsilon) * Real(epsilon))); };
    const Real sum = x(2 + Real(epsilon)), difference = x(epsilon), diagonal_entry = 1 + Real(epsilon);
    expect_continuous(
        equation(matrix(2, {diagonal_entry, 1, 1, diagonal_entry}), identity(2),
                 Real(epsilon) * Real(epsilon) * identity(2), identity(2)),
        matrix(2, {(sum + difference) / 2, (sum - difference) / 2, (sum - difference) / 2, (sum + difference) / 2}));
  }
}

RiccatiEquation carex_2_5(const Real& epsilon) {
  return equation(matrix(2, {3 - epsilon, 1, 4, 2 - epsilon}), matrix(2, {1, 1}),
                  matrix(2, {4 * epsilon - 11, 2 * epsilon - 5, 2 * epsilon - 5, 2 * epsilon - 2}), identity(1));
}

void test_carex_2_5_poles_next_to_the_axis() {
  const Digits scope(digits);
  for (const double epsilon : {1.0, 1e-4, 1e-12}) expect_continuous(carex_2_5(epsilon), matrix(2, {2, 1, 1, 1}));
}

void test_carex_2_6_badly_scaled() {
  const Digits scope(digits);
  for (const double epsilon : {1e-6, 1.0, 1e6}) {
    const Real e = epsilon;
    const auto x = [&](int a, const Real& q) { return Real(e * (a * e + sqrt(a * a * e * e + q / e))); };
    expect_continuous(equation(e * reflected({1, 2, 3}), identity(3), reflected({1 / e, 1, e}), e * identity(3)),
                      reflected({x(1, 1 / e), x(2, 1), x(3, e)}));
  }
}

// Circulant: X has the eigenvectors cos(2πki/n) of A, with x = a + √(a² + 1).
void test_carex_3_2_circulant() {
  const Digits scope(60);
  const Index n = 64;
  RealMatrix A = zeros(n, n);
  for (Index i = 0; i < n; ++i) {
    A(i, i) = -2;
    A(i, (i + 1) % n) = A((i + 1) % n, i) = 1;
  }
  const RiccatiResult found =
      solve_continuous_riccati(equation(A, identity(n), identity(n), identity(n)), RealMatrix());
  TEST_ASSERT_TRUE(found.failure == RiccatiFailure::none);
  const Real turn = 8 * atan(Real(1)) / static_cast<double>(n);
  for (Index k = 0; k <= n / 2; ++k) {
    const Real a = 2 * cos(turn * static_cast<double>(k)) - 2, x = a + sqrt(a * a + 1);
    RealMatrix v(n, 1);
    for (Index i = 0; i < n; ++i) v(i, 0) = cos(turn * static_cast<double>(k * i));
    expect_small(distance(multiply(found.X, v), x * v), 1e-40, "X v − x v");
  }
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_darex_1_1_dead_beat_with_R_zero);
  RUN_TEST(test_darex_1_2_has_no_minimum);
  RUN_TEST(test_darex_1_3_Q_singular);
  RUN_TEST(test_darex_1_4_R_singular_and_Q_indefinite);
  RUN_TEST(test_darex_2_1_uncontrollable_and_unobservable);
  RUN_TEST(test_darex_2_3_badly_scaled);
  RUN_TEST(test_darex_2_4_weights_far_from_one);
  RUN_TEST(test_darex_2_5_paper_machine);
  RUN_TEST(test_darex_4_1_chain_of_a_hundred_states);
  RUN_TEST(test_carex_1_1_double_integrator);
  RUN_TEST(test_carex_1_2_uncontrollable_and_unobservable);
  RUN_TEST(test_carex_2_1_hardly_stabilisable);
  RUN_TEST(test_carex_2_3_ill_conditioned);
  RUN_TEST(test_carex_2_4_hamiltonian_near_the_axis);
  RUN_TEST(test_carex_2_5_poles_next_to_the_axis);
  RUN_TEST(test_carex_2_6_badly_scaled);
  RUN_TEST(test_carex_3_2_circulant);
  return UNITY_END();
}
