// The simulation: its noise, its filters and laws against what the design says of them.
#include <algorithm>
#include <cmath>

#include <unity.h>

#include "design/defaults.hpp"
#include "design/rounding.hpp"
#include "design/simulation.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const double sigmas = 5;        // a right result fails one time in two million
const double rounding = 1e-11;  // of some hundred samples in double, less condition

MatrixXd in_double(const RealMatrix& a) {
  MatrixXd result(a.rows(), a.cols());
  for (Eigen::Index i = 0; i < a.size(); ++i) result.data()[i] = to_double(a.data()[i]);
  return result;
}

SimulationOptions options_of(int samples, std::uint64_t seed) {
  SimulationOptions options;
  options.samples = samples;
  options.seed = seed;
  return options;
}

void expect_within(double bound, double expected, double found, const char* what) {
  TEST_ASSERT_TRUE_MESSAGE(std::abs(found - expected) <= bound, what);
}

// Every entry of the columns' mean square within `sigmas` of `expected`, where
// Var Ĉij = Σ_τ (Cii(τ) Cjj(τ) + Cij(τ) Cji(τ))/N and C(τ) = F^|τ| C: N samples of e⁺ = F e + noise.
void expect_covariance(const MatrixXd& columns, const MatrixXd& expected, const MatrixXd& F, const char* what) {
  const double count = static_cast<double>(columns.cols());
  const MatrixXd found = columns * columns.transpose() / count;
  MatrixXd variance = MatrixXd::Zero(expected.rows(), expected.rows()), lag = expected;
  for (int tau = 0; lag.norm() > 1e-12 * expected.norm(); ++tau) {
    for (Eigen::Index i = 0; i < lag.rows(); ++i)
      for (Eigen::Index j = 0; j < lag.rows(); ++j)
        variance(i, j) += (tau == 0 ? 1 : 2) * (lag(i, i) * lag(j, j) + lag(i, j) * lag(j, i)) / count;
    lag = F * lag;
  }
  for (Eigen::Index i = 0; i < found.rows(); ++i)
    for (Eigen::Index j = 0; j < found.rows(); ++j)
      expect_within(sigmas * std::sqrt(std::max(variance(i, j), 0.0)), expected(i, j), found(i, j), what);
}

Problem regulator_alone(Problem problem) {
  problem.estimator.reset();
  return problem;
}

// --- noise ------------------------------------------------------------------------------------------------------

// The first numbers of splitmix64 from 1234567, as rosettacode.org/wiki/Pseudo-random_numbers/Splitmix64 has them.
void test_uniform_numbers_are_those_of_splitmix64() {
  NoiseSource source(1234567);
  for (const std::uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u})
    TEST_ASSERT_TRUE(source.uniform() == std::ldexp(static_cast<double>(expected >> 12) + 0.5, -52));
}

// The fourth cumulant of twelve uniform numbers is −12/120: Var of the mean square is (2 − 0.1)/N.
void test_normal_numbers_have_mean_0_and_variance_1() {
  const int count = 100000;
  NoiseSource source(7);
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double number = source.normal();
    sum += number;
    squares += number * number;
  }
  expect_within(sigmas / std::sqrt(count), 0, sum / count, "mean");
  expect_within(sigmas * std::sqrt(1.9 / count), 1, squares / count, "variance");
}

void test_one_seed_gives_the_same_bits_and_another_one_others() {
  const Problem problem = two_mass();
  const Solution found = solved(problem);
  const Trajectory first = simulate(problem, found, options_of(50, 3)), again = simulate(problem, found, options_of(50, 3)),
                   other = simulate(problem, found, options_of(50, 4));
  TEST_ASSERT_TRUE(first.x == again.x && first.estimate == again.estimate && first.u == again.u);
  TEST_ASSERT_TRUE(first.y == again.y && first.cost == again.cost);
  TEST_ASSERT_FALSE(first.y == other.y);
}

