// SPDX-License-Identifier: MIT
// The simulation: its noise, its filters and laws against what the design says of them.
#include <algorithm>
#include <cmath>

#include <unity.h>

#include "design/rounding.hpp"
#include "simulate/noise.hpp"
#include "simulate/simulation.hpp"
#include "../design/problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const double sigmas = 5;        // a right result fails one time in two million
const double rounding = 1e-11;  // of some hundred samples in double, less condition

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

// The design's own numbers, for comparisons with it.
Problem in_double(Problem problem) {
  problem.code.real = Scalar::float64;
  return problem;
}

// --- noise ------------------------------------------------------------------------------------------------------

// The first numbers of splitmix64 from 1234567, as rosettacode.org/wiki/Pseudo-random_numbers/Splitmix64 has them.
void test_uniform_numbers_are_those_of_splitmix64() {
  lqg::simulate::Noise source(1234567);
  for (const std::uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u})
    TEST_ASSERT_TRUE(source.uniform() == std::ldexp(static_cast<double>(expected >> 11) + 0.5, -53) - 0.5);
}

// The fourth cumulant of twelve uniform numbers is −12/120: Var of the mean square is (2 − 0.1)/N.
void test_normal_numbers_have_mean_0_and_variance_1() {
  const int count = 100000;
  lqg::simulate::Noise source(7);
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
  const Problem problem = in_double(two_mass());
  const Solution found = solved(problem);
  const Trajectory first = simulate(problem, found, options_of(50, 3)),
                   again = simulate(problem, found, options_of(50, 3)),
                   other = simulate(problem, found, options_of(50, 4));
  TEST_ASSERT_TRUE(first.x == again.x && first.estimate == again.estimate && first.u == again.u);
  TEST_ASSERT_TRUE(first.y == again.y && first.cost == again.cost);
  TEST_ASSERT_FALSE(first.y == other.y);
}

// What the plant's equations leave of a run, [x⁺ − A x − B u; y − C x], is [G w; v]: white, also with cross noise.
void test_disturbances_have_the_covariance_of_the_design_also_across() {
  Problem problem = in_double(two_mass());
  problem.estimator->Swv << 0.001, -0.002;
  const Solution found = solved(problem);
  const int count = 20000;
  const Trajectory run = simulate(problem, found, options_of(count, 11));
  const MatrixXd A = to_doubles(found.plant.A), B = to_doubles(found.plant.B), C = to_doubles(found.plant.C),
                 G = to_doubles(found.plant.G), W = to_doubles(found.noise->W), V = to_doubles(found.noise->V),
                 cross = G * to_doubles(found.noise->Swv), x = run.x.leftCols(count);
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
  const Problem problem = in_double(two_mass());
  const Solution found = solved(problem);
  const EstimatorSolution& filter = *found.estimator;
  const MatrixXd F =
      (MatrixXd::Identity(4, 4) - to_doubles(filter.L) * to_doubles(found.plant.C)) * to_doubles(found.plant.A);
  const Trajectory run = simulate(problem, found, options_of(20500, 5));
  expect_covariance(late_errors(run, 20000), to_doubles(filter.P_posterior), F, "posterior covariance");
}

// e⁺ = (A − L_predictor C) e + noise
void test_errors_of_the_predictor_have_the_prior_covariance_also_with_cross_noise() {
  Problem problem = in_double(two_mass());
  problem.estimator->form = Form::predictor;
  problem.estimator->Swv << 0.001, -0.002;
  const Solution found = solved(problem);
  const EstimatorSolution& filter = *found.estimator;
  const MatrixXd F = to_doubles(found.plant.A) - to_doubles(filter.L_predictor) * to_doubles(found.plant.C);
  const Trajectory run = simulate(problem, found, options_of(20500, 6));
  expect_covariance(late_errors(run, 20000), to_doubles(filter.P_prior), F, "prior covariance");
}

