// SPDX-License-Identifier: MIT
// Delays, integrals, weights on Δu, decay, and noise from all of its keys: each against another way to the same number.
#include <unity.h>

#include "design/gains/regulator.hpp"
#include "design/loop/compensator.hpp"
#include "design/loop/cost.hpp"
#include "design/rounding.hpp"
#include "design/sampled/augmentation.hpp"
#include "design/sampled/noise.hpp"
#include "design/sampled/weights.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

const double rounding = 1e-30;  // of 100 digits of which solving takes half, less condition

// A continuous random plant whose cost is a sampled integral, with cross terms.
Problem random_sampled_problem(std::uint64_t seed) {
  Random random(seed);
  const Index nx = 1 + static_cast<Index>(seed % 4), nu = 1 + static_cast<Index>(seed % 2);
  Problem problem =
      problem_of(Domain::continuous, 0.3, random.matrix(nx, nx), random.matrix(nx, nu), random.matrix(1, nx));
  const MatrixXd weight = random.semidefinite(nx + nu, nx + nu + 1);
  problem.regulator->Q = weight.topLeftCorner(nx, nx) + MatrixXd::Identity(nx, nx);
  problem.regulator->R = weight.bottomRightCorner(nu, nu) + MatrixXd::Identity(nu, nu);
  problem.regulator->N = weight.topRightCorner(nx, nu) / 8;
  return problem;
}

// --- weights ----------------------------------------------------------------------------------------------------

void test_output_weight_is_the_weight_of_what_the_outputs_make_of_x_and_u() {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Problem problem = random_problem(seed);
    const Index ny = problem.plant.C.rows();
    problem.regulator->Q_output = Random(seed + 77).semidefinite(ny, ny);
    problem.regulator->Q = MatrixXd();
    const Digits scope(60);
    const SampledCost found = weights_of(problem);
    const RealMatrix CD = beside(real(problem.plant.C), real(problem.plant.D));
    const RealMatrix expected = transpose_congruence(CD, real(problem.regulator->Q_output));
    const Index nx = problem.plant.A.rows();
    expect_small(distance(found.Q, expected.topLeftCorner(nx, nx)), rounding, "Q");
    expect_small(distance(found.N - real(problem.regulator->N), expected.topRightCorner(nx, found.R.rows())), rounding,
                 "N");
    expect_small(
        distance(found.R - real(problem.regulator->R), expected.bottomRightCorner(found.R.rows(), found.R.rows())),
        rounding, "R");
  }
}

// 1/0.3² is no double: the weight is the quotient in all digits.
void test_bryson_weights_are_never_rounded_to_double() {
  Problem problem = regulator_alone(double_integrator(0.1));
  Bryson bryson;
  bryson.states = Eigen::Vector2d(0.3, 0.7);
  bryson.inputs = Eigen::VectorXd::Constant(1, 2.1);
  bryson.rho = 0.1;
  problem.regulator->Q = problem.regulator->R = MatrixXd();
  problem.regulator->bryson = bryson;
  const Digits scope(60);
  const SampledCost found = weights_of(problem);
  expect_small(abs(found.Q(0, 0) * Real(0.3) * Real(0.3) - 1), 1e-58, "Q");
  expect_small(abs(found.R(0, 0) * Real(2.1) * Real(2.1) - Real(0.1)), 1e-58, "R");
  TEST_ASSERT_TRUE(solved(problem).regulator.has_value());
}

// --- decay ------------------------------------------------------------------------------------------------------

void test_decay_is_the_design_of_the_plant_scaled_by_it() {
  for (std::uint64_t seed = 3; seed <= 60; seed += 3) {  // discrete ones
    Problem problem = regulator_alone(random_problem(seed)), scaled = problem;
    problem.regulator->decay = 1.25;
    scaled.plant.A *= 1.25;
    scaled.plant.B *= 1.25;
    const Solution found = solved(problem), other = solved(scaled);
    const Digits scope(60);
    // The scaled matrices are rounded to double.
    expect_small(distance(found.regulator->K, other.regulator->K), 1e-8, "K");
    for (const std::complex<double>& pole : found.regulator->poles) TEST_ASSERT_TRUE(std::abs(pole) < 1 / 1.25);
  }
}

