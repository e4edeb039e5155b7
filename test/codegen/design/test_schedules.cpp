// SPDX-License-Identifier: MIT
// Gains that change from step to step: finite horizons, stages, the transient of a filter; and the set point of r.
#include <cmath>

#include <unity.h>

#include "design/equations/riccati_flow.hpp"
#include "design/gains/horizon.hpp"
#include "design/loop/compensator.hpp"
#include "design/rounding.hpp"
#include "design/sampled/augmentation.hpp"
#include "design/sampled/reference.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

const double rounding = 1e-30;  // of 100 digits of which solving takes half, less condition

Problem estimator_alone(Problem problem) {
  problem.regulator.reset();
  return problem;
}

Problem scalar_problem(double a, double c) {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  return problem_of(Domain::discrete, 1, a * one, one, c * one);
}

bool is_refused(const Problem& problem, const std::string& key, const std::string& words) {
  Findings findings;
  if (solve(problem, findings)) return false;
  for (const Finding& finding : findings)
    if (finding.key == key && finding.message.find(words) != std::string::npos) return true;
  return false;
}

// What the gains cost from z on, step after step, with `X_end` after the last.
Real cost_of_gains(const std::vector<SampledStage>& stages, const std::vector<RealMatrix>& gains, RealMatrix z,
                   const RealMatrix& X_end) {
  Real cost;
  for (std::size_t k = 0; k < gains.size(); ++k) {
    const SampledStage& stage = stage_at(stages, static_cast<int>(k));
    const RiccatiEquation e = regulator_equation(stage.problem, stage.samples);
    const RealMatrix v = -multiply(gains[k], z);
    cost += trace_of_product(z.transpose(), multiply(e.Q, z)) + trace_of_product(v.transpose(), multiply(e.R, v)) +
            2 * trace_of_product(z.transpose(), multiply(e.N, v));
    z = multiply(e.A, z) + multiply(e.B, v);
  }
  return cost + trace_of_product(z.transpose(), multiply(X_end, z));
}

// A horizon and one change on the way.
Problem random_finite_problem(std::uint64_t seed) {
  Problem problem = regulator_alone(random_problem(seed));
  Random random(seed + 1000);
  const Index nx = problem.plant.A.rows(), nu = problem.plant.B.cols();
  problem.regulator->horizon = 7;
  problem.regulator->R += MatrixXd::Identity(nu, nu);
  problem.regulator->Q_final = random.semidefinite(nx, nx);
  Stage stage;
  stage.from = 3;
  stage.A = 1.5 * random.matrix(nx, nx);
  stage.Q = problem.regulator->Q + MatrixXd::Identity(nx, nx);
  problem.stages = {stage};
  if (seed % 4 == 1) problem.regulator->input_rate = MatrixXd::Identity(nu, nu);
  return problem;
}

// --- regulator --------------------------------------------------------------------------------------------------

void test_cost_to_go_is_what_the_gains_cost_and_no_others_cost_less() {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Problem problem = random_finite_problem(seed);
    const Solution found = solved(problem);
    const Digits scope(60);
    const std::vector<SampledStage> stages = sample_stages(problem);
    const RealMatrix X_end = final_weight(stages.back(), problem.regulator->Q_final);
    std::vector<RealMatrix> gains = found.regulator->K_schedule;
    TEST_ASSERT_EQUAL(7, gains.size());
    const RealMatrix z = real(Random(seed).matrix(X_end.rows(), 1));
    const Real expected = trace_of_product(z.transpose(), multiply(found.regulator->X0, z));
    expect_small(abs(cost_of_gains(stages, gains, z, X_end) / expected - 1), rounding, "the difference");
    gains[seed % 7](0, 0) += Real(0.01);
    TEST_ASSERT_TRUE(cost_of_gains(stages, gains, z, X_end) >= expected);
    TEST_ASSERT_TRUE(distance(found.regulator->K, found.regulator->K_schedule.back()).is_zero());
  }
}

