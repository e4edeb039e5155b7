// SPDX-License-Identifier: MIT
// The margins do what they promise: at them the loop oscillates, inside of them it is stable.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <ctime>

#include <unity.h>

#include "design/loop/margins.hpp"
#include "design/numeric/structured_singular_value.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

namespace {

using Complex = std::complex<double>;

MatrixXcd in_double(const RealMatrix& a) {
  MatrixXcd result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i) result.data()[i] = to_double(a.data()[i]);
  return result;
}

struct Loop {
  MatrixXcd A, B, C;
};

enum class At { inputs, outputs };

OpenLoop open_loop(const Problem& problem, const Solution& solution, At place) {
  const MeasuredPlant plant = measured_plant(problem, solution.plant);
  const Compensator controller = compensator(problem, solution);
  return (place == At::inputs ? open_at_inputs : open_at_outputs)(plant, controller);
}

Loop loop_of(const Problem& problem, const Solution& solution, At place) {
  const Digits scope(60);
  const OpenLoop loop = open_loop(problem, solution, place);
  return {in_double(loop.A), in_double(loop.B), in_double(loop.C)};
}

// The largest |z| when `factor` stands before input `input`.
double radius(const Loop& loop, Index input, Complex factor) {
  MatrixXcd gains = MatrixXcd::Identity(loop.B.cols(), loop.B.cols());
  gains(input, input) = factor;
  const Eigen::ComplexEigenSolver<MatrixXcd> solver(loop.A - loop.B * gains * loop.C, false);
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

// Of eigenvalues in double: those of a loop that is not normal, and what a loop with so small a disk makes of every
// rounding.
double rounding(double disk) { return 1e-8 + 1e-14 / disk; }

void expect_gain_margin(const Loop& loop, double dB, double tolerance) {
  double worst = 0;
  for (Index i = 0; i < loop.B.cols(); ++i) {
    for (const double sign : {-1.0, 1.0}) worst = std::max(worst, radius(loop, i, std::pow(10, sign * dB / 20)));
    for (int k = -9; k <= 9; ++k)
      TEST_ASSERT_TRUE_MESSAGE(radius(loop, i, std::pow(10, 0.1 * k * dB / 20)) < 1 + tolerance, "unstable inside");
  }
  TEST_ASSERT_DOUBLE_WITHIN(tolerance, 1, worst);
}

void expect_phase_margin(const Loop& loop, double degrees, double tolerance) {
  const double angle = degrees * std::acos(-1.0) / 180;
  double worst = 0;
  for (Index i = 0; i < loop.B.cols(); ++i) {
    worst = std::max(worst, radius(loop, i, std::polar(1.0, angle)));
    for (int k = 0; k <= 9; ++k)
      TEST_ASSERT_TRUE_MESSAGE(radius(loop, i, std::polar(1.0, 0.1 * k * angle)) < 1 + tolerance, "unstable inside");
  }
  TEST_ASSERT_DOUBLE_WITHIN(tolerance, 1, worst);
}

MatrixXcd difference(const Loop& loop, double angle) {
  const Index n = loop.A.rows(), nu = loop.B.cols();
  const MatrixXcd closed = loop.A - loop.B * loop.C;
  const MatrixXcd T =
      loop.C * (std::polar(1.0, angle) * MatrixXcd::Identity(n, n) - closed).partialPivLu().solve(loop.B);
  return 0.5 * MatrixXcd::Identity(nu, nu) - T;
}

// The largest on a grid with as many points to every decade of the angle. The structured norm, which takes long, is
// asked only where the balanced one, which is never less, leaves it a chance.
double largest_on_grid(const Loop& loop) {
  double largest = 0;
  const int points = 4000;
  for (int k = 0; k <= points; ++k) {
    const MatrixXcd H = difference(loop, std::acos(-1.0) * std::pow(10, -6.0 * k / points));
    if (lqg::design::balanced_norm(H) > largest) largest = std::max(largest, lqg::design::structured_norm(H));
  }
  return largest;
}

void expect_disk_margin(const Loop& loop, double disk) {
  const double largest = largest_on_grid(loop);
  // Of one channel a resonance that high stands on poles that near to the circle; the structured norm of several is
  // minimised to some six digits.
  const double own_error = (loop.B.cols() > 1 ? 1e-5 : 1e-9) + 1e-14 * largest;
  TEST_ASSERT_TRUE_MESSAGE(1 / largest > disk * (1 - own_error), "a point on the grid is worse");
  TEST_ASSERT_DOUBLE_WITHIN(0.01 * disk, disk, 1 / largest);
}

void expect_margins(const Loop& loop, const Margins& margins) {
  TEST_ASSERT_TRUE(radius(loop, 0, 1) < 1);
  if (margins.gain_dB) expect_gain_margin(loop, *margins.gain_dB, rounding(*margins.disk));
  if (margins.phase_deg) expect_phase_margin(loop, *margins.phase_deg, rounding(*margins.disk));
  expect_disk_margin(loop, *margins.disk);
}

void check(const Problem& problem) {
  const Solution found = solved(problem);
  expect_margins(loop_of(problem, found, At::inputs), found.loop.at_input);
  if (found.estimator) expect_margins(loop_of(problem, found, At::outputs), found.loop.at_output);
}

void test_filter_form_with_one_input() { check(two_mass()); }

void test_predictor_form_with_one_input() {
  Problem problem = two_mass();
  problem.estimator->form = Form::predictor;
  check(problem);
}

void test_regulator_alone() {
  Problem problem = two_mass();
  problem.estimator.reset();
  check(problem);
}

void test_random_loops_with_several_inputs_and_direct_terms() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) check(random_problem(seed));
}

