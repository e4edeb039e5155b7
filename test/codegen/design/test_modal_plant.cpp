// SPDX-License-Identifier: MIT
// The plant in the coordinates of its modes: the same filter for any outputs, blocks and ones, and refused where the
// target cannot bear it.
#include <Eigen/LU>
#include <cmath>
#include <string>

#include <unity.h>

#include "design/modal_plant.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

constexpr int seeds = 30;
constexpr double equal = 1e-30;  // of numbers that were settled from 50 digits, times a condition

Problem online(Problem problem) {
  problem.estimator->gain = Gain::online;
  return problem;
}

// The filter that carries P, by its equations (all outputs at once), on any plant of the same inputs and outputs.
struct Filter {
  const SampledPlant& plant;
  const OnlineSolution& of;
  RealMatrix x, P;

  // The innovation.
  RealMatrix sample(const RealMatrix& y, const RealMatrix& u) {
    const RealMatrix heard = multiply(of.E, y), du = multiply(of.D, u), e = heard - multiply(of.C, x) - du;
    const RealMatrix S = congruence(of.C, P) + RealMatrix(of.V.asDiagonal());
    const RealMatrix L = solve(S, multiply(of.C, P))->transpose();
    x += multiply(L, e);
    P = symmetric_part(P - multiply(L, multiply(of.C, P)));
    x = multiply(plant.A, x) + multiply(plant.B, u) + multiply(of.M, heard - multiply(of.C, x) - du);
    P = congruence(of.A_free, P) + of.W;
    return e;
  }
};

void expect_the_same_filter(const Problem& problem, const Solution& solution, const ModalPlant& modal,
                            std::uint64_t seed) {
  const Digits scope(solution.numerics.digits);
  const Index nx = solution.plant.A.rows();
  Random random(seed);
  Filter physical{solution.plant, *solution.online, padded(real(problem.estimator->x0), nx, 1), solution.online->P0};
  Filter modes{modal.plant, modal.online, modal.z0, modal.online.P0};
  for (int k = 0; k < 12; ++k) {
    const RealMatrix y = real(random.matrix(solution.plant.C.rows(), 1)),
                     u = real(random.matrix(solution.plant.B.cols(), 1));
    const RealMatrix e = physical.sample(y, u);
    expect_small(largest_entry(modes.sample(y, u) - e) / (1 + largest_entry(e)), equal, "innovation");
    expect_small(largest_entry(multiply(modal.T, modes.x) - physical.x) / (1 + largest_entry(physical.x)), equal,
                 "T z − x");
    expect_small(largest_entry(congruence(modal.T, modes.P) - physical.P) / largest_entry(physical.P), equal,
                 "T P Tᵀ − P");
    const RealMatrix law = multiply(solution.regulator->K.leftCols(nx), physical.x);
    expect_small(largest_entry(multiply(modal.K.leftCols(nx), modes.x) - law) / (1 + largest_entry(law)), equal, "K x");
  }
}

void test_same_innovations_estimates_covariances_and_laws() {
  int found = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Problem problem = online(random_problem(seed));
    Random random(seed + 1000);
    problem.estimator->x0 = random.matrix(problem.plant.A.rows(), 1);
    problem.estimator->covariance = seed % 2 ? Covariance::ud : Covariance::plain;
    if (seed % 5 == 0 && problem.plant.domain == Domain::discrete) problem.plant.delay = 2 * problem.plant.sample_time;
    if (seed % 7 == 0)
      problem.regulator->input_rate = Eigen::MatrixXd::Identity(problem.plant.B.cols(), problem.plant.B.cols());
    const Solution solution = solved(problem);
    const ModalPlantResult result = modal_plant(problem, solution);
    TEST_ASSERT_TRUE_MESSAGE(result.modal || result.obstacle.find("near each other") != std::string::npos ||
                                 result.obstacle.find("repeated") != std::string::npos,
                             (std::to_string(seed) + ": " + result.obstacle).c_str());
    if (!result.modal) continue;
    ++found;
    expect_the_same_filter(problem, solution, *result.modal, seed);
    if (problem.estimator->covariance == Covariance::plain) continue;
    const Digits scope(solution.numerics.digits);
    const RealMatrix D0 = result.modal->online.D0.asDiagonal();
    expect_small(largest_entry(congruence(result.modal->online.U0, D0) - result.modal->online.P0) /
                     largest_entry(result.modal->online.P0),
                 equal, "U0 D0 U0ᵀ − P0");
  }
  TEST_ASSERT_GREATER_THAN_INT(seeds / 2, found);
}