void test_long_horizon_begins_with_the_steady_gain() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem steady = regulator_alone(random_problem(seed)), finite = steady;
    steady.regulator->R += MatrixXd::Identity(steady.plant.B.cols(), steady.plant.B.cols());
    finite.regulator->R = steady.regulator->R;
    const Solution expected = solved(steady);
    const double slowest = std::abs(expected.regulator->poles.front());
    if (slowest > 0.9) continue;  // 0.9^(2 · 400) is 1e-37
    finite.regulator->horizon = 400;
    finite.regulator->Q_final = MatrixXd::Identity(steady.plant.A.rows(), steady.plant.A.rows());
    const Solution found = solved(finite);
    const Digits scope(60);
    expect_small(distance(found.regulator->K_schedule.front(), expected.regulator->K), 1e-14, "K[0]");
    expect_small(distance(found.regulator->X0, expected.regulator->X), 1e-14, "X0");
  }
}

// −ẋ = 1 − x², x(tf) = 0: x = tanh(tf − t).
void test_continuous_gains_of_an_integrator_are_hyperbolic_tangents() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = regulator_alone(problem_of(Domain::continuous, 0.25, 0 * one, one, one));
  problem.regulator->cost = Cost::continuous;
  problem.regulator->horizon = 6;
  const Solution found = solved(problem);
  const Digits scope(60);
  for (int k = 0; k < 6; ++k)
    TEST_ASSERT_TRUE(to_double(found.regulator->K_schedule[static_cast<std::size_t>(k)](0, 0)) ==
                     to_double(tanh(Real(0.25) * (6 - k))));
}

// One long period is many short ones; an unstable fast mode overflows nothing.
void test_continuous_gains_do_not_depend_on_the_periods_between() {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Problem fine = regulator_alone(
        problem_of(Domain::continuous, 0.05, 3 * random.matrix(3, 3), random.matrix(3, 1), random.matrix(1, 3)));
    if (seed == 1) fine.plant.A(0, 0) = 400;
    fine.regulator->cost = Cost::continuous;
    fine.regulator->horizon = 16;
    fine.regulator->Q_final = random.semidefinite(3, 3);
    fine.regulator->N = 0.25 * random.matrix(3, 1);
    Problem coarse = fine;
    coarse.plant.sample_time = 0.4;
    coarse.regulator->horizon = 2;
    const Solution many = solved(fine), few = solved(coarse);
    const Digits scope(60);
    expect_small(distance(many.regulator->K_schedule[8], few.regulator->K_schedule[1]), 1e-15, "K");
    expect_small(distance(many.regulator->X0, few.regulator->X0), 1e-14, "X0");
  }
}

// The slope of X by differences is the right-hand side.
void test_continuous_cost_to_go_obeys_the_differential_equation() {
  const Digits scope(80);
  Random random(5);
  RiccatiEquation e = {real(random.matrix(3, 3)), real(random.matrix(3, 2)), real(random.semidefinite(3, 3)),
                       identity(2), real(0.25 * random.matrix(3, 2))};
  const RealMatrix X_end = real(random.semidefinite(3, 3));
  const auto X_after = [&](const Real& t) {
    const RiccatiFlow flow = *riccati_flow(e, t);
    return *carried_back(flow, X_end);
  };
  const Real t = 0.7, step = power_of_ten(-20);
  const RealMatrix X = X_after(t), slope = (X_after(t + step) - X_after(t - step)) / (2 * step);
  const RealMatrix XBN = multiply(X, e.B) + e.N, AX = transpose_multiply(e.A, X);
  const RealMatrix expected = AX + AX.transpose() + e.Q - multiply_transpose(XBN, XBN);
  expect_small(distance(slope, expected), 1e-35, "the slope's difference");
}