void test_lightly_damped_chain() { check(chain_of_masses(5)); }

void expect_closed_poles(const OpenLoop& loop, const Poles& poles) {
  std::vector<ComplexReal> left = eigenvalues(loop.A - multiply(loop.B, loop.C));
  for (const Complex& pole : poles) {
    auto nearest = left.begin();
    const auto away = [&](const ComplexReal& z) { return hypot(z.re - pole.real(), z.im - pole.imag()); };
    for (auto other = left.begin(); other != left.end(); ++other)
      if (away(*other) < away(*nearest)) nearest = other;
    expect_small(away(*nearest), 1e-10, "the distance to a pole");
    left.erase(nearest);
  }
  for (const ComplexReal& kept : left) expect_small(hypot(kept.re, kept.im), 1e-10, "the pole of a kept input");
}

// The loop's own poles must be those of the design, with D too: the controller knows what D u adds.
void test_closed_loop_has_the_poles_of_regulator_and_filter() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Problem problem = random_problem(seed);
    const Solution found = solved(problem);
    const Digits scope(60);
    for (const At place : {At::inputs, At::outputs})
      expect_closed_poles(open_loop(problem, found, place), found.loop.poles);
  }
}

// y is integrated as it is measured, in filter form with D of the last input: the poles are not those of the design.
void test_closed_loop_with_integrals_and_direct_terms_has_the_poles_that_are_reported() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Problem problem = random_problem(seed);
    problem.regulator->R *= 100;
    problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 1e-4)};
    Findings findings;
    const std::optional<Solution> found = solve(problem, findings);
    if (!found && problem.estimator->form == Form::filter) continue;
    TEST_ASSERT_TRUE(found.has_value());
    const Digits scope(60);
    expect_closed_poles(open_loop(problem, *found, At::inputs), found->loop.poles);
  }
}

// A plant that answers at once, and little else: ξ⁺ = ξ − T D u[k−1] and u = −K ξ with T D K > 1 swing up.
void test_integral_that_answers_a_sample_late_is_refused_with_that_reason() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::discrete, 1, 0.1 * one, 1e-3 * one, one);
  problem.plant.D = one;
  problem.regulator->R *= 1e-6;
  problem.regulator->integral = Integral{{0}, one};
  Findings findings;
  TEST_ASSERT_FALSE(solve(problem, findings).has_value());
  TEST_ASSERT_EQUAL_STRING("lqr.integral", findings.back().key.c_str());
  TEST_ASSERT_NOT_EQUAL(std::string::npos, findings.back().message.find("the loop is unstable"));
  problem.estimator->form = Form::predictor;
  solved(problem);
}

// One input and one output, no D: the loop's gain is the same wherever it is opened.
void test_loop_of_one_input_and_one_output_has_the_same_margins_at_both() {
  for (const Form form : {Form::filter, Form::predictor}) {
    Problem problem = double_integrator(0.1);
    problem.estimator->form = form;
    const LoopSolution loop = solved(problem).loop;
    TEST_ASSERT_TRUE(*loop.at_input.gain_dB == *loop.at_output.gain_dB);
    TEST_ASSERT_TRUE(*loop.at_input.phase_deg == *loop.at_output.phase_deg);
    TEST_ASSERT_TRUE(*loop.at_input.disk == *loop.at_output.disk);
  }
}

void expect_six_digits(const std::optional<double>& exact, const std::optional<double>& rough) {
  TEST_ASSERT_EQUAL(exact.has_value(), rough.has_value());
  if (exact) TEST_ASSERT_DOUBLE_WITHIN(1e-5 * *exact, *exact, *rough);
}

void test_margins_in_double_have_six_digits() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Problem problem = random_problem(seed);
    const Solution found = solved(problem);
    const Digits scope(60);
    const OpenLoop loop = open_loop(problem, found, At::outputs);
    const Margins rough = rough_margins(loop, eigenvalues(loop.A - multiply(loop.B, loop.C)));
    expect_six_digits(found.loop.at_output.gain_dB, rough.gain_dB);
    expect_six_digits(found.loop.at_output.phase_deg, rough.phase_deg);
    expect_six_digits(found.loop.at_output.disk, rough.disk);
  }
}

