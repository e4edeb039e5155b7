// SPDX-License-Identifier: MIT
// The regulator of whole problems: gains with a closed form, all three kinds of cost, cross terms.
#include <unity.h>

#include "design/equations/riccati.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

Problem scalar_problem(Domain domain, double a) {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(domain, 0.25, a * one, one, one);
  problem.estimator.reset();
  return problem;
}

// X = φ, K = 1/φ: the golden ratio.
void test_discrete_integrator_with_unit_weights() {
  const Solution found = solved(scalar_problem(Domain::discrete, 1));
  const Digits scope(60);
  const Real ratio = (1 + sqrt(Real(5))) / 2;
  TEST_ASSERT_TRUE(to_double(found.regulator->X(0, 0)) == to_double(ratio));
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 0)) == to_double(1 / ratio));
  TEST_ASSERT_TRUE(found.regulator->poles[0].real() == to_double(1 - 1 / ratio));
}

void test_continuous_gain_of_the_double_integrator_is_one_and_root_three() {
  Problem problem = double_integrator(0.01);
  problem.regulator->cost = Cost::continuous;
  problem.estimator.reset();
  const Solution found = solved(problem);
  const Digits scope(60);
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 0)) == 1);
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 1)) == to_double(sqrt(Real(3))));
  TEST_ASSERT_TRUE(is_zero(found.regulator->cost.Q - identity(2)));
}

// Minimising over one held period after another is minimising over the trajectory: X is the trajectory's
// cost. A short period comes close to the continuous X, from above, with an error of the order T².
void test_sampled_cost_tends_to_the_continuous_one_from_above() {
  Problem continuous = double_integrator(1e-3);
  continuous.regulator->cost = Cost::continuous;
  const Real limit = solved(continuous).regulator->X(0, 0);
  const Real coarse = solved(double_integrator(2e-3)).regulator->X(0, 0) - limit;
  const Real fine = solved(double_integrator(1e-3)).regulator->X(0, 0) - limit;
  TEST_ASSERT_TRUE(fine > 0);
  expect_small(abs(coarse / fine - 4), 0.02, "the ratio of the errors, less 4,");
}

// u = v − R⁻¹Nᵀx takes the cross term away: the same plant with A − BR⁻¹Nᵀ, Q − NR⁻¹Nᵀ, and K less R⁻¹Nᵀ.
void test_cross_term_is_a_change_of_the_input() {
  Problem with = scalar_problem(Domain::discrete, 1.5);
  with.regulator->Q(0, 0) = 2;
  with.regulator->R(0, 0) = 4;
  with.regulator->N(0, 0) = 1;
  Problem without = scalar_problem(Domain::discrete, 1.25);
  without.regulator->Q(0, 0) = 1.75;
  without.regulator->R(0, 0) = 4;
  const RegulatorSolution a = *solved(with).regulator, b = *solved(without).regulator;
  TEST_ASSERT_TRUE(to_double(a.X(0, 0)) == to_double(b.X(0, 0)));
  TEST_ASSERT_TRUE(to_double(a.K(0, 0)) == to_double(b.K(0, 0) + Real(0.25)));
}

// Q = KᵀRK and N = KᵀR: the cost is (u + Kx)ᵀR(u + Kx), and u = −Kx, which stabilises, costs nothing.
void expect_free_gain(Problem problem, const MatrixXd& K, const MatrixXd& R) {
  problem.estimator.reset();
  problem.regulator->R = R;
  problem.regulator->N = K.transpose() * R;
  problem.regulator->Q = K.transpose() * R * K;
  const RegulatorSolution found = *solved(problem).regulator;
  TEST_ASSERT_TRUE(is_zero(found.X));
  TEST_ASSERT_TRUE(to_doubles(found.K) == K);
}

void test_gain_that_costs_nothing() {
  Problem scalar = scalar_problem(Domain::continuous, -2);
  scalar.regulator->cost = Cost::continuous;
  expect_free_gain(scalar, MatrixXd::Constant(1, 1, 0.25), MatrixXd::Constant(1, 1, 16));
  const MatrixXd A = (MatrixXd(2, 2) << 1, 0.5, -3, 0.25).finished(), K = (MatrixXd(2, 2) << 4, 0.5, -2, 3).finished();
  Problem several = problem_of(Domain::continuous, 0.1, A, MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2));
  several.regulator->cost = Cost::continuous;
  const MatrixXd R = (MatrixXd(2, 2) << 2, 0.5, 0.5, 1).finished();
  expect_free_gain(several, K, R);
  several = problem_of(Domain::discrete, 0.1, A / 4, MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2));
  expect_free_gain(several, K / 16, R);
}

// x₀ᵀXx₀ is what the loop costs from x₀ on.
void test_X_is_the_cost_from_the_start() {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Problem problem = random_problem(seed);
    const Solution found = solved(problem);
    const Digits scope(100);
    const RegulatorSolution& lqr = *found.regulator;
    const RealMatrix closed = found.plant.A - multiply(found.plant.B, lqr.K), NK = multiply(lqr.cost.N, lqr.K);
    const RealMatrix step = lqr.cost.Q - NK - NK.transpose() + transpose_congruence(lqr.K, lqr.cost.R);
    expect_small(distance(*solve_stein(closed, step), lqr.X), 1e-40, "the difference of the costs");
  }
}