// What the plant's equations leave of a run, [x⁺ − A x − B u; y − C x], is [G w; v]: white, also with cross noise.
void test_disturbances_have_the_covariance_of_the_design_also_across() {
  Problem problem = two_mass();
  problem.estimator->Swv << 0.001, -0.002;
  const Solution found = solved(problem);
  const int count = 20000;
  const Trajectory run = simulate(problem, found, options_of(count, 11));
  const MatrixXd A = in_double(found.plant.A), B = in_double(found.plant.B), C = in_double(found.plant.C),
                 G = in_double(found.plant.G), W = in_double(found.noise->W), V = in_double(found.noise->V),
                 cross = G * in_double(found.noise->Swv), x = run.x.leftCols(count);
  MatrixXd disturbances(6, count), expected(6, 6);
  disturbances << run.x.rightCols(count) - A * x - B * run.u, run.y - C * x;
  expected << G * W * G.transpose(), cross, cross.transpose(), V;
  expect_covariance(disturbances, expected, MatrixXd::Zero(6, 6), "covariance of [G w; v]");
}

// --- estimates --------------------------------------------------------------------------------------------------

// Of the last `count` samples, when nothing is left of the start.
MatrixXd late_errors(const Trajectory& run, int count) {
  const Eigen::Index samples = run.estimate.cols();
  return (run.estimate - run.x.leftCols(samples)).rightCols(count);
}

// e⁺ = (I − L C) A e + noise
void test_errors_of_the_filter_have_the_posterior_covariance() {
  const Problem problem = two_mass();
  const Solution found = solved(problem);
  const EstimatorSolution& filter = *found.estimator;
  const MatrixXd F = (MatrixXd::Identity(4, 4) - in_double(filter.L) * in_double(found.plant.C))
                     * in_double(found.plant.A);
  const Trajectory run = simulate(problem, found, options_of(20500, 5));
  expect_covariance(late_errors(run, 20000), in_double(filter.P_posterior), F, "posterior covariance");
}

// e⁺ = (A − L_predictor C) e + noise
void test_errors_of_the_predictor_have_the_prior_covariance_also_with_cross_noise() {
  Problem problem = two_mass();
  problem.estimator->form = Form::predictor;
  problem.estimator->Swv << 0.001, -0.002;
  const Solution found = solved(problem);
  const EstimatorSolution& filter = *found.estimator;
  const MatrixXd F = in_double(found.plant.A) - in_double(filter.L_predictor) * in_double(found.plant.C);
  const Trajectory run = simulate(problem, found, options_of(20500, 6));
  expect_covariance(late_errors(run, 20000), in_double(filter.P_prior), F, "prior covariance");
}

// A schedule holds the gains that the covariance on line leads to.
void test_covariance_on_line_gives_the_estimates_of_the_schedule_also_with_cross_noise() {
  Problem problem = two_mass();
  problem.estimator->V << 0.001, 0.0004, 0.0004, 0.002;
  problem.estimator->Swv << 0.001, -0.002;
  problem.estimator->gain = Gain::online;
  const Solution online = solved(problem);
  const Trajectory carried = simulate(problem, online, options_of(100, 8));
  problem.estimator->gain = Gain::schedule;
  problem.estimator->horizon = 100;
  const Solution schedule = solved(problem);
  const Trajectory held = simulate(problem, schedule, options_of(100, 8));
  expect_within(rounding, 0, (carried.estimate - held.estimate).norm() / held.estimate.norm(), "estimates");
}

void test_estimator_alone_knows_the_input_that_is_given() {
  Problem problem = two_mass();
  problem.regulator.reset();
  problem.estimator->x0 = Eigen::Vector4d(1, 0, 2, 0);
  SimulationOptions options = options_of(100, 1);
  options.noise = false;
  options.x0 = problem.estimator->x0;
  options.input = [](int k) { return VectorXd::Constant(1, std::sin(0.1 * k)); };
  const Trajectory run = simulate(problem, solved(problem), options);
  TEST_ASSERT_TRUE(run.u(0, 10) == std::sin(1.0));
  expect_within(rounding, 0, late_errors(run, 100).norm() / run.x.norm(), "estimates of a plant without noise");
}