// L = k/(z − 1), k = K: T = k/(z − 1 + k). At z = −1: 1 − 1/t = 1 + (2 − k)/k = 2/k is the gain margin, and
// Re t = 1/2 where |L| = 1, |z − 1| = k: 2 sin(θ/2) = k, margin 90° − θ/2. (S − T)/2 is largest at z = −1:
// (2/k + 1)/(2/k − 1)/2.
void test_integrator_has_its_closed_form() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::discrete, 1, one, one, one);
  problem.estimator.reset();
  const Solution found = solved(problem);
  const Digits scope(60);
  const Real k = (sqrt(Real(5)) - 1) / 2, degree = atan(Real(1)) / 45;
  TEST_ASSERT_TRUE(*found.loop.at_input.gain_dB == to_double(20 * log10(2 / k)));
  TEST_ASSERT_TRUE(*found.loop.at_input.phase_deg == to_double(90 - asin(k / 2) / degree));
  TEST_ASSERT_TRUE(*found.loop.at_input.disk == to_double(2 * (2 / k - 1) / (2 / k + 1)));
  // The gain may fall to 0. A delay turns by θ a sample, θ = 2 asin(k/2).
  const Real crossover = 2 * asin(k / 2);
  const Margins& margins = found.loop.at_input;
  TEST_ASSERT_TRUE(*margins.gain_up_dB == *margins.gain_dB && !margins.gain_down_dB);
  TEST_ASSERT_DOUBLE_WITHIN(1e-13, to_double(crossover), *margins.crossover);
  TEST_ASSERT_DOUBLE_WITHIN(1e-12, to_double((90 * degree - crossover / 2) / crossover), *margins.delay_samples);
}

// x⁺ = 2 x + u with u = −k K x is stable for |2 − k K| < 1: k from 1/K to 3/K.
void test_gain_of_an_unstable_plant_may_fall_as_little_as_its_closed_form_says() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::discrete, 1, 2 * one, one, one);
  problem.estimator.reset();
  const Solution found = solved(problem);
  const double K = to_double(found.regulator->K(0, 0));
  const Margins& margins = found.loop.at_input;
  TEST_ASSERT_DOUBLE_WITHIN(1e-12, 20 * std::log10(3 / K), *margins.gain_up_dB);
  TEST_ASSERT_DOUBLE_WITHIN(1e-12, 20 * std::log10(K), *margins.gain_down_dB);
  TEST_ASSERT_TRUE(*margins.gain_dB == std::min(*margins.gain_up_dB, *margins.gain_down_dB));
}

// As many whole samples of delay as the margin has leave the loop stable, and one more does not: the poles of the loop
// with that delay in it say so.
void test_loop_bears_the_whole_samples_of_its_delay_margin_and_no_more() {
  for (const double damping : {0.01, 0.1, 1.0}) {
    Problem problem = problem_of(Domain::discrete, 1, (MatrixXd(2, 2) << 1, 0.1, 0, 1 - 0.01 * damping).finished(),
                                 Eigen::Vector2d(0.005, 0.1), Eigen::RowVector2d(1, 0));
    problem.estimator.reset();
    problem.regulator->R *= 10;
    const Solution found = solved(problem);
    const double margin = *found.loop.at_input.delay_samples;
    const MatrixXd A = problem.plant.A, B = problem.plant.B, K = to_doubles(found.regulator->K);
    const auto radius_with = [&](Index late) {
      MatrixXd all = MatrixXd::Zero(2 + late, 2 + late);  // u[k] = −K x waits in a chain
      all.topLeftCorner(2, 2) = A;
      all.col(2).head(2) = B;
      for (Index i = 0; i + 1 < late; ++i) all(2 + i, 3 + i) = 1;
      all.bottomLeftCorner(1, 2) = -K;
      return Eigen::EigenSolver<MatrixXd>(all, false).eigenvalues().cwiseAbs().maxCoeff();
    };
    const Index whole = static_cast<Index>(std::floor(margin));
    TEST_ASSERT_GREATER_THAN(0, whole);
    TEST_ASSERT_TRUE(radius_with(whole) < 1 && radius_with(whole + 1) > 1);
  }
}

// Integrators two by two, each pair with a K of its own.
OpenLoop pairs_of_integrators(const std::vector<MatrixXd>& gains) {
  const Index all = 2 * static_cast<Index>(gains.size());
  MatrixXd K = MatrixXd::Zero(all, all);
  for (Index i = 0; i < all; i += 2) K.block(i, i, 2, 2) = gains[static_cast<std::size_t>(i / 2)];
  return {identity(all), identity(all), real(K)};
}

