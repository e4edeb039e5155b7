// SPDX-License-Identifier: MIT
// Designs that hang on the rounding of their numbers: a plant that another program sampled, or that was turned, is
// refused as the plant is that was meant, whatever the luck of its last digits. Designs that only look extreme pass.
#include <cmath>
#include <string>
#include <vector>

#include <unity.h>

#include "design/rounding.hpp"
#include "design/sampled/samples.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Refused with errors at `key` alone; the first has every one of `parts`.
void expect_refusal(const Problem& problem, const std::string& key, const std::vector<std::string>& parts) {
  Findings findings;
  TEST_ASSERT_FALSE_MESSAGE(solve(problem, findings).has_value(), "it was solved");
  for (const Finding& finding : findings)
    TEST_ASSERT_EQUAL_STRING_MESSAGE(key.c_str(), finding.key.c_str(), finding.message.c_str());
  for (const std::string& part : parts)
    TEST_ASSERT_TRUE_MESSAGE(findings.front().message.find(part) != std::string::npos,
                             (findings.front().message + " | lacks: " + part).c_str());
}

Problem discrete(const MatrixXd& A, const MatrixXd& B, const MatrixXd& C) {
  Problem problem = problem_of(Domain::discrete, 0.1, A, B, C);
  problem.code.real = Scalar::float64;
  return problem;
}

Problem regulated(const MatrixXd& A, const MatrixXd& B) {
  return regulator_alone(discrete(A, B, MatrixXd::Identity(1, A.rows())));
}

Problem estimated(const MatrixXd& A, const MatrixXd& C) {
  Problem problem = discrete(A, MatrixXd::Zero(A.rows(), 1), C);
  problem.regulator.reset();
  return problem;
}

// An orthogonal matrix: reflections in random directions.
MatrixXd turn(Random& random, Eigen::Index n) {
  MatrixXd all = MatrixXd::Identity(n, n);
  for (int k = 0; k < 3; ++k) {
    const VectorXd v = random.matrix(n, 1).normalized();
    all -= 2 * v * (v.transpose() * all);
  }
  return all;
}

// Modes by themselves in the first states, reached as `of_mode` says, and stable ones that they drive.
struct Plain {
  MatrixXd A, B;
};

Plain with_stable_ones(Random& random, const MatrixXd& mode, const MatrixXd& of_mode, Eigen::Index stable) {
  const Eigen::Index own = mode.rows(), n = own + stable;
  Plain plain = {MatrixXd::Zero(n, n), random.matrix(n, of_mode.cols())};
  plain.A.topLeftCorner(own, own) = mode;
  plain.A.bottomRows(stable) = 0.3 * random.matrix(stable, n);
  for (Eigen::Index i = own; i < n; ++i) {
    plain.A.row(i).tail(n - i).setZero();
    plain.A(i, i) = 0.9 * random.uniform();
  }
  plain.B.topRows(own) = of_mode;
  return plain;
}

// As double arithmetic leaves it in other coordinates, and in other units.
Plain turned(Random& random, const Plain& plain, double decades) {
  const Eigen::Index n = plain.A.rows();
  const MatrixXd U = turn(random, n);
  VectorXd units(n);
  for (Eigen::Index i = 0; i < n; ++i) units(i) = std::pow(10.0, decades * random.uniform());
  const MatrixXd inverse = units.cwiseInverse().asDiagonal();
  return {units.asDiagonal() * (U * plain.A * U.transpose()) * inverse, units.asDiagonal() * (U * plain.B)};
}

const MatrixXd growing = MatrixXd::Constant(1, 1, 1.05);
const MatrixXd unreached = MatrixXd::Zero(1, 1);

void test_unstable_mode_that_no_input_reaches_in_turned_coordinates() {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    const Plain plant =
        turned(random, with_stable_ones(random, growing, unreached, 3), 3.0 * static_cast<double>(seed % 3));
    Problem problem = regulated(plant.A, plant.B);
    problem.code.real = seed % 2 ? Scalar::float64 : Scalar::float32;
    expect_refusal(problem, "plant.B",
                   {"z = 1.05", "x0, x1, x2, x3", "by the rounding", "move every number of A and B by", "e-1"});
  }
}

void test_unstable_mode_that_no_output_sees_in_turned_coordinates() {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    const Plain plant =
        turned(random, with_stable_ones(random, growing, unreached, 3), 3.0 * static_cast<double>(seed % 3));
    expect_refusal(estimated(plant.A.transpose(), plant.B.transpose()), "plant.C",
                   {"z = 1.05", "by the rounding", "no output sees it"});
  }
}