// [σ ω; −ω σ] with ω > 0, and [1 0] of its output: exactly, as the target's numbers say 1 and 0.
void expect_blocks_and_ones(const ModalPlant& modal, Index own) {
  for (Index i = 0; i < own; i += 2) {
    const RealMatrix block = modal.plant.A.block(i, i, 2, 2);
    TEST_ASSERT_TRUE(block(0, 0) == block(1, 1) && block(0, 1) == -block(1, 0) && block(0, 1) > 0);
    int ones = 0;
    for (Index k = 0; k < modal.online.C.rows(); ++k)
      ones += to_double(modal.online.C(k, i)) == 1 && modal.online.C(k, i + 1).is_zero();
    TEST_ASSERT_GREATER_OR_EQUAL_INT(1, ones);
    for (Index j = 0; j < own; ++j)
      if (j < i || j > i + 1) TEST_ASSERT_TRUE(modal.plant.A(i, j).is_zero() && modal.plant.A(i + 1, j).is_zero());
  }
}

// Three masses between two walls, ẍ = u at the first, positions of the ends.
Problem masses_between_walls() {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6), B = Eigen::MatrixXd::Zero(6, 1), C = Eigen::MatrixXd::Zero(2, 6);
  A.topRightCorner(3, 3).setIdentity();
  A.bottomLeftCorner(3, 3) << -2.5, 1, 0, 1, -2, 1, 0, 1, -3;
  A.bottomRightCorner(3, 3) = 0.01 * A.bottomLeftCorner(3, 3);
  B(3, 0) = 1;
  C(0, 0) = C(1, 2) = 1;
  return problem_of(Domain::continuous, 0.2, A, B, C);
}

void test_A_has_blocks_and_C_ones() {
  const Problem problem = online(masses_between_walls());
  const Solution solution = solved(problem);
  const ModalPlantResult result = modal_plant(problem, solution);
  TEST_ASSERT_TRUE_MESSAGE(result.modal.has_value(), result.obstacle.c_str());
  expect_blocks_and_ones(*result.modal, 6);
}

// Numbers of reference.py (mpmath): each is the double nearest to it.
void test_numbers_round_to_those_of_mpmath() {
  const Problem problem = online(masses_between_walls());
  const ModalPlant modal = *modal_plant(problem, solved(problem)).modal;
  const double sigma[] = {0.9811862302586859, 0.94337222971869272, 0.91996642981129806},
               omega[] = {0.18835251596584099, 0.32343281076270647, 0.38202765227815705},
               B[] = {0.0048101048329413625, 0.050579771203953593,  0.011316218637703752,
                      0.067930623410842814,  0.0057787364534384617, 0.029003136565334469},
               C[] = {1, 0.76198819854093303, 1, -0.83453954414114417, 0.63590928385128187, 1},
               variances[] = {0.24137201854042845, 0.26842214342353288, 0.57201998001329357,
                              0.20978017784542469, 0.46146623618525284, 0.11919704416639959};
  for (Index i = 0; i < 6; ++i) {
    TEST_ASSERT_TRUE(to_double(modal.plant.A(i, i)) == sigma[i / 2]);
    TEST_ASSERT_TRUE(to_double(modal.plant.A(i, i ^ 1)) == (i % 2 ? -omega[i / 2] : omega[i / 2]));
    TEST_ASSERT_TRUE(to_double(modal.plant.B(i, 0)) == B[i]);
    TEST_ASSERT_TRUE(to_double(modal.plant.C(i % 2, i / 2 * 2)) == C[i]);
    TEST_ASSERT_TRUE(to_double(modal.online.P0(i, i)) == variances[i]);
  }
}