void test_stages_of_an_endless_problem_end_in_the_gain_of_the_last() {
  Problem problem = regulator_alone(two_mass());
  Stage stage;
  stage.from = 4;
  stage.R = MatrixXd::Constant(1, 1, 2);
  problem.stages = {stage};
  Problem later = regulator_alone(two_mass());
  later.regulator->R(0, 0) = 2;
  const Solution found = solved(problem), expected = solved(later);
  TEST_ASSERT_EQUAL(4, found.regulator->K_schedule.size());
  expect_rounded(expected.regulator->K, found.regulator->K, "K");
  const Digits scope(60);
  const RealMatrix z = RealMatrix::Constant(4, 1, Real(1));
  const Real cost = cost_of_gains(sample_stages(problem), found.regulator->K_schedule, z, expected.regulator->X);
  expect_small(abs(cost / trace_of_product(z.transpose(), multiply(found.regulator->X0, z)) - 1), 1e-14,
               "the cost's difference");
}

void test_stages_that_change_nothing_change_no_gain() {
  Problem problem = regulator_alone(two_mass());
  Stage stage;
  stage.from = 5;
  stage.Q = problem.regulator->Q;
  problem.stages = {stage};
  const Solution found = solved(problem);
  for (const RealMatrix& K : found.regulator->K_schedule) expect_rounded(found.regulator->K, K, "K[k]");
}

// u[N−1] takes effect after the end: it stays 0, and the loop is what the plant is.
void test_input_that_acts_after_the_end_stays_0() {
  Problem problem = regulator_alone(double_integrator(0.1));
  problem.plant.delay = 0.2;
  problem.regulator->horizon = 5;
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(is_zero(found.regulator->K_schedule[4]) && is_zero(found.regulator->K_schedule[3]));
  TEST_ASSERT_FALSE(is_zero(found.regulator->K_schedule[2]));
  TEST_ASSERT_FALSE(found.loop.at_input.disk.has_value());
}

void test_horizon_needs_no_stabilisable_plant() {
  Problem problem = regulator_alone(scalar_problem(2, 1));
  problem.plant.B(0, 0) = 0;
  problem.regulator->horizon = 3;
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(found.regulator->X0(0, 0) == 21);  // 1 + 4 + 16
}

// --- filter -----------------------------------------------------------------------------------------------------

// A constant seen in noise, the first estimate with the variance p: L[k] = 1/(k + 1 + v/p).
void test_scheduled_gains_of_a_constant_average_what_was_seen() {
  Problem problem = estimator_alone(scalar_problem(1, 1));
  problem.estimator->W(0, 0) = 0;
  problem.estimator->V(0, 0) = 3;
  problem.estimator->P0(0, 0) = 7;
  problem.estimator->gain = Gain::schedule;
  problem.estimator->horizon = 20;
  const Solution found = solved(problem);
  const Digits scope(60);
  TEST_ASSERT_EQUAL(20, found.estimator->L_schedule.size());
  for (int k = 0; k < 20; ++k)
    TEST_ASSERT_TRUE(to_double(found.estimator->L_schedule[static_cast<std::size_t>(k)](0, 0)) ==
                     to_double(1 / (k + 1 + Real(3) / 7)));
  expect_rounded(found.estimator->L_schedule.back(), found.estimator->L, "L");
}

// P from P0 by the information form: P⁻¹ is updated by Cᵀ V⁻¹ C.
void test_scheduled_gains_are_those_of_the_information_filter() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem problem = estimator_alone(random_problem(seed));
    problem.estimator->Swv.setZero();
    problem.estimator->gain = Gain::schedule;
    problem.estimator->horizon = 6;
    problem.estimator->V += MatrixXd::Identity(problem.plant.C.rows(), problem.plant.C.rows());
    const Solution found = solved(problem);
    const Digits scope(100);
    const SampledPlant& plant = found.plant;
    const SampledNoise& noise = found.estimator->noise;
    const Index nx = plant.A.rows(), ny = plant.C.rows();
    RealMatrix P = real(problem.estimator->P0);
    for (const RealMatrix& L : found.estimator->L_schedule) {
      const RealMatrix VC = *solve(noise.V, plant.C);
      const RealMatrix posterior = *solve(identity(nx) + multiply(P, transpose_multiply(plant.C, VC)), P);
      expect_small(distance(L, multiply_transpose(posterior, VC)), 1e-14, "L");
      P = congruence(plant.A, symmetric_part(posterior)) + congruence(plant.G, noise.W);
    }
    TEST_ASSERT_EQUAL(ny, found.estimator->L.cols());
  }
}

