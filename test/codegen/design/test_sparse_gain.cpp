// SPDX-License-Identifier: MIT
// Gains with some entries kept at zero: a minimum over the entries that are left, found from unstable starts, too.
#include <cmath>

#include <unity.h>

#include "design/equations/sparse_gain.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

RiccatiEquation random_equation(Random& random, Index nx, Index nu) {
  return {real(random.matrix(nx, nx)), real(random.matrix(nx, nu)), identity(nx), identity(nu), zeros(nx, nu)};
}

// Every entry with one chance in two, the first ones always.
MatrixXd random_structure(Random& random, Index nu, Index nx) {
  MatrixXd kept = MatrixXd::Zero(nu, nx);
  for (Index i = 0; i < kept.size(); ++i) kept.data()[i] = random.uniform() < 0 ? 1 : 0;
  kept.col(0).setOnes();
  return kept;
}

Real cost_of(const StructureProblem& problem, const RealMatrix& K) {
  const RiccatiEquation& e = problem.equation;
  const std::optional<RealMatrix> X = solve_stein(e.A - multiply(e.B, K), step_cost(e, K));
  TEST_ASSERT_TRUE_MESSAGE(X.has_value(), "the gain does not stabilise");
  return trace_of_product(*X, problem.W);
}

RealMatrix full_gain(const StructureProblem& problem) {
  return solve_discrete_riccati(problem.equation, RealMatrix()).K;
}

// Steps of 10^−15 along every kept entry: the cost rises by its second order, 10^−30, to both sides alike.
void expect_minimum(const StructureProblem& problem, const RealMatrix& K) {
  const Real step = power_of_ten(-15), least = cost_of(problem, K);
  for (Index i = 0; i < K.size(); ++i) {
    if (problem.kept.data()[i] == 0) {
      TEST_ASSERT_TRUE(K.data()[i].is_zero());
      continue;
    }
    RealMatrix up = K, down = K;
    up.data()[i] += step;
    down.data()[i] -= step;
    const Real rise_up = cost_of(problem, up) - least, rise_down = cost_of(problem, down) - least;
    TEST_ASSERT_TRUE_MESSAGE(rise_up > 0 && rise_down > 0, "a neighbour costs less");
    expect_small(abs(rise_up - rise_down) / rise_up, 1e-10, "the cost's slope beside its curvature");
  }
}

void test_random_structures_end_in_a_minimum() {
  const Digits scope(60);
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const Index nx = 2 + static_cast<Index>(seed % 4), nu = 1 + static_cast<Index>(seed % 2);
    const StructureProblem problem = {random_equation(random, nx, nu), identity(nx), random_structure(random, nu, nx)};
    const StructuredGain gain = structured_gain(problem, full_gain(problem), RealMatrix());
    if (gain.failure != StructureFailure::none) continue;
    ++found;
    expect_minimum(problem, gain.K);
    const Real least = cost_of(problem, full_gain(problem));
    TEST_ASSERT_TRUE_MESSAGE(cost_of(problem, gain.K) >= least * (1 - power_of_ten(-40)), "less than the optimum");
  }
  TEST_ASSERT_TRUE(found >= 50);  // a structure need not have a stabilising gain
}

void test_all_entries_kept_is_the_full_gain() {
  const Digits scope(60);
  Random random(7);
  const StructureProblem problem = {random_equation(random, 4, 2), identity(4), MatrixXd::Ones(2, 4)};
  const RealMatrix full = full_gain(problem);
  expect_small(distance(structured_gain(problem, full, RealMatrix()).K, full), 1e-40, "the difference");
}

// Two plants side by side: the full gain has the zeros by itself, and truncation is the answer.
void test_decoupled_plants_lose_nothing() {
  const Digits scope(60);
  MatrixXd A(2, 2), kept(2, 2);
  A << 1.2, 0, 0, 0.9;
  kept << 1, 0, 0, 1;
  const StructureProblem problem = {{real(A), identity(2), identity(2), identity(2), zeros(2, 2)}, identity(2), kept};
  expect_small(distance(structured_gain(problem, full_gain(problem), RealMatrix()).K, full_gain(problem)), 1e-40,
               "the difference");
}