// --- control ----------------------------------------------------------------------------------------------------

// u[k] = −K[k] x[k] in time, and the whole costs what the design says: x₀ᵀ X0 x₀, X0 of step 0.
void test_gains_of_a_horizon_are_used_in_time_and_cost_what_the_design_says() {
  Problem problem = regulator_alone(two_mass());
  problem.regulator->horizon = 15;
  problem.regulator->Q_final = 3 * MatrixXd::Identity(4, 4);
  const Solution found = solved(problem);
  SimulationOptions options = options_of(15, 1);
  options.x0 = Eigen::Vector4d(1, -1, 0.5, 2);
  const Trajectory run = simulate(problem, found, options);
  for (int k = 0; k < 15; ++k) {
    const double u = (-in_double(found.regulator->K_schedule[static_cast<std::size_t>(k)]) * run.x.col(k))(0);
    expect_within(rounding, u, run.u(0, k), "u");
  }
  const double end = run.x.col(15).dot(in_double(found.regulator->Q_final) * run.x.col(15));
  const double expected = options.x0.dot(in_double(found.regulator->X0) * options.x0);
  expect_within(rounding * expected, expected, run.cost.sum() + end, "cost");
}

// x₀ᵀ X x₀ is the cost for ever; after 400 samples nothing is left.
void test_regulator_for_ever_costs_what_the_design_says() {
  const Problem problem = regulator_alone(two_mass());
  const Solution found = solved(problem);
  SimulationOptions options = options_of(400, 1);
  options.x0 = Eigen::Vector4d(1, -1, 0.5, 2);
  const double expected = options.x0.dot(in_double(found.regulator->X) * options.x0);
  expect_within(rounding * expected, expected, simulate(problem, found, options).cost.sum(), "cost");
}

// The standard error comes from the spread of the means of 50 parts, each much longer than the loop's memory.
void test_cost_of_the_loop_is_the_cost_per_sample_of_the_design() {
  const Problem problem = two_mass();
  const Solution found = solved(problem);
  const int parts = 50, length = 1000;
  const VectorXd cost = simulate(problem, found, options_of(parts * length + 500, 9)).cost.tail(parts * length);
  const VectorXd means = Eigen::Map<const MatrixXd>(cost.data(), length, parts).colwise().mean().transpose();
  const double mean = means.mean();
  const double error = std::sqrt((means.array() - mean).square().sum() / (parts * (parts - 1.0)));
  const double expected = *found.loop.cost_per_sample;
  TEST_ASSERT_TRUE_MESSAGE(sigmas * error < 0.1 * expected, "a run that says little");
  expect_within(sigmas * error, expected, mean, "cost per sample");
}

// A stage that changes plant and weights: the cost is still that of the design, which knows it beforehand.
void test_stages_change_plant_and_weights_in_time() {
  Problem problem = regulator_alone(two_mass());
  problem.plant.domain = Domain::discrete;
  problem.plant.A = in_double(solved(two_mass()).plant.A);
  problem.plant.G = MatrixXd::Identity(4, 4);
  problem.plant.H = MatrixXd::Zero(2, 4);
  problem.regulator->cost = Cost::discrete;
  problem.regulator->horizon = 12;
  problem.regulator->Q_final = MatrixXd::Identity(4, 4);
  Stage stage;
  stage.from = 5;
  stage.A = 0.5 * problem.plant.A;
  stage.Q = 7 * problem.regulator->Q;
  problem.stages = {stage};
  const Solution found = solved(problem);
  SimulationOptions options = options_of(12, 1);
  options.x0 = Eigen::Vector4d(1, -1, 0.5, 2);
  const Trajectory run = simulate(problem, found, options);
  const double expected = options.x0.dot(in_double(found.regulator->X0) * options.x0);
  expect_within(rounding * expected, expected, run.cost.sum() + run.x.col(12).squaredNorm(), "cost");
}