void test_schedule_ends_where_the_gains_round_to_the_steady_ones() {
  for (const lqg::design::Scalar real : {lqg::design::Scalar::float32, lqg::design::Scalar::float64}) {
    Problem problem = estimator_alone(two_mass()), steady = problem;
    problem.estimator->gain = Gain::schedule;
    problem.code.real = real;
    problem.code.flash = 1 << 20;
    const Solution found = solved(problem);
    const std::vector<RealMatrix>& table = found.estimator->L_schedule;
    expect_rounded(solved(steady).estimator->L, found.estimator->L, "L");
    TEST_ASSERT_GREATER_THAN(5, table.size());
    bool differs = false;
    for (Index i = 0; i < table.back().size(); ++i) {
      const Real &a = table.back().data()[i], &b = found.estimator->L.data()[i];
      differs =
          differs || (real == lqg::design::Scalar::float32 ? to_float(a) != to_float(b) : to_double(a) != to_double(b));
    }
    TEST_ASSERT_TRUE(differs);
    problem.estimator->horizon = static_cast<int>(table.size()) + 1;
    const RealMatrix next = solved(problem).estimator->L;
    for (Index i = 0; i < next.size(); ++i)
      if (real == lqg::design::Scalar::float32)
        TEST_ASSERT_TRUE(to_float(next.data()[i]) == to_float(found.estimator->L.data()[i]));
  }
}

// No noise drives the second state: its gain is 0 in the end, and before that a power of 0.3 that no double ends.
void test_schedule_ends_where_a_steady_gain_is_zero() {
  Problem problem = estimator_alone(problem_of(Domain::discrete, 1, (MatrixXd(2, 2) << 1.5, 0.1, 0, 0.3).finished(),
                                               Eigen::Vector2d(1, 0), Eigen::RowVector2d(1, 0)));
  problem.estimator->W.setZero();
  problem.estimator->gain = Gain::schedule;
  problem.code.flash = 1 << 20;
  for (const lqg::design::Scalar real : {lqg::design::Scalar::float32, lqg::design::Scalar::float64}) {
    problem.code.real = real;
    const Solution found = solved(problem);
    TEST_ASSERT_TRUE(to_double(found.estimator->L(1, 0)) == 0);
    TEST_ASSERT_LESS_THAN(100, found.estimator->L_schedule.size());
  }
}

void test_schedule_that_does_not_fit_into_flash_is_refused() {
  Problem problem = estimator_alone(two_mass());
  problem.estimator->gain = Gain::schedule;
  problem.code.flash = 64;
  TEST_ASSERT_TRUE(is_refused(problem, "kalman.gain", "after 1 samples"));
}

void test_schedule_goes_through_the_stages() {
  Problem problem = estimator_alone(two_mass());
  problem.estimator->gain = Gain::schedule;
  problem.code.flash = 1 << 20;
  Stage stage;
  stage.from = 30;
  stage.V = MatrixXd::Identity(2, 2);
  problem.stages = {stage};
  Problem later = estimator_alone(two_mass());
  later.estimator->V = stage.V;
  const Solution found = solved(problem);
  expect_rounded(solved(later).estimator->L, found.estimator->L, "L");
  TEST_ASSERT_GREATER_THAN(30, found.estimator->L_schedule.size());
  TEST_ASSERT_TRUE(found.stages[0].noise->V(0, 0) == 1 && found.noise->V(0, 0) < 1);
}