// Channels that do not meet: the disk is the least of the pairs', which are searched for as two channels. To search for
// that of 16 channels took 10 seconds, of 64 it had no end.
void expect_least_of_pairs(std::size_t pairs, double seconds) {
  Random random(7);
  std::vector<MatrixXd> gains;
  std::vector<ComplexReal> poles;
  double least = 2;
  const Digits scope(50);
  for (std::size_t i = 0; i < pairs; ++i) {
    gains.push_back(0.6 * MatrixXd::Identity(2, 2) + 0.3 * random.matrix(2, 2));
    const OpenLoop loop = pairs_of_integrators({gains.back()});
    const std::vector<ComplexReal> own = eigenvalues(loop.A - loop.C);
    poles.insert(poles.end(), own.begin(), own.end());
    least = std::min(least, *rough_margins(loop, own).disk);
  }
  const OpenLoop loop = pairs_of_integrators(gains);
  const std::clock_t start = std::clock();
  TEST_ASSERT_DOUBLE_WITHIN(0.01 * least, least, *margins(loop, poles).disk);
  TEST_ASSERT_TRUE(static_cast<double>(std::clock() - start) < seconds * CLOCKS_PER_SEC);
}

void test_disk_of_16_channels_is_that_of_its_worst_pair() { expect_least_of_pairs(8, 5); }
void test_disk_of_64_channels_is_that_of_its_worst_pair() { expect_least_of_pairs(32, 60); }

// A plant that no feedback needs: nothing can make it oscillate, and there is no crossing to report.
void test_loop_without_crossings_has_no_gain_and_phase_margin() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::discrete, 1, 0 * one, one, one);
  problem.estimator.reset();
  const Solution found = solved(problem);
  TEST_ASSERT_FALSE(found.loop.at_input.gain_dB.has_value());
  TEST_ASSERT_FALSE(found.loop.at_input.phase_deg.has_value());
  TEST_ASSERT_TRUE(*found.loop.at_input.disk == 2);
}

// Without noise the filter of a stable plant answers no output: every disk is 2, and no place is better than another.
// To look into each of them took half a minute; a second is plenty.
void test_loop_of_several_channels_without_feedback_takes_no_search() {
  Problem problem = problem_of(Domain::discrete, 0.1, MatrixXd::Constant(1, 1, -0.6), Eigen::RowVector3d(-0.5, -1, 2.5),
                               Eigen::Vector4d(1.2, -0.1, -0.8, 0.1));
  problem.estimator->W.setZero();
  const std::clock_t start = std::clock();
  const LoopSolution loop = solved(problem).loop;
  TEST_ASSERT_TRUE(*loop.at_input.disk == 2 && *loop.at_output.disk == 2);
  TEST_ASSERT_TRUE(std::clock() - start < 2 * CLOCKS_PER_SEC);
}

void test_estimator_alone_has_no_margins() {
  Problem problem = two_mass();
  problem.regulator.reset();
  const LoopSolution loop = solved(problem).loop;
  TEST_ASSERT_FALSE(loop.at_input.gain_dB || loop.at_input.phase_deg || loop.at_input.disk || loop.cost_per_sample);
  TEST_ASSERT_EQUAL(4, loop.poles.size());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_filter_form_with_one_input);
  RUN_TEST(test_predictor_form_with_one_input);
  RUN_TEST(test_regulator_alone);
  RUN_TEST(test_random_loops_with_several_inputs_and_direct_terms);
  RUN_TEST(test_lightly_damped_chain);
  RUN_TEST(test_closed_loop_has_the_poles_of_regulator_and_filter);
  RUN_TEST(test_closed_loop_with_integrals_and_direct_terms_has_the_poles_that_are_reported);
  RUN_TEST(test_integral_that_answers_a_sample_late_is_refused_with_that_reason);
  RUN_TEST(test_loop_of_one_input_and_one_output_has_the_same_margins_at_both);
  RUN_TEST(test_margins_in_double_have_six_digits);
  RUN_TEST(test_integrator_has_its_closed_form);
  RUN_TEST(test_gain_of_an_unstable_plant_may_fall_as_little_as_its_closed_form_says);
  RUN_TEST(test_loop_bears_the_whole_samples_of_its_delay_margin_and_no_more);
  RUN_TEST(test_disk_of_16_channels_is_that_of_its_worst_pair);
  RUN_TEST(test_disk_of_64_channels_is_that_of_its_worst_pair);
  RUN_TEST(test_loop_without_crossings_has_no_gain_and_phase_margin);
  RUN_TEST(test_loop_of_several_channels_without_feedback_takes_no_search);
  RUN_TEST(test_estimator_alone_has_no_margins);
  return UNITY_END();
}