// They are shifted, not mixed: what the library knows of them stays true.
void test_inputs_on_their_way_keep_their_coordinates() {
  Problem problem = online(masses_between_walls());
  problem.plant.delay = 2.5 * problem.plant.sample_time;
  const Solution solution = solved(problem);
  const ModalPlant modal = *modal_plant(problem, solution).modal;
  const Index all = solution.plant.A.rows();
  TEST_ASSERT_EQUAL_INT(9, all);
  expect_blocks_and_ones(modal, 6);
  TEST_ASSERT_TRUE(modal.T.bottomRightCorner(3, 3).isIdentity(0));
  TEST_ASSERT_TRUE(is_zero(modal.T.topRightCorner(6, 3)) && is_zero(modal.T.bottomLeftCorner(3, 6)));
  TEST_ASSERT_TRUE(is_zero(modal.plant.A.bottomRows(3) - solution.plant.A.bottomRows(3)));
  TEST_ASSERT_TRUE(is_zero(modal.plant.B.bottomRows(3) - solution.plant.B.bottomRows(3)));
  expect_the_same_filter(problem, solution, modal, 1);
}

// Of correlated outputs the filter takes others; those have the ones.
void test_ones_are_those_of_the_outputs_that_the_filter_takes() {
  Problem problem = online(masses_between_walls());
  problem.estimator->V << 2, 0.5, 0.5, 1;
  const Solution solution = solved(problem);
  TEST_ASSERT_FALSE(solution.online->E.isIdentity(0));
  const ModalPlant modal = *modal_plant(problem, solution).modal;
  expect_blocks_and_ones(modal, 6);
  expect_the_same_filter(problem, solution, modal, 2);
}

// ẍ = u: z = 1 is there twice, with one eigenvector.
void test_repeated_pole_is_refused() {
  const Problem problem = online(double_integrator(0.1));
  TEST_ASSERT_EQUAL_STRING("a pole of the plant is repeated", modal_plant(problem, solved(problem)).obstacle.c_str());
}

// ẍ = −d ẋ + u, with poles at s = 0 and −d.
Problem with_poles_apart(double d) {
  return online(problem_of(Domain::continuous, 0.1, (Eigen::MatrixXd(2, 2) << 0, 1, 0, -d).finished(),
                           Eigen::MatrixXd(Eigen::Vector2d(0, 1)), Eigen::MatrixXd(Eigen::RowVector2d(1, 0))));
}

// T = [1 1; 0 −d]: |T⁻¹| |T| = [1 2; 0 1], whose ρ is 1, whatever d is. With both states mixed it is not.
Problem with_mixed_poles_apart(double d) {
  Problem problem = with_poles_apart(d);
  const Eigen::Matrix2d mix = (Eigen::Matrix2d() << 1, 0.5, -0.5, 1).finished();
  problem.plant.A = mix * problem.plant.A * mix.inverse();
  problem.plant.B = mix * problem.plant.B;
  problem.plant.C = problem.plant.C * mix.inverse();
  return problem;
}

double condition(const Problem& problem) {
  const ModalPlantResult result = modal_plant(problem, solved(problem));
  TEST_ASSERT_TRUE_MESSAGE(result.modal.has_value(), result.obstacle.c_str());
  return result.modal->condition;
}

void test_condition_is_that_of_the_best_units() {
  TEST_ASSERT_DOUBLE_WITHIN(0.05, 1, condition(with_poles_apart(0.01)));
  const double near = condition(with_mixed_poles_apart(1e-4)), far = condition(with_mixed_poles_apart(1e-2));
  TEST_ASSERT_DOUBLE_WITHIN(2, 100, near / far);
}