// V changes at step 20 and W at step 40: from there on both have.
void test_a_stage_keeps_what_the_one_before_has_changed() {
  Problem problem = estimator_alone(two_mass());
  problem.estimator->gain = Gain::schedule;
  problem.code.flash = 1 << 20;
  Stage first, second;
  first.from = 20;
  first.V = MatrixXd::Identity(2, 2);
  second.from = 40;
  second.W = 9 * problem.estimator->W;
  problem.stages = {first, second};
  Problem later = estimator_alone(two_mass());
  later.estimator->V = first.V;
  later.estimator->W = second.W;
  const Solution found = solved(problem);
  expect_rounded(solved(later).estimator->L, found.estimator->L, "L");
  TEST_ASSERT_TRUE(found.stages[1].noise->V(0, 0) == 1);
}

void test_steady_gain_and_stages_of_the_filter_exclude_each_other() {
  Problem problem = estimator_alone(two_mass());
  Stage stage;
  stage.from = 3;
  stage.W = MatrixXd::Constant(1, 1, 1);
  problem.stages = {stage};
  TEST_ASSERT_TRUE(is_refused(problem, "kalman.gain", "stages change the filter"));
}

// A bias that no noise drives has no steady filter; on line its variance tends to 0.
void test_online_filter_of_a_constant_bias_needs_no_steady_one() {
  Problem problem = double_integrator(0.1);
  problem.plant.A = (MatrixXd(3, 3) << 0, 1, 0, 0, 0, 0, 0, 0, 0).finished();
  problem.plant.B = (MatrixXd(3, 1) << 0, 1, 0).finished();
  problem.plant.C = (MatrixXd(1, 3) << 1, 0, 1).finished();
  problem.plant.C = (MatrixXd(2, 3) << 1, 0, 1, 1, 0, 0).finished();
  problem.plant.D = MatrixXd::Zero(2, 1);
  problem.plant.G = (MatrixXd(3, 1) << 0, 1, 0).finished();
  problem.plant.H = MatrixXd::Zero(2, 1);
  problem.plant.states.push_back({"bias", ""});
  problem.regulator.reset();
  problem.estimator->W = MatrixXd::Identity(1, 1);
  problem.estimator->V = MatrixXd::Identity(2, 2);
  problem.estimator->Swv = MatrixXd::Zero(1, 2);
  problem.estimator->x0 = Eigen::Vector3d::Zero();
  problem.estimator->P0 = MatrixXd::Identity(3, 3);
  TEST_ASSERT_TRUE(is_refused(problem, "kalman.process_noise", "bias"));
  problem.estimator->gain = Gain::online;
  Findings findings;
  const std::optional<Solution> found = solve(problem, findings);
  TEST_ASSERT_TRUE(found && found->online && !found->estimator && found->noise);
  TEST_ASSERT_EQUAL(1, findings.size());
  TEST_ASSERT_TRUE(findings[0].severity == Severity::note);
}

// --- set point --------------------------------------------------------------------------------------------------