void test_integral_brings_the_output_to_r_and_limits_hold() {
  Problem problem = double_integrator(0.1);
  problem.regulator->integral = Integral{{0}, MatrixXd::Identity(1, 1)};
  Limits limits;
  limits.u_min = VectorXd::Constant(1, -0.08);
  limits.u_max = VectorXd::Constant(1, 0.1);
  limits.u_rate = VectorXd::Constant(1, 0.3);
  problem.limits = limits;
  SimulationOptions options = options_of(600, 1);
  options.noise = false;
  options.r = VectorXd::Constant(1, 0.5);
  const Trajectory run = simulate(problem, solved(problem), options);
  expect_within(1e-6, 0.5, run.x(0, 600), "x of the last sample");
  TEST_ASSERT_TRUE(run.u.minCoeff() == -0.08 && run.u.maxCoeff() == 0.1);
  const MatrixXd steps = run.u.rightCols(599) - run.u.leftCols(599);
  expect_within(rounding, 0.03, steps.cwiseAbs().maxCoeff(), "the largest step of u");
}

// --- defaults ---------------------------------------------------------------------------------------------------

void test_defaults_are_those_of_the_design_file() {
  const Problem full = double_integrator(0.1);
  Problem bare;
  bare.plant.sample_time = 0.1;
  bare.plant.A = full.plant.A;
  bare.plant.B = full.plant.B;
  bare.plant.C = full.plant.C;
  bare.regulator.emplace();
  bare.regulator->Q = full.regulator->Q;
  bare.regulator->R = full.regulator->R;
  bare.estimator.emplace();
  bare.estimator->W = full.estimator->W;
  bare.estimator->V = full.estimator->V;
  const Solution expected = solved(full), found = solved(with_defaults(bare));
  expect_rounded(expected.regulator->K, found.regulator->K, "K");
  expect_rounded(expected.estimator->L, found.estimator->L, "L");
}

void test_defaults_leave_alone_what_is_given() {
  Problem problem = two_mass();
  problem.estimator->P0 *= 5;
  const Problem found = with_defaults(problem);
  TEST_ASSERT_TRUE(found.estimator->P0 == problem.estimator->P0 && found.plant.G == problem.plant.G);
  TEST_ASSERT_TRUE(found.estimator->noise == Noise::discrete && found.regulator->cost == Cost::sampled);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_uniform_numbers_are_those_of_splitmix64);
  RUN_TEST(test_normal_numbers_have_mean_0_and_variance_1);
  RUN_TEST(test_one_seed_gives_the_same_bits_and_another_one_others);
  RUN_TEST(test_disturbances_have_the_covariance_of_the_design_also_across);
  RUN_TEST(test_errors_of_the_filter_have_the_posterior_covariance);
  RUN_TEST(test_errors_of_the_predictor_have_the_prior_covariance_also_with_cross_noise);
  RUN_TEST(test_covariance_on_line_gives_the_estimates_of_the_schedule_also_with_cross_noise);
  RUN_TEST(test_estimator_alone_knows_the_input_that_is_given);
  RUN_TEST(test_gains_of_a_horizon_are_used_in_time_and_cost_what_the_design_says);
  RUN_TEST(test_regulator_for_ever_costs_what_the_design_says);
  RUN_TEST(test_cost_of_the_loop_is_the_cost_per_sample_of_the_design);
  RUN_TEST(test_stages_change_plant_and_weights_in_time);
  RUN_TEST(test_integral_brings_the_output_to_r_and_limits_hold);
  RUN_TEST(test_defaults_are_those_of_the_design_file);
  RUN_TEST(test_defaults_leave_alone_what_is_given);
  return UNITY_END();
}
