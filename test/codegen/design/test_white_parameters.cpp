// SPDX-License-Identifier: MIT
// The regulator under white parameters, and where there is none.
#include <cmath>

#include <unity.h>

#include "design/order/moment_map.hpp"
#include "design/rounding.hpp"
#include "order_problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

RealMatrix number(double x) { return real(Eigen::MatrixXd::Constant(1, 1, x)); }

// Of the plant alone.
double growth_of_second_moments(const OrderProblem& problem) {
  std::vector<Eigen::MatrixXd> Phi = {to_doubles(problem.A)};
  for (const WhiteParameter& white : problem.white) Phi.push_back(to_doubles(white.A));
  return order::growth_of(Phi, problem.is_continuous);
}

// x⁺ = 2x + (1 + σγ)u
OrderProblem scalar_plant(double sigma) {
  OrderProblem problem = unit_problem(false, number(2), number(1), number(1));
  problem.white = {{number(0), number(sigma), number(0)}};
  return problem;
}

// The least of E[(2 − (1 + σγ)k)²] over k is 4σ²/(1 + σ²), 1 at σ = 1/√3: M. Athans, R. Ku, S. B. Gershwin, "The
// uncertainty threshold principle", IEEE Transactions on Automatic Control 22 (1977), 491–495.
void test_uncertainty_threshold_from_both_sides() {
  const Digits scope(60);
  for (const double sigma : {0.5773, 0.577, 0.3}) {
    const WhiteRegulator regulator = white_regulator(scalar_plant(sigma));
    TEST_ASSERT_TRUE(regulator.exists);
    // X = 1 + 4X − 4X²/(1 + X(1 + σ²))
    const Real X = regulator.X(0, 0), square = Real(sigma) * sigma;
    expect_small(abs(1 + 4 * X - 4 * X * X / (1 + X * (1 + square)) - X) / X, 1e-45, "the residual");
  }
  for (const double sigma : {0.5774, 0.578, 1.0}) {
    const WhiteRegulator regulator = white_regulator(scalar_plant(sigma));
    TEST_ASSERT_FALSE(regulator.exists);
    expect_small(abs(regulator.growth - Real(4 * sigma * sigma / (1 + sigma * sigma))), 1e-9, "the growth's error");
  }
  TEST_ASSERT_DOUBLE_WITHIN(5e-5, 1.0017, white_regulator(scalar_plant(0.578)).growth);
}

// X = Q + E[AᵀXA] − (E[AᵀXB] + N)(R + E[BᵀXB])⁻¹(…)ᵀ
void expect_equation(const OrderProblem& p, const WhiteRegulator& regulator) {
  RealMatrix on_x = transpose_congruence(p.A, regulator.X), on_u = p.R + transpose_congruence(p.B, regulator.X);
  RealMatrix on_both = p.N.transpose() + transpose_multiply(p.B, multiply(regulator.X, p.A));
  for (const WhiteParameter& white : p.white) {
    on_x += transpose_congruence(white.A, regulator.X);
    on_u += transpose_congruence(white.B, regulator.X);
    on_both += transpose_multiply(white.B, multiply(regulator.X, white.A));
  }
  const RealMatrix K = *solve(on_u, on_both);
  expect_small(distance(regulator.K, K), 1e-45, "the gain");
  expect_small(distance(p.Q + on_x - transpose_multiply(on_both, K), regulator.X), 1e-45, "the equation's residual");
}

void test_equation_holds_for_random_plants_in_all_digits() {
  const Digits scope(60);
  int unstable = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    OrderProblem problem = unstable_plant(seed);
    add_white_parameters(problem, seed + 100);
    problem.N = real(0.1 * Random(seed).matrix(problem.A.rows(), problem.B.cols()));
    const WhiteRegulator regulator = white_regulator(problem);
    unstable += growth_of_second_moments(problem) > 1 ? 1 : 0;
    if (regulator.exists)
      expect_equation(problem, regulator);
    else
      TEST_ASSERT_TRUE(regulator.growth >= 1);
  }
  TEST_ASSERT_TRUE(unstable >= 8);
}

void test_without_white_parameters_it_is_the_riccati_equation() {
  const Digits scope(60);
  const OrderProblem p = unstable_plant(5);
  const RiccatiResult expected = solve_discrete_riccati({p.A, p.B, p.Q, p.R, p.N}, RealMatrix());
  expect_small(distance(white_regulator(p).X, expected.X), 1e-45, "X");
}

// A mode of 1.2 that no input moves grows by 1.44 whatever K does.
void test_mode_without_input_grows_by_its_square() {
  const Digits scope(50);
  const RealMatrix A = real((Eigen::MatrixXd(2, 2) << 0.9, 1, 0, 1.2).finished());
  const OrderProblem problem = unit_problem(false, A, real((Eigen::MatrixXd(2, 1) << 1, 0).finished()), identity(2));
  const WhiteRegulator regulator = white_regulator(problem);
  TEST_ASSERT_FALSE(regulator.exists);
  TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.44, regulator.growth);
  TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.44, growth_of_second_moments(problem));
}

// E (a + σγ)² = a² + σ²; continuous with A + σγ: 2a + σ².
void test_growth_of_scalar_plants() {
  OrderProblem problem = unit_problem(false, number(0.5), number(1), number(1));
  problem.white = {{number(0.25), number(0), number(0)}};
  TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3125, growth_of_second_moments(problem));
  problem.is_continuous = true;
  TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0625, growth_of_second_moments(problem));
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_uncertainty_threshold_from_both_sides);
  RUN_TEST(test_equation_holds_for_random_plants_in_all_digits);
  RUN_TEST(test_without_white_parameters_it_is_the_riccati_equation);
  RUN_TEST(test_mode_without_input_grows_by_its_square);
  RUN_TEST(test_growth_of_scalar_plants);
  return UNITY_END();
}