// A schedule holds the gains that the covariance on line leads to.
void test_covariance_on_line_gives_the_estimates_of_the_schedule_also_with_cross_noise() {
  Problem problem = in_double(two_mass());
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
  Problem problem = in_double(two_mass());
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
  Problem problem = in_double(regulator_alone(two_mass()));
  problem.regulator->horizon = 15;
  problem.regulator->Q_final = 3 * MatrixXd::Identity(4, 4);
  const Solution found = solved(problem);
  SimulationOptions options = options_of(15, 1);
  options.x0 = Eigen::Vector4d(1, -1, 0.5, 2);
  const Trajectory run = simulate(problem, found, options);
  for (int k = 0; k < 15; ++k) {
    const double u = (-to_doubles(found.regulator->K_schedule[static_cast<std::size_t>(k)]) * run.x.col(k))(0);
    expect_within(rounding, u, run.u(0, k), "u");
  }
  const double end = run.x.col(15).dot(to_doubles(found.regulator->Q_final) * run.x.col(15));
  const double expected = options.x0.dot(to_doubles(found.regulator->X0) * options.x0);
  expect_within(rounding * expected, expected, run.cost.sum() + end, "cost");
}

// x₀ᵀ X x₀ is the cost for ever; after 400 samples nothing is left.
void test_regulator_for_ever_costs_what_the_design_says() {
  const Problem problem = in_double(regulator_alone(two_mass()));
  const Solution found = solved(problem);
  SimulationOptions options = options_of(400, 1);
  options.x0 = Eigen::Vector4d(1, -1, 0.5, 2);
  const double expected = options.x0.dot(to_doubles(found.regulator->X) * options.x0);
  expect_within(rounding * expected, expected, simulate(problem, found, options).cost.sum(), "cost");
}

// The standard error comes from the spread of the means of 50 parts, each much longer than the loop's memory.
void test_cost_of_the_loop_is_the_cost_per_sample_of_the_design() {
  const Problem problem = in_double(two_mass());
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
  Problem problem = in_double(regulator_alone(two_mass()));
  problem.plant.domain = Domain::discrete;
  problem.plant.A = to_doubles(solved(two_mass()).plant.A);
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
  const double expected = options.x0.dot(to_doubles(found.regulator->X0) * options.x0);
  expect_within(rounding * expected, expected, run.cost.sum() + run.x.col(12).squaredNorm(), "cost");
}

void test_integral_brings_the_output_to_r_and_limits_hold() {
  Problem problem = in_double(double_integrator(0.1));
  problem.regulator->integral = Integral{{0}, MatrixXd::Identity(1, 1)};
  Limits limits;
  limits.u_min = VectorXd::Constant(1, -0.08);
  limits.u_max = VectorXd::Constant(1, 0.1);
  limits.u_rate = VectorXd::Constant(1, 0.3);
  problem.limits = limits;
  SimulationOptions options = options_of(600, 1);
  options.noise = false;
  options.r = VectorXd::Constant(1, 0.5);
  options.x0 = Eigen::Vector2d(3, 0);
  const Trajectory run = simulate(problem, solved(problem), options);
  expect_within(1e-6, 0.5, run.x(0, 600), "x of the last sample");
  TEST_ASSERT_TRUE(run.u.minCoeff() == -0.08 && run.u.maxCoeff() == 0.1);
  const MatrixXd steps = run.u.rightCols(599) - run.u.leftCols(599);
  expect_within(rounding, 0.03, steps.cwiseAbs().maxCoeff(), "the largest step of u");
  TEST_ASSERT_TRUE(run.has(0, lqg::step::Event::input_limited) && !run.has(599, lqg::step::Event::input_limited));
}

// --- faults -----------------------------------------------------------------------------------------------------

void test_missing_output_is_told_and_left_out() {
  const Problem problem = in_double(two_mass());
  const Solution found = solved(problem);
  SimulationOptions options = options_of(200, 1);
  options.sensor = [](int k, VectorXd& y) {
    if (k == 100) y(0) = std::nan("");
  };
  const Trajectory run = simulate(problem, found, options);
  for (int k = 0; k < 200; ++k) TEST_ASSERT_TRUE(run.has(k, lqg::step::Event::output_rejected) == (k == 100));
  TEST_ASSERT_TRUE(run.x.allFinite() && run.u.allFinite() && run.resets == 0);
}