// Rounding scatters a double pole by the root of its own size.
void test_repeated_mode_on_the_circle_that_no_input_reaches_in_turned_coordinates() {
  const MatrixXd chain = (MatrixXd(2, 2) << 1, 0.1, 0, 1).finished();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    const Plain none = turned(random, with_stable_ones(random, chain, MatrixXd::Zero(2, 1), 3), 0);
    expect_refusal(regulated(none.A, none.B), "plant.B", {"z = 1 ", "by the rounding"});
    const Plain half = turned(random, with_stable_ones(random, chain, Eigen::Vector2d(1, 0), 3), 0);
    expect_refusal(regulated(half.A, half.B), "plant.B", {"z = 1 ", "by the rounding"});
  }
}

void test_pole_that_cannot_be_placed_in_turned_coordinates() {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Random random(seed);
    const Plain plant = turned(random, with_stable_ones(random, MatrixXd::Constant(1, 1, 0.4), unreached, 2), 0);
    Problem problem = regulated(plant.A, plant.B);
    problem.regulator->poles = WantedPoles{{0.1, 0.2, 0.3}, false};
    expect_refusal(problem, "plant.B", {"z = 0.4", "its pole cannot be moved"});
    Problem dual = estimated(plant.A.transpose(), plant.B.transpose());
    dual.estimator->poles = WantedPoles{{0.1, 0.2, 0.3}, false};
    expect_refusal(dual, "plant.C", {"z = 0.4", "its pole cannot be moved"});
  }
}

// A spring and a damper, sampled to the last bit but for `units` in the last place, as expm of other programs leaves.
Problem sampled_oscillator(double sample_time, Random& random, int units) {
  Problem exact = problem_of(Domain::continuous, sample_time, (MatrixXd(2, 2) << 0, 1, -40, -3).finished(),
                             Eigen::Vector2d(0, 25), (MatrixXd(2, 2) << 1, 0, 0, 1).finished());
  const Digits scope(50);
  const SampledPlant plant = sample(exact).plant;
  const auto moved = [&](const RealMatrix& a) {
    return MatrixXd(to_doubles(a).unaryExpr(
        [&](double x) { return x * (1 + std::round(units * random.uniform()) * std::ldexp(1.0, -52)); }));
  };
  Problem problem = discrete(moved(plant.A), moved(plant.B), exact.plant.C);
  problem.plant.states = {{"angle", ""}, {"rate", ""}};
  problem.estimator.reset();
  problem.regulator->cost = Cost::discrete;
  return problem;
}

double sample_time_of(int i) { return 1e-4 * std::pow(10.0, i / 15.0); }

// The rate of an oscillator has a zero at s = 0.
void test_integral_of_a_rate_over_sixty_sample_times() {
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    Problem problem = sampled_oscillator(sample_time_of(i), random, 4);
    problem.regulator->integral = Integral{{1}, MatrixXd::Identity(1, 1)};
    expect_refusal(problem, "lqr.integral",
                   {"zero at z = 1", "angle", "by the rounding", "move every number of A, B, C and D by"});
    problem.regulator->integral.reset();
    problem.regulator->track = {1};
    expect_refusal(problem, "lqr.track", {"zero at z = 1", "by the rounding"});
  }
}

void test_integral_of_a_position_over_sixty_sample_times_is_no_artefact() {
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    Problem problem = sampled_oscillator(sample_time_of(i), random, 4);
    problem.regulator->integral = Integral{{0}, MatrixXd::Identity(1, 1)};
    solved(problem);
  }
}