void test_settling_time_is_met_by_every_pole() {
  Problem problem = regulator_alone(two_mass());
  problem.regulator->settling_time = 4;
  const Solution sampled = solved(problem);
  for (const std::complex<double>& pole : sampled.regulator->poles)
    TEST_ASSERT_TRUE(std::abs(pole) <= std::pow(0.01, 0.5 / 4));
  problem.regulator->cost = Cost::continuous;
  problem.plant.sample_time = 0.01;
  const Solution continuous = solved(problem);
  for (const std::complex<double>& pole : continuous.regulator->poles)
    TEST_ASSERT_TRUE(std::abs(pole) <= std::pow(0.01, 0.01 / 4) + 1e-3);
}

// --- delay ------------------------------------------------------------------------------------------------------

// A period of many short ones: what acts in each is the old or the new input.
void test_fractional_delay_is_the_sum_over_short_parts() {
  const int parts = 8;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem problem = random_sampled_problem(seed);
    const int old = 1 + static_cast<int>(seed % 7);  // of the parts
    problem.plant.sample_time = 0.5;
    problem.plant.delay = 0.5 * old / parts;
    Problem part = problem;
    part.plant.delay = 0;
    part.plant.sample_time = 0.5 / parts;
    const Digits scope(60);
    const Samples whole = sample(problem), small = sample(part);
    const Index nx = problem.plant.A.rows(), nu = problem.plant.B.cols();
    // z = [x; u[k−1]; u[k]], a weight and a covariance carried through the parts
    RealMatrix moved = identity(nx + 2 * nu), cost = zeros(nx + 2 * nu, nx + 2 * nu), noise = zeros(nx, nx);
    Real between;
    for (int k = 0; k < parts; ++k) {
      const Index at = k < old ? nx : nx + nu;
      RealMatrix seen = zeros(nx + nu, nx + 2 * nu), step = identity(nx + 2 * nu);
      seen.topLeftCorner(nx, nx) = identity(nx);
      seen.block(nx, at, nu, nu) = identity(nu);
      step.topLeftCorner(nx, nx) = small.plant.A;
      step.block(0, at, nx, nu) = small.plant.B;
      const SampledCost& c = small.between->cost;
      const RealMatrix weight = transpose_congruence(seen, above(beside(c.Q, c.N), beside(c.N.transpose(), c.R)));
      between += small.between->noise_cost + trace_of_product(c.Q, noise);
      cost += transpose_congruence(moved, weight);
      moved = multiply(step, moved);
      noise = congruence(small.plant.A, noise) + small.noise->W;
    }
    const SampledCost& found = *whole.cost;
    const RealMatrix together = above(beside(found.Q, found.N), beside(found.N.transpose(), found.R));
    expect_small(distance(whole.plant.A.topRows(nx), moved.topLeftCorner(nx, nx + nu)), rounding, "A");
    expect_small(distance(whole.plant.B.topRows(nx), moved.topRightCorner(nx, nu)), rounding, "B");
    expect_small(distance(together, cost), rounding, "the cost");
    expect_small(distance(whole.noise->W, noise), rounding, "the noise");
    expect_small(abs(whole.between->noise_cost / between - 1), rounding, "the noise's cost");
  }
}