void test_condition_does_not_depend_on_units() {
  Problem problem = with_mixed_poles_apart(0.1);
  const double before = condition(problem);
  const Eigen::MatrixXd units = Eigen::Vector2d(1024, 0x1p-10).asDiagonal();
  problem.plant.A = units * problem.plant.A * units.inverse();
  problem.plant.B = units * problem.plant.B;
  problem.plant.C = problem.plant.C * units.inverse();
  problem.plant.G = units * problem.plant.G;
  problem.regulator->Q = units.inverse() * problem.regulator->Q * units.inverse();
  TEST_ASSERT_DOUBLE_WITHIN(1e-4 * before, before, condition(problem));
}

void test_poles_that_meet_are_refused_with_their_condition() {
  Problem problem = with_mixed_poles_apart(1e-5);
  const Solution solution = solved(problem);
  TEST_ASSERT_TRUE(modal_plant(problem, solution).modal.has_value());  // in double
  problem.code.real = Scalar::float32;
  const std::string why = modal_plant(problem, solution).obstacle;
  TEST_ASSERT_TRUE_MESSAGE(why.find("poles of the plant are so near each other that x = T z loses") == 0, why.c_str());
  TEST_ASSERT_TRUE_MESSAGE(why.find("in float at most 2896.31 will do") != std::string::npos, why.c_str());
}

// The outputs of a mode are numbers of a float, their variances are not.
void test_variance_that_a_float_would_lose_is_refused() {
  Problem problem = with_poles_apart(0.5);
  problem.plant.C(0, 0) = 1e-25;
  problem.estimator->V(0, 0) = 1e-36;
  problem.code.real = Scalar::float32;
  const Solution solution = solved(problem);
  const std::string why = modal_plant(problem, solution).obstacle;
  TEST_ASSERT_EQUAL_STRING("a variance is too small for float", why.c_str());
}

void test_what_carries_no_P_of_one_plant_says_so() {
  TEST_ASSERT_EQUAL_STRING("", no_modal_plant(online(two_mass())).c_str());
  TEST_ASSERT_EQUAL_STRING("the filter does not carry P", no_modal_plant(two_mass()).c_str());
  Problem problem = online(two_mass());
  problem.stages.push_back({});
  TEST_ASSERT_TRUE(no_modal_plant(problem).find("stage") != std::string::npos);
}

// What the report says of the rounded loop is said of the numbers that are emitted.
void test_rounded_loop_is_that_of_the_modes() {
  Problem problem = online(masses_between_walls());
  problem.code.real = Scalar::float32;
  Solution solution = solved(problem);
  const Poles physical = solution.loop.rounded->poles;
  Findings findings;
  check_rounded_modes(problem, *modal_plant(problem, solution).modal, solution, findings);
  TEST_ASSERT_TRUE(findings.empty());
  bool changed = false;
  for (std::size_t i = 0; i < physical.size(); ++i) {
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, std::abs(solution.loop.poles[i]), std::abs(solution.loop.rounded->poles[i]));
    changed = changed || physical[i] != solution.loop.rounded->poles[i];
  }
  TEST_ASSERT_TRUE(changed);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_same_innovations_estimates_covariances_and_laws);
  RUN_TEST(test_A_has_blocks_and_C_ones);
  RUN_TEST(test_numbers_round_to_those_of_mpmath);
  RUN_TEST(test_inputs_on_their_way_keep_their_coordinates);
  RUN_TEST(test_ones_are_those_of_the_outputs_that_the_filter_takes);
  RUN_TEST(test_repeated_pole_is_refused);
  RUN_TEST(test_condition_is_that_of_the_best_units);
  RUN_TEST(test_condition_does_not_depend_on_units);
  RUN_TEST(test_poles_that_meet_are_refused_with_their_condition);
  RUN_TEST(test_variance_that_a_float_would_lose_is_refused);
  RUN_TEST(test_what_carries_no_P_of_one_plant_says_so);
  RUN_TEST(test_rounded_loop_is_that_of_the_modes);
  return UNITY_END();
}