MatrixXd sine(double angle) {
  return (MatrixXd(2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}

// cos² + sin² is 1 but for rounding: the pole is on the circle, or beside it on either side.
void test_sine_disturbance_without_noise_of_its_own() {
  for (int i = 1; i <= 30; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    MatrixXd A = MatrixXd::Zero(3, 3);
    A(0, 0) = 0.9;
    A(0, 1) = 1;
    A.bottomRightCorner(2, 2) = sine(0.1 * i);
    Problem problem = estimated(A, MatrixXd::Identity(1, 3));
    problem.estimator->W = Eigen::Vector3d(1, 0, 0).asDiagonal();
    expect_refusal(problem, "kalman.process_noise", {"states x1, x2", "limit", "no stable steady filter is optimal"});
    const MatrixXd U = turn(random, 3);
    Problem other = estimated(U * A * U.transpose(), MatrixXd::Identity(1, 3) * U.transpose());
    other.estimator->W = MatrixXd::Ones(1, 1);
    other.plant.G = U.col(0);
    other.plant.H = MatrixXd::Zero(1, 1);
    other.estimator->Swv = MatrixXd::Zero(1, 1);
    expect_refusal(other, "kalman.process_noise", {"limit", "no stable steady filter is optimal"});
  }
}

// One noise for state and output: what drives the sine is what the output tells.
void test_sine_disturbance_whose_noise_is_all_told_by_the_output() {
  for (int i = 1; i <= 10; ++i) {
    MatrixXd A = MatrixXd::Zero(3, 3);
    A(0, 0) = 0.9;
    A(0, 1) = 1;
    A.bottomRightCorner(2, 2) = sine(0.1 * i);
    Problem problem = estimated(A, MatrixXd::Identity(1, 3));
    problem.plant.H = MatrixXd::Identity(1, 3);
    problem.estimator->W = Eigen::Vector3d(1, 0, 0).asDiagonal();
    expect_refusal(problem, "kalman.process_noise", {"limit", "no stable steady filter is optimal"});
  }
}

// Online the filter goes on without noise, which is said.
void test_sine_disturbance_without_noise_of_its_own_online() {
  for (int i = 1; i <= 10; ++i) {
    MatrixXd A = MatrixXd::Zero(3, 3);
    A(0, 0) = 0.9;
    A(0, 1) = 1;
    A.bottomRightCorner(2, 2) = sine(0.1 * i);
    Problem problem = estimated(A, MatrixXd::Identity(1, 3));
    problem.estimator->W = Eigen::Vector3d(1, 0, 0).asDiagonal();
    problem.estimator->gain = Gain::online;
    Findings findings;
    TEST_ASSERT_TRUE(solve(problem, findings).has_value());
    TEST_ASSERT_EQUAL(1, findings.size());
    TEST_ASSERT_TRUE(findings[0].message.find("its gain tends to 0") != std::string::npos);
  }
}

void test_oscillation_without_weight_beside_the_circle() {
  for (int i = 1; i <= 30; ++i) {
    Problem problem = regulated(sine(0.1 * i), Eigen::Vector2d(1, 1));
    problem.regulator->Q.setZero();
    expect_refusal(problem, "lqr.Q", {"limit", "no stabilising gain is optimal"});
    // (u + x1/2)² in the cost: u = −x1/2 is free, and what it makes of the plant goes round.
    Problem crossed =
        regulated(sine(0.1 * i) + Eigen::Vector2d(1, 1) * Eigen::RowVector2d(0, 0.5), Eigen::Vector2d(1, 1));
    crossed.regulator->Q = Eigen::Vector2d(0, 0.25).asDiagonal();
    crossed.regulator->N = Eigen::Vector2d(0, 0.5);
    expect_refusal(crossed, "lqr.Q", {"limit", "no stabilising gain is optimal"});
  }
}

// ---- what only looks extreme

// P. Benner, A. J. Laub, V. Mehrmann, DAREX (report SPC 95_23), 2.3 with ε = 1e12, 2.4 and 2.5 with τ = 1e8.
void test_examples_of_the_collection_are_no_artefacts() {
  const double epsilon = 1e12, tau = 1e8;
  solved(regulated((MatrixXd(2, 2) << 0, epsilon, 0, 0).finished(), Eigen::Vector2d(0, 1)));
  const MatrixXd V = MatrixXd::Identity(3, 3) - 2.0 / 3 * MatrixXd::Ones(3, 3);
  const MatrixXd A = V * Eigen::Vector3d(0, 1, 3).asDiagonal() * V;
  solved(regulated(A, MatrixXd::Identity(3, 3)));
  MatrixXd machine = MatrixXd::Zero(4, 4);
  machine(0, 0) = 1 - 1 / tau;
  machine(1, 0) = machine(2, 1) = machine(3, 2) = 1;
  Problem paper = regulated(machine, Eigen::Vector4d(1 / tau, 0, 0, 0));
  paper.regulator->Q = Eigen::Vector4d(0, 0, 0, 1).asDiagonal();
  paper.regulator->R *= 0.25;
  solved(paper);
}

void test_weak_input_is_no_artefact() {
  solved(regulated(Eigen::Vector2d(1.05, 0.5).asDiagonal(), Eigen::Vector2d(1e-17, 1)));
  solved(estimated(Eigen::Vector2d(1.05, 0.5).asDiagonal(), Eigen::RowVector2d(1e-17, 1)));
}

// x⁗ = u sampled at a microsecond, and in turned coordinates at a millisecond.
void test_fast_samples_are_no_artefact() {
  const auto integrators = [](double T) {
    MatrixXd A = MatrixXd::Identity(4, 4);
    Eigen::Vector4d B;
    double power = 1;
    for (int k = 1; k <= 4; ++k) {
      power *= T / k;
      B(4 - k) = power;
      for (int i = 0; i + k < 4; ++i) A(i, i + k) = power;
    }
    return Plain{A, B};
  };
  const Plain fast = integrators(1e-6), slow = integrators(1e-3);
  solved(regulated(fast.A, fast.B));
  Random random(3);
  const Plain other = turned(random, slow, 0);
  Problem problem = regulated(other.A, other.B);
  problem.code.real = Scalar::float64;
  Findings findings;
  solve(problem, findings);
  for (const Finding& finding : findings)
    TEST_ASSERT_TRUE_MESSAGE(finding.message.find("by the rounding") == std::string::npos, finding.message.c_str());
}

// ---- rounded loops

// e^(−1e-18) is 1 as a double; the loop with rounded numbers is looked at all the same.
void test_pole_that_is_one_as_a_double_is_not_skipped() {
  Problem problem = regulator_alone(problem_of(Domain::continuous, 1e-9, Eigen::Vector2d(-1e-9, -1).asDiagonal(),
                                               Eigen::Vector2d(0, 1), MatrixXd::Identity(1, 2)));
  problem.code.real = Scalar::float64;
  const Solution solution = solved(problem);
  TEST_ASSERT_TRUE(solution.loop.poles[0] == 1.0);
  TEST_ASSERT_TRUE(solution.loop.rounded.has_value());
}

// A filter's own pole of that size is lost in its A.
void test_filter_whose_pole_is_one_as_a_double_is_refused() {
  Problem problem = problem_of(Domain::continuous, 1e-9, Eigen::Vector2d(-1e-9, -1).asDiagonal(), MatrixXd::Zero(2, 1),
                               MatrixXd::Identity(1, 2).rowwise().reverse());
  problem.regulator.reset();
  problem.code.real = Scalar::float64;
  expect_refusal(problem, "code.real", {"the filter with the numbers rounded to double is unstable: a pole at z = 1"});
}

void test_double_is_not_advised_where_it_does_not_help() {
  Problem problem =
      problem_of(Domain::continuous, 1e-9, MatrixXd::Constant(1, 1, -1e-9), MatrixXd::Ones(1, 1), MatrixXd::Ones(1, 1));
  problem.code.real = Scalar::float32;
  expect_refusal(problem, "code.real", {"A becomes the identity in float", "double does not help"});
  problem.plant.A *= 1e7;
  expect_refusal(problem, "code.real", {"A becomes the identity in float", "use real = \"double\""});
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_unstable_mode_that_no_input_reaches_in_turned_coordinates);
  RUN_TEST(test_unstable_mode_that_no_output_sees_in_turned_coordinates);
  RUN_TEST(test_repeated_mode_on_the_circle_that_no_input_reaches_in_turned_coordinates);
  RUN_TEST(test_pole_that_cannot_be_placed_in_turned_coordinates);
  RUN_TEST(test_integral_of_a_rate_over_sixty_sample_times);
  RUN_TEST(test_integral_of_a_position_over_sixty_sample_times_is_no_artefact);
  RUN_TEST(test_sine_disturbance_without_noise_of_its_own);
  RUN_TEST(test_sine_disturbance_whose_noise_is_all_told_by_the_output);
  RUN_TEST(test_sine_disturbance_without_noise_of_its_own_online);
  RUN_TEST(test_oscillation_without_weight_beside_the_circle);
  RUN_TEST(test_examples_of_the_collection_are_no_artefacts);
  RUN_TEST(test_weak_input_is_no_artefact);
  RUN_TEST(test_fast_samples_are_no_artefact);
  RUN_TEST(test_pole_that_is_one_as_a_double_is_not_skipped);
  RUN_TEST(test_filter_whose_pole_is_one_as_a_double_is_refused);
  RUN_TEST(test_double_is_not_advised_where_it_does_not_help);
  return UNITY_END();
}