// The residual of the whole Riccati equation of the delayed plant, and the stability of its loop.
void test_delayed_law_solves_the_equation_of_the_whole_state() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem problem = regulator_alone(random_sampled_problem(seed));
    problem.plant.delay = 0.15 * static_cast<double>(seed % 8);  // half periods
    if (seed % 5 == 0)
      problem.regulator->input_rate = MatrixXd::Identity(problem.plant.B.cols(), problem.plant.B.cols());
    if (seed % 3 == 0) problem.regulator->cost = Cost::discrete;
    if (seed % 4 == 0) problem.regulator->decay = 1.1;
    const Solution found = solved(problem);
    const Digits scope(100);
    const Samples samples = sample(problem);
    const RiccatiEquation e = regulator_equation(problem, samples);
    const RealMatrix& X = found.regulator->X;
    const RealMatrix closed = e.A - multiply(e.B, found.regulator->K);
    expect_small(distance(transpose_congruence(closed, X) + step_cost(e, found.regulator->K), X), rounding, "X");
    const RealMatrix XB = multiply(X, e.B), weight = e.R + transpose_multiply(e.B, XB);
    expect_small(distance(multiply(weight, found.regulator->K), transpose_multiply(XB, e.A) + e.N.transpose()),
                 rounding, "K");
    TEST_ASSERT_TRUE(solve_stein(closed, e.Q).has_value());
    TEST_ASSERT_EQUAL(e.A.rows(), found.regulator->poles.size());
  }
}

// K. J. Åström, B. Wittenmark, "Computer-Controlled Systems", 3rd edition, 1997, section 2.3: a double integrator with
// the delay τ has Γ1 = [τ(h − τ/2); τ] of the old input and Γ0 = [(h − τ)²/2; h − τ] of the new one.
void test_delayed_double_integrator_has_the_textbook_matrices() {
  Problem problem = regulator_alone(double_integrator(0.5));
  problem.plant.delay = 0.2;
  const Solution found = solved(problem);
  const Digits scope(60);
  const Real h = 0.5, late = 0.2;
  TEST_ASSERT_TRUE(to_double(found.plant.A(0, 2)) == to_double(late * (h - late / 2)));
  TEST_ASSERT_TRUE(to_double(found.plant.A(1, 2)) == to_double(late));
  TEST_ASSERT_TRUE(to_double(found.plant.B(0, 0)) == to_double((h - late) * (h - late) / 2));
  TEST_ASSERT_TRUE(to_double(found.plant.B(1, 0)) == to_double(h - late) && found.plant.B(2, 0) == 1);
}

// The last line of reference.py.
void test_delay_integral_and_rate_together_have_the_reference_gain() {
  Problem problem = regulator_alone(two_mass());
  problem.plant.delay = 0.7;
  problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 0.75)};
  problem.regulator->input_rate = MatrixXd::Constant(1, 1, 0.2);
  const RealMatrix K = solved(problem).regulator->K;
  const double expected[] = {2.2200599978928235,  2.8996242532084393, -0.045917108296585636, 0.76913549470509812,
                             0.54043952325392364, 1.0159457328862918, -0.48624417247271345,  0.87390218919270723};
  TEST_ASSERT_EQUAL(8, K.cols());
  for (Index i = 0; i < 8; ++i) TEST_ASSERT_TRUE(to_double(K(0, i)) == expected[i]);
}

// Whole periods: K of the plant without delay, of the state as it will be.
void test_whole_delay_predicts_the_state() {
  Problem problem = regulator_alone(double_integrator(0.1)), prompt = problem;
  problem.plant.delay = 0.3;
  const Solution found = solved(problem), without = solved(prompt);
  const Digits scope(60);
  const RealMatrix &A = without.plant.A, &B = without.plant.B;
  const RealMatrix A2 = multiply(A, A), A3 = multiply(A, A2);
  const RealMatrix predict = beside(beside(A3, multiply(A2, B)), beside(multiply(A, B), B));
  expect_small(distance(found.regulator->K, multiply(without.regulator->K, predict)), 1e-14, "K");
}

void test_filter_of_a_delayed_plant_leaves_the_known_inputs_alone() {
  Problem problem = two_mass(), prompt = problem;
  problem.plant.delay = 0.7;
  problem.estimator->gain = Gain::online;
  const Solution found = solved(problem), without = solved(prompt);
  TEST_ASSERT_EQUAL(6, found.plant.A.rows());
  const Digits scope(60);
  TEST_ASSERT_TRUE(is_zero(found.estimator->L.bottomRows(2)) && is_zero(found.online->P0.bottomRows(2)));
  expect_small(distance(found.estimator->L.topRows(4), without.estimator->L), 1e-14, "L");
  TEST_ASSERT_EQUAL(12, found.loop.poles.size());
}