// Until they differ by something: then the gated one stays where it was.
void test_gate_leaves_out_what_is_far_off() {
  Problem problem = in_double(two_mass());
  const auto spike = [](int k, VectorXd& y) {
    if (k == 100) y(0) += 1;  // some 30 σ
  };
  SimulationOptions options = options_of(101, 1);
  options.sensor = spike;
  const Trajectory open = simulate(problem, solved(problem), options);
  problem.estimator->gate = 6;
  const Trajectory gated = simulate(problem, solved(problem), options);
  TEST_ASSERT_TRUE(open.estimate.leftCols(100) == gated.estimate.leftCols(100));
  TEST_ASSERT_TRUE(gated.has(100, lqg::step::Event::output_gated) && !open.has(100, lqg::step::Event::output_gated));
  const double moved = (open.estimate.col(100) - open.x.col(100)).norm();
  TEST_ASSERT_TRUE((gated.estimate.col(100) - gated.x.col(100)).norm() < 0.5 * moved);
}

// In every filter: x̂ is wrong, here because the sensor shows another place from one sample to the next and for ever.
void test_gate_opens_again_when_the_estimate_is_wrong() {
  for (const auto& [gain, covariance] :
       {std::pair(Gain::steady, Covariance::ud), std::pair(Gain::online, Covariance::ud),
        std::pair(Gain::online, Covariance::plain)})
    for (const double moved : {1.0, 1e3, 1e6}) {
      Problem problem = two_mass();
      problem.regulator.reset();
      problem.estimator->gain = gain, problem.estimator->covariance = covariance;
      problem.estimator->gate = 6;
      SimulationOptions options = options_of(2000, 1);
      options.sensor = [moved](int k, VectorXd& y) {
        if (k >= 1000) y.array() += moved;
      };
      const Trajectory run = simulate(problem, solved(problem), options);
      const auto gated = [&](int from, int to) {
        int count = 0;
        for (int k = from; k < to; ++k) count += run.has(k, lqg::step::Event::output_gated);
        return count;
      };
      TEST_ASSERT_EQUAL_INT(0, gated(0, 1000));
      TEST_ASSERT_TRUE(gated(1000, 1003) == 3);
      int first_heard = 1000;
      while (run.has(first_heard, lqg::step::Event::output_gated)) ++first_heard;
      TEST_ASSERT_TRUE(first_heard < 1200);
      TEST_ASSERT_EQUAL_INT(0, gated(1700, 2000));
    }
}

// The gate promises that of honest outputs it leaves out 2 Φ(−3), however wrong the start may be and after any silence,
// though a constant gain knows no S but that of the steady state.
void test_gate_of_a_constant_gain_keeps_its_promise_from_the_start_and_after_silence() {
  const double promised = std::erfc(3 / std::sqrt(2.0));
  const int runs = 500, samples = 60;
  Problem problem = two_mass();
  problem.regulator.reset();
  problem.estimator->gain = Gain::steady;
  problem.estimator->gate = 3;
  problem.estimator->P0 = MatrixXd::Identity(4, 4);
  const Solution found = solved(problem);
  lqg::simulate::Noise start(99);
  int gated = 0;
  for (int run = 0; run < runs; ++run) {
    SimulationOptions options = options_of(samples, static_cast<std::uint64_t>(run + 1));
    options.x0 = VectorXd(4);
    for (double& x : options.x0) x = start.normal();
    options.sensor = [](int k, VectorXd& y) {
      if (k >= 30 && k < 40) y.setConstant(std::nan(""));
    };
    const Trajectory seen = simulate(problem, found, options);
    for (int k = 0; k < samples; ++k) gated += seen.has(k, lqg::step::Event::output_gated);
  }
  const double most = promised * runs * (samples - 10) * 2;
  TEST_ASSERT_TRUE(gated < most + sigmas * std::sqrt(most));
}