// The loop at rest under r: ζ = Aζ + push r.
void test_tracked_outputs_come_to_rest_at_r() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Index nx = 2 + static_cast<Index>(seed % 3);
    Problem problem = regulator_alone(
        problem_of(Domain::continuous, 0.2, random.matrix(nx, nx), random.matrix(nx, 2), random.matrix(2, nx)));
    problem.plant.D = random.matrix(2, 2);
    problem.regulator->track = seed % 2 == 0 ? std::vector<int>{1} : std::vector<int>{0, 1};
    if (seed % 3 == 0) problem.plant.delay = 0.25;
    if (seed % 5 == 0) problem.regulator->input_rate = MatrixXd::Identity(2, 2);
    if (seed % 4 == 0) problem.regulator->integral = Integral{{1}, MatrixXd::Constant(1, 1, 1)};
    const Solution found = solved(problem);
    const Digits scope(60);
    const RegulatedPlant plant = regulated_plant(problem, found.plant);
    const RegulatorSolution& lqr = *found.regulator;
    const Index nz = plant.A.rows(), states = found.plant.A.rows(), integrals = seed % 4 == 0 ? 1 : 0;
    RealMatrix push = multiply(plant.B, lqr.Nbar);
    const std::vector<int> outputs = reference_outputs(problem);
    for (Index j = 0; integrals > 0 && j < push.cols(); ++j)
      if (outputs[static_cast<std::size_t>(j)] == 1) push(states, j) += Real(problem.plant.sample_time);
    const RealMatrix at_rest = *solve(identity(nz) - plant.A + multiply(plant.B, lqr.K), push);
    const RealMatrix u = seed % 5 == 0
                             ? RealMatrix(at_rest.bottomRows(2))
                             : RealMatrix(multiply(lqr.Nbar, identity(push.cols())) - multiply(lqr.K, at_rest));
    const RealMatrix y = multiply(found.plant.C, at_rest.topRows(states)) + multiply(found.plant.D, u);
    for (const int output : problem.regulator->track)
      for (Index j = 0; j < y.cols(); ++j)
        expect_small(abs(y(output, j) - (outputs[static_cast<std::size_t>(j)] == output ? 1 : 0)), 1e-10, "y − r");
  }
}

// Masses that rest wherever they are: u is 0, exactly.
void test_set_point_that_needs_no_input_has_an_exact_zero() {
  Problem problem = regulator_alone(two_mass());
  problem.regulator->track = {1};
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(is_zero(found.regulator->Nu) && found.regulator->Nx(1, 0).is_zero());
  for (const Index position : {0, 2}) TEST_ASSERT_TRUE(to_double(found.regulator->Nx(position, 0)) == 1);
}

// Two inputs that do the same: the one that costs a quarter does four fifths.
void test_set_point_of_many_takes_the_least_input() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = regulator_alone(problem_of(Domain::discrete, 1, 0.5 * one, MatrixXd::Constant(1, 2, 1), one));
  problem.regulator->R = Eigen::Vector2d(1, 4).asDiagonal();
  problem.regulator->track = {0};
  const Solution found = solved(problem);
  const Digits scope(60);
  expect_small(abs(found.regulator->Nu(0, 0) - Real(4) / 10), 1e-16, "u0");
  expect_small(abs(found.regulator->Nu(1, 0) - Real(1) / 10), 1e-16, "u1");
}

// ẋ = −x₀ + u₀, −2 x₁ + u₁ rest at x = (u₀, u₁/2), whatever the samples' own R is: with y = x₀ + x₁ = r the least
// u₀² + u₁² has u = (0.8, 0.4) r. A delay changes nothing of it.
void test_set_point_takes_the_least_input_by_the_R_of_the_file() {
  Problem problem = regulator_alone(problem_of(Domain::continuous, 0.5, Eigen::Vector2d(-1, -2).asDiagonal(),
                                               MatrixXd::Identity(2, 2), Eigen::RowVector2d(1, 1)));
  problem.regulator->Q = Eigen::Vector2d(100, 0).asDiagonal();
  problem.regulator->track = {0};
  for (const double delay : {0.0, 0.75}) {
    problem.plant.delay = delay;
    const Solution found = solved(problem);
    const Digits scope(60);
    expect_small(abs(found.regulator->Nu(0, 0) - Real(8) / 10), 1e-16, "u0");
    expect_small(abs(found.regulator->Nu(1, 0) - Real(4) / 10), 1e-16, "u1");
  }
}