void test_delayed_D_is_part_of_C() {
  Problem problem = two_mass();
  problem.plant.D(1, 0) = 0.25;
  problem.plant.delay = 0.5;
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(is_zero(found.plant.D));
  TEST_ASSERT_TRUE(found.plant.C(1, 4) == 0.25 && found.plant.C(0, 4) == 0);
}

// --- integrals and Δu -------------------------------------------------------------------------------------------

void test_integral_action_leaves_no_error_under_a_constant_disturbance() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem problem = random_sampled_problem(seed);
    problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 2)};
    if (seed % 2 == 0)
      problem.regulator->input_rate = MatrixXd::Identity(problem.plant.B.cols(), problem.plant.B.cols());
    if (seed % 3 == 0) problem.plant.delay = 0.4;
    if (seed % 4 == 0) problem.estimator->form = Form::predictor;
    const Solution found = solved(problem);
    const Digits scope(60);
    const ClosedLoop loop = closed_loop(measured_plant(problem, found.plant), compensator(problem, found));
    const Index all = loop.A.rows(), nx = problem.plant.A.rows();
    RealMatrix push = zeros(all, 1);
    push.topRows(nx) = real(Random(seed).matrix(nx, 1));
    const RealMatrix at_rest = *solve(identity(all) - loop.A, push);
    expect_small(abs(multiply(found.plant.C, at_rest.topRows(found.plant.A.rows()))(0, 0)), 1e-12, "y");
  }
}

// The two ways to the steady cost: through white innovations, and through all states of plant and controller.
void test_cost_of_the_optimal_filter_is_that_of_any_controller() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem problem = random_problem(seed);
    const bool continuous = problem.plant.domain == Domain::continuous;
    if (continuous && problem.regulator->cost != Cost::continuous)
      problem.plant.delay = problem.plant.sample_time * 0.375 * static_cast<double>(seed % 4);
    if (seed % 3 == 1 && problem.plant.D.isZero(0))
      problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 2)};
    const Solution found = solved(problem);
    const Digits scope(60);
    const Samples samples = sample(problem);
    const std::optional<SteadyCost> any = steady_cost(problem, samples, compensator(problem, found));
    TEST_ASSERT_TRUE(any.has_value());
    expect_small(abs(any->per_sample / *found.loop.cost_per_sample - 1), 1e-14, "the difference");
    if (any->per_second)
      expect_small(abs(*any->per_second / *found.loop.cost_per_second - 1), 1e-14, "the difference per second");
  }
}

void test_poles_of_the_loop_are_those_of_its_matrix() {
  Problem problem = two_mass();
  problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 0.5)};
  problem.regulator->input_rate = MatrixXd::Constant(1, 1, 0.2);
  problem.plant.delay = 0.3;
  const Solution found = solved(problem);
  const Digits scope(60);
  std::vector<ComplexReal> left =
      eigenvalues(closed_loop(measured_plant(problem, found.plant), compensator(problem, found)).A);
  TEST_ASSERT_EQUAL(left.size(), found.loop.poles.size());
  for (const std::complex<double>& pole : found.loop.poles) {
    Real nearest = 1;
    for (const ComplexReal& other : left)
      nearest = std::min<Real>(nearest, hypot(other.re - pole.real(), other.im - pole.imag()));
    expect_small(nearest, 1e-9, "the distance of a pole");
  }
}

// With a heavy weight on ξ and none on Δu: without S the law is that of u itself.
void test_weight_on_the_rate_of_zero_is_no_weight() {
  Problem problem = regulator_alone(two_mass()), free = problem;
  problem.regulator->input_rate = MatrixXd::Zero(1, 1);
  const Solution with = solved(problem), without = solved(free);
  const Digits scope(60);
  expect_small(distance(with.regulator->K.leftCols(4), without.regulator->K), 1e-14, "K");
  expect_small(abs(with.regulator->K(0, 4) - 1), 1e-30, "the gain of u[k−1], less 1,");
}