// An estimate beyond its bounds, here by an input that no plant could bear.
void test_estimate_beyond_its_bounds_begins_anew_and_is_counted() {
  Problem problem = in_double(two_mass());
  problem.regulator.reset();
  SimulationOptions options = options_of(20, 1);
  options.input = [](int k) { return VectorXd::Constant(1, k == 10 ? 1e300 : 0); };
  options.noise = false;
  const Trajectory run = simulate(problem, solved(problem), options);
  TEST_ASSERT_TRUE(run.has(10, lqg::step::Event::state_reset) && run.resets >= 1);
  TEST_ASSERT_TRUE(run.estimate.allFinite());
}

// --- what the target makes of it --------------------------------------------------------------------------------

void test_numbers_are_those_of_the_target() {
  Problem problem = two_mass();
  problem.code.real = Scalar::float32;
  const Trajectory run = simulate(problem, solved(problem), options_of(50, 1));
  for (const MatrixXd* shown : {&run.u, &run.y, &run.estimate})
    for (Eigen::Index i = 0; i < shown->size(); ++i)
      TEST_ASSERT_TRUE(static_cast<double>(static_cast<float>(shown->data()[i])) == shown->data()[i]);
}

void test_forms_that_keep_z_show_the_same_loop() {
  Problem problem = in_double(two_mass());
  const Solution found = solved(problem);
  const Trajectory physical = simulate(problem, found, options_of(200, 1));
  for (const Realisation form : {Realisation::folded, Realisation::modal}) {
    problem.code.realisation = form;
    const Trajectory run = simulate(problem, found, options_of(200, 1));
    expect_within(1e-9 * physical.x.norm(), 0, (run.x - physical.x).norm(), "x");
    expect_within(1e-9 * physical.estimate.norm(), 0, (run.estimate - physical.estimate).norm(), "estimate");
  }
}

void test_modes_of_a_filter_that_carries_P_show_the_same_loop() {
  Problem problem = in_double(two_mass());
  problem.plant.A(0, 0) = problem.plant.A(1, 1) = -0.01;  // a free mass has a pole twice
  problem.estimator->gain = Gain::online;
  const Solution found = solved(problem);
  const Trajectory physical = simulate(problem, found, options_of(200, 1));
  problem.code.realisation = Realisation::modal;
  const Trajectory run = simulate(problem, found, options_of(200, 1));
  expect_within(1e-9 * physical.x.norm(), 0, (run.x - physical.x).norm(), "x");
  expect_within(1e-9 * physical.estimate.norm(), 0, (run.estimate - physical.estimate).norm(), "estimate");
  problem = in_double(double_integrator(0.1));
  problem.estimator->gain = Gain::online;
  problem.code.realisation = Realisation::modal;
  std::string reason;
  try {
    simulate(problem, solved(problem), options_of(1, 1));
  } catch (const std::invalid_argument& error) {
    reason = error.what();
  }
  TEST_ASSERT_TRUE_MESSAGE(reason.find("repeated") != std::string::npos, reason.c_str());
}

// The filter carries its covariance: there is no such z.
void test_form_that_the_design_cannot_have_is_refused_with_its_reason() {
  Problem problem = in_double(two_mass());
  problem.estimator->gain = Gain::online;
  problem.code.realisation = Realisation::folded;
  const Solution found = solved(problem);
  std::string reason;
  try {
    simulate(problem, found, options_of(1, 1));
  } catch (const std::invalid_argument& error) {
    reason = error.what();
  }
  TEST_ASSERT_TRUE_MESSAGE(reason.find("not constant") != std::string::npos, reason.c_str());
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
  RUN_TEST(test_missing_output_is_told_and_left_out);
  RUN_TEST(test_gate_leaves_out_what_is_far_off);
  RUN_TEST(test_gate_opens_again_when_the_estimate_is_wrong);
  RUN_TEST(test_gate_of_a_constant_gain_keeps_its_promise_from_the_start_and_after_silence);
  RUN_TEST(test_estimate_beyond_its_bounds_begins_anew_and_is_counted);
  RUN_TEST(test_numbers_are_those_of_the_target);
  RUN_TEST(test_forms_that_keep_z_show_the_same_loop);
  RUN_TEST(test_modes_of_a_filter_that_carries_P_show_the_same_loop);
  RUN_TEST(test_form_that_the_design_cannot_have_is_refused_with_its_reason);
  return UNITY_END();
}