// z² − 1.7z + 0.6 + k is stable for 0.1 < k < 0.4; the full gain, near deadbeat, has k = 1.4.
void test_start_that_does_not_stabilise_is_led_to_one_that_does() {
  const Digits scope(60);
  MatrixXd A(2, 2), kept(1, 2);
  A << 1.2, 1, 0, 0.5;
  kept << 1, 0;
  const StructureProblem problem = {
      {real(A), real(Eigen::Vector2d(0, 1)), 100 * identity(2), identity(1), zeros(2, 1)}, identity(2), kept};
  const RealMatrix full = full_gain(problem);
  RealMatrix truncated = full;
  truncated(0, 1) = 0;
  const RealMatrix closed = problem.equation.A - multiply(problem.equation.B, truncated);
  TEST_ASSERT_FALSE_MESSAGE(solve_stein(closed, identity(2)).has_value(), "the truncated gain stabilises already");
  const StructuredGain gain = structured_gain(problem, full, RealMatrix());
  TEST_ASSERT_TRUE(gain.failure == StructureFailure::none);
  expect_minimum(problem, gain.K);
}

// A second plant that no kept entry feeds back.
void test_unstable_mode_that_the_structure_cannot_move_is_named() {
  const Digits scope(60);
  MatrixXd A(2, 2), kept(2, 2);
  A << 0.5, 0, 0, 1.5;
  kept << 1, 0, 1, 0;
  const StructureProblem problem = {{real(A), identity(2), identity(2), identity(2), zeros(2, 2)}, identity(2), kept};
  TEST_ASSERT_TRUE(structured_gain(problem, full_gain(problem), RealMatrix()).failure == StructureFailure::no_start);
  const std::vector<ComplexReal> fixed = fixed_unstable_modes(problem);
  TEST_ASSERT_EQUAL(1, fixed.size());
  expect_small(abs(fixed[0].re - 1.5), 1e-30, "the distance to 1.5");
}

void test_decoupled_regulator_of_two_masses_tells_what_it_costs() {
  Problem problem = two_mass();
  const Solution full = solved(problem);
  problem.regulator->structure = (MatrixXd(1, 4) << 1, 1, 0, 0).finished();
  const Solution kept = solved(problem);
  TEST_ASSERT_TRUE(kept.regulator->K(0, 2).is_zero() && kept.regulator->K(0, 3).is_zero());
  TEST_ASSERT_FALSE(kept.regulator->K(0, 0).is_zero());
  const StructureReport& report = *kept.regulator->structure;
  expect_rounded(full.regulator->K, report.full, "the full gain");
  TEST_ASSERT_TRUE(report.full_poles == full.regulator->poles);
  TEST_ASSERT_TRUE(report.cost_ratio > 1 && *kept.loop.cost_per_sample > *full.loop.cost_per_sample);
  TEST_ASSERT_DOUBLE_WITHIN(1e-12, *full.loop.at_input.disk, *report.full_margins.disk);
  for (const std::complex<double>& pole : kept.loop.poles) TEST_ASSERT_TRUE(std::abs(pole) < 1);
}