// --- noise ------------------------------------------------------------------------------------------------------

// y = x + H w + v: what w adds to the output is noise of the output that w tells of.
void test_disturbance_that_is_measured_too_is_correlated_noise() {
  Problem problem = two_mass();
  problem.plant.H = (MatrixXd(2, 1) << 0.5, -1).finished();
  problem.estimator->Swv = (MatrixXd(1, 2) << 0.001, 0.002).finished();
  const Digits scope(60);
  const SampledNoise found = noise_of(problem);
  const RealMatrix H = real(problem.plant.H), W = real(problem.estimator->W), S = real(problem.estimator->Swv);
  const RealMatrix w_v = above(beside(W, S), beside(S.transpose(), real(problem.estimator->V)));
  const RealMatrix outputs = above(beside(identity(1), zeros(1, 2)), beside(H, identity(2)));
  const RealMatrix joint = congruence(outputs, w_v);  // of [w; H w + v]
  expect_small(distance(joint.bottomRightCorner(2, 2), found.V), 1e-55, "V");
  expect_small(distance(joint.topRightCorner(1, 2), found.Swv), 1e-55, "Swv");
  TEST_ASSERT_TRUE(solved(problem).estimator.has_value());
}

// No v at all, and two outputs that w reaches differently.
void test_H_alone_can_make_the_measurement_noise_definite() {
  Problem problem = two_mass();
  problem.plant.G = (MatrixXd(4, 2) << 0, 0, 1, 0, 0, 0, 0, 0).finished();
  problem.plant.H = (MatrixXd(2, 2) << 0, 1, 1, 2).finished();
  problem.estimator->W = MatrixXd::Identity(2, 2);
  problem.estimator->V = MatrixXd::Zero(2, 2);
  problem.estimator->Swv = MatrixXd::Zero(2, 2);
  TEST_ASSERT_TRUE(solved(problem).estimator.has_value());
}

void test_correlation_time_makes_a_density_of_a_variance() {
  Problem problem = double_integrator(0.1), direct = problem;
  problem.estimator->W << 2, 0.5, 0.5, 3;
  problem.estimator->process_correlation_time = Eigen::Vector2d(0.5, 2);
  direct.estimator->W << 2, 1, 1, 12;  // 2τ of each, 2√(0.5·2) across
  const Solution found = solved(problem), expected = solved(direct);
  expect_rounded(expected.estimator->L, found.estimator->L, "L");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_output_weight_is_the_weight_of_what_the_outputs_make_of_x_and_u);
  RUN_TEST(test_bryson_weights_are_never_rounded_to_double);
  RUN_TEST(test_decay_is_the_design_of_the_plant_scaled_by_it);
  RUN_TEST(test_settling_time_is_met_by_every_pole);
  RUN_TEST(test_fractional_delay_is_the_sum_over_short_parts);
  RUN_TEST(test_delayed_law_solves_the_equation_of_the_whole_state);
  RUN_TEST(test_delayed_double_integrator_has_the_textbook_matrices);
  RUN_TEST(test_delay_integral_and_rate_together_have_the_reference_gain);
  RUN_TEST(test_whole_delay_predicts_the_state);
  RUN_TEST(test_filter_of_a_delayed_plant_leaves_the_known_inputs_alone);
  RUN_TEST(test_delayed_D_is_part_of_C);
  RUN_TEST(test_integral_action_leaves_no_error_under_a_constant_disturbance);
  RUN_TEST(test_cost_of_the_optimal_filter_is_that_of_any_controller);
  RUN_TEST(test_poles_of_the_loop_are_those_of_its_matrix);
  RUN_TEST(test_weight_on_the_rate_of_zero_is_no_weight);
  RUN_TEST(test_disturbance_that_is_measured_too_is_correlated_noise);
  RUN_TEST(test_H_alone_can_make_the_measurement_noise_definite);
  RUN_TEST(test_correlation_time_makes_a_density_of_a_variance);
  return UNITY_END();
}