// x and the sum of both states, of which the second has no input.
void test_tracked_outputs_that_one_input_moves_together_are_refused() {
  Problem problem =
      regulator_alone(problem_of(Domain::discrete, 1, Eigen::Vector2d(0.5, 0.25).asDiagonal(),
                                 (MatrixXd(2, 2) << 1, 2, 0, 0).finished(), (MatrixXd(2, 2) << 1, 0, 1, 1).finished()));
  problem.regulator->track = {0, 1};
  TEST_ASSERT_TRUE(is_refused(problem, "lqr.track", "the inputs do not move these outputs independently"));
}

void test_set_points_that_do_not_exist_are_refused_with_the_reason() {
  Problem problem = regulator_alone(two_mass());
  problem.regulator->track = {0, 1};
  TEST_ASSERT_TRUE(is_refused(problem, "lqr.track", "1 input cannot hold 2 outputs"));
  problem.regulator->track = {0};
  problem.plant.C.row(0) << 0, 1, 0, 0;  // a speed
  TEST_ASSERT_TRUE(is_refused(problem, "lqr.track", "zero at z = 1"));
  problem.plant.B = MatrixXd::Identity(4, 2);
  problem.plant.D = MatrixXd::Zero(2, 2);
  problem.plant.C.row(0) = -2 * problem.plant.C.row(1);
  problem.regulator->R = MatrixXd::Identity(2, 2);
  problem.regulator->N = MatrixXd::Zero(4, 2);
  problem.regulator->track = {0, 1};
  TEST_ASSERT_TRUE(is_refused(problem, "lqr.track", "depend on each other"));
}

void test_integral_of_a_speed_is_refused_with_the_reason() {
  Problem problem = regulator_alone(two_mass());
  problem.plant.C.row(0) << 0, 1, 0, 0;
  problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 1)};
  TEST_ASSERT_TRUE(is_refused(problem, "lqr.integral", "zero at z = 1"));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_cost_to_go_is_what_the_gains_cost_and_no_others_cost_less);
  RUN_TEST(test_long_horizon_begins_with_the_steady_gain);
  RUN_TEST(test_continuous_gains_of_an_integrator_are_hyperbolic_tangents);
  RUN_TEST(test_continuous_gains_do_not_depend_on_the_periods_between);
  RUN_TEST(test_continuous_cost_to_go_obeys_the_differential_equation);
  RUN_TEST(test_stages_of_an_endless_problem_end_in_the_gain_of_the_last);
  RUN_TEST(test_stages_that_change_nothing_change_no_gain);
  RUN_TEST(test_input_that_acts_after_the_end_stays_0);
  RUN_TEST(test_horizon_needs_no_stabilisable_plant);
  RUN_TEST(test_scheduled_gains_of_a_constant_average_what_was_seen);
  RUN_TEST(test_scheduled_gains_are_those_of_the_information_filter);
  RUN_TEST(test_schedule_ends_where_the_gains_round_to_the_steady_ones);
  RUN_TEST(test_schedule_ends_where_a_steady_gain_is_zero);
  RUN_TEST(test_schedule_that_does_not_fit_into_flash_is_refused);
  RUN_TEST(test_schedule_goes_through_the_stages);
  RUN_TEST(test_a_stage_keeps_what_the_one_before_has_changed);
  RUN_TEST(test_steady_gain_and_stages_of_the_filter_exclude_each_other);
  RUN_TEST(test_online_filter_of_a_constant_bias_needs_no_steady_one);
  RUN_TEST(test_tracked_outputs_come_to_rest_at_r);
  RUN_TEST(test_set_point_that_needs_no_input_has_an_exact_zero);
  RUN_TEST(test_set_point_of_many_takes_the_least_input);
  RUN_TEST(test_set_point_takes_the_least_input_by_the_R_of_the_file);
  RUN_TEST(test_tracked_outputs_that_one_input_moves_together_are_refused);
  RUN_TEST(test_set_points_that_do_not_exist_are_refused_with_the_reason);
  RUN_TEST(test_integral_of_a_speed_is_refused_with_the_reason);
  return UNITY_END();
}