// P_prior = F P_prior Fᵀ + GWGᵀ + L_p V L_pᵀ − G Swv L_pᵀ − L_p SwvᵀGᵀ with F = A − L_p C: of any gain.
void expect_covariance_of_gain(const Solution& found) {
  const Digits scope(found.numerics.digits);
  const SampledPlant& plant = found.plant;
  const EstimatorSolution& filter = *found.estimator;
  const RealMatrix told = multiply_transpose(multiply(plant.G, filter.noise.Swv), filter.L_predictor);
  const RealMatrix drive =
      congruence(plant.G, filter.noise.W) + congruence(filter.L_predictor, filter.noise.V) - told - told.transpose();
  const RealMatrix closed = plant.A - multiply(filter.L_predictor, plant.C);
  const std::optional<RealMatrix> P = solve_stein(closed.transpose(), drive);
  TEST_ASSERT_TRUE_MESSAGE(P.has_value(), "the filter is not stable");
  expect_small(distance(filter.P_prior, *P), 1e-30, "the prior covariance's error");
}

// Cross noise and both forms: seeds 1 … 40, each without its last entry of the gain.
void test_structured_filters_have_the_covariance_of_their_gain() {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem problem = random_problem(seed);
    problem.estimator->gain = Gain::steady;
    problem.estimator->structure = MatrixXd::Ones(problem.plant.A.rows(), problem.plant.C.rows());
    if (problem.estimator->structure.size() == 1) continue;
    problem.estimator->structure.bottomRightCorner(1, 1).setZero();
    Findings findings;
    const std::optional<Solution> solution = solve(problem, findings);
    if (!solution) continue;
    ++found;
    const EstimatorSolution& filter = *solution->estimator;
    const bool filtered = problem.estimator->form == Form::filter;
    const RealMatrix& gain = filtered ? filter.L : filter.L_predictor;
    TEST_ASSERT_TRUE(gain(gain.rows() - 1, gain.cols() - 1).is_zero());
    TEST_ASSERT_TRUE(filter.structure->cost_ratio >= 1);
    expect_covariance_of_gain(*solution);
  }
  TEST_ASSERT_TRUE(found >= 28);
}

void expect_refusal(const Problem& problem, const char* key, const char* part) {
  Findings findings;
  TEST_ASSERT_FALSE_MESSAGE(solve(problem, findings).has_value(), part);
  TEST_ASSERT_EQUAL_STRING(key, findings[0].key.c_str());
  TEST_ASSERT_TRUE_MESSAGE(findings[0].message.find(part) != std::string::npos, findings[0].message.c_str());
}

void test_structures_that_no_gain_can_have() {
  Problem problem = two_mass();
  problem.regulator->structure = MatrixXd::Zero(1, 4);
  expect_refusal(problem, "lqr.structure", "keeps no entry");
  problem.regulator->structure.setOnes();
  problem.regulator->cost = Cost::continuous;
  expect_refusal(problem, "lqr.structure", "cost");
  problem = two_mass();
  problem.estimator->structure = MatrixXd::Ones(4, 2);
  problem.estimator->gain = Gain::online;
  expect_refusal(problem, "kalman.structure", "gain = \"steady\"");
}

void test_mode_that_the_structure_leaves_alone_is_the_reason() {
  MatrixXd A(2, 2);
  A << 0.5, 0, 0, 1.5;
  Problem problem = problem_of(Domain::discrete, 1, A, MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2));
  problem.regulator->structure = (MatrixXd(2, 2) << 1, 0, 1, 0).finished();
  expect_refusal(problem, "lqr.structure", "the mode at z = 1.5 is moved by no gain of this structure");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_random_structures_end_in_a_minimum);
  RUN_TEST(test_all_entries_kept_is_the_full_gain);
  RUN_TEST(test_decoupled_plants_lose_nothing);
  RUN_TEST(test_start_that_does_not_stabilise_is_led_to_one_that_does);
  RUN_TEST(test_unstable_mode_that_the_structure_cannot_move_is_named);
  RUN_TEST(test_decoupled_regulator_of_two_masses_tells_what_it_costs);
  RUN_TEST(test_structured_filters_have_the_covariance_of_their_gain);
  RUN_TEST(test_structures_that_no_gain_can_have);
  RUN_TEST(test_mode_that_the_structure_leaves_alone_is_the_reason);
  return UNITY_END();
}