// A diagonal plant of two equal halves: what does not belong together has gains of exactly zero.
void test_decoupled_halves_have_exact_zeros() {
  Problem problem = problem_of(Domain::continuous, 0.5, -0.3 * MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2),
                               MatrixXd::Identity(2, 2));
  const double c = 0.6, s = 0.8;
  const MatrixXd turn = (MatrixXd(2, 2) << c, -s, s, c).finished();
  problem.plant.B = turn;
  problem.plant.C = turn.transpose();
  const Solution found = solved(problem);
  // K = k turnᵀ and X = x I up to the last bits of 0.6² + 0.8²; with Q and R = I, X off the diagonal is
  // exactly zero.
  TEST_ASSERT_TRUE(found.regulator->X(0, 1).is_zero());
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 0)) == to_double(found.regulator->K(1, 1)));
}

void test_poles_are_sorted_and_in_conjugate_pairs() {
  const Poles poles = solved(two_mass()).regulator->poles;
  TEST_ASSERT_EQUAL(4, poles.size());
  for (std::size_t i = 0; i + 1 < poles.size(); ++i)
    TEST_ASSERT_TRUE(std::abs(poles[i]) >= std::abs(poles[i + 1]) - 1e-15);
  for (std::size_t i = 0; i < poles.size(); i += 2) {
    TEST_ASSERT_TRUE(poles[i].imag() > 0);
    TEST_ASSERT_TRUE(poles[i] == std::conj(poles[i + 1]));
  }
}

void expect_row(std::initializer_list<double> expected, const RealMatrix& found) {
  Index i = 0;
  for (const double entry : expected)
    TEST_ASSERT_DOUBLE_WITHIN(1e-8 * std::abs(entry), entry, to_double(found(0, i++)));
  TEST_ASSERT_EQUAL(i, found.cols());
}

// Computed with numpy 2.4 and scipy 1.17, from c2d to the third pass: a Maxon RE25 at 1 kHz that turns to an angle.
void test_share_of_the_state_in_the_integral_of_a_servo() {
  Problem problem =
      regulator_alone(problem_of(Domain::continuous, 0.001, (MatrixXd(2, 2) << 0, 1, 0, -47.37).finished(),
                                 Eigen::Vector2d(0, 2017), (MatrixXd(1, 2) << 1, 0).finished()));
  problem.regulator->Q = Eigen::Vector2d(1 / (0.05 * 0.05), 1 / (50.0 * 50.0)).asDiagonal();
  problem.regulator->R = MatrixXd::Constant(1, 1, 1 / (20.0 * 20.0));
  problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 1e3)};
  problem.regulator->track = {0};
  const Solution found = solved(problem);
  expect_row({-2.446881342845e-03, -1.268453772556e-06}, found.regulator->Gamma);
  expect_row({4.927991746829e-06}, found.regulator->H);
  expect_row({202.922411560384}, found.regulator->Nbar);
  problem.regulator->input_rate = MatrixXd::Constant(1, 1, 0.01);
  const Solution of_change = solved(problem);
  expect_row({-8.704430550086e-03, -3.002799727889e-05, -1.278089445805e-04}, of_change.regulator->Gamma);
  expect_row({0.000195604717}, of_change.regulator->H);
  expect_row({5.1123485875}, of_change.regulator->Nbar);
}

void test_conditioned_law_has_no_H_of_the_model() {
  Problem problem = regulator_alone(double_integrator(0.1));
  problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 1)};
  problem.regulator->anti_windup = AntiWindup::conditioning;
  TEST_ASSERT_EQUAL(0, solved(problem).regulator->H.size());
}

// Two plants that have nothing to do with each other, as one.
void test_integrals_of_decoupled_halves_have_exact_zeros() {
  Problem problem = regulator_alone(problem_of(Domain::continuous, 0.5, Eigen::Vector2d(-0.3, -0.7).asDiagonal(),
                                               MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2)));
  problem.regulator->integral = Integral{{0, 1}, MatrixXd::Identity(2, 2)};
  const Solution found = solved(problem);
  for (const RealMatrix* matrix : {&found.regulator->Gamma, &found.regulator->H})
    TEST_ASSERT_TRUE((*matrix)(0, 1).is_zero() && (*matrix)(1, 0).is_zero() && !(*matrix)(0, 0).is_zero());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_discrete_integrator_with_unit_weights);
  RUN_TEST(test_continuous_gain_of_the_double_integrator_is_one_and_root_three);
  RUN_TEST(test_sampled_cost_tends_to_the_continuous_one_from_above);
  RUN_TEST(test_cross_term_is_a_change_of_the_input);
  RUN_TEST(test_gain_that_costs_nothing);
  RUN_TEST(test_X_is_the_cost_from_the_start);
  RUN_TEST(test_decoupled_halves_have_exact_zeros);
  RUN_TEST(test_poles_are_sorted_and_in_conjugate_pairs);
  RUN_TEST(test_share_of_the_state_in_the_integral_of_a_servo);
  RUN_TEST(test_conditioned_law_has_no_H_of_the_model);
  RUN_TEST(test_integrals_of_decoupled_halves_have_exact_zeros);
  return UNITY_END();
}
