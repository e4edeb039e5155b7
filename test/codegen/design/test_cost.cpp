// SPDX-License-Identifier: MIT
// The long-run cost of the closed loop against the covariance of plant and controller together.
#include <unity.h>

#include "design/equations/riccati.hpp"
#include "design/rounding.hpp"
#include "design/sampled/samples.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

const double rounding = 1e-15;  // the cost is a double: half a unit in its last place, and the comparison's own

// x and the controller's x̂⁻, driven by w and v: [x; x̂⁻]⁺ = A [x; x̂⁻] + B [w; v], [x; u] = C [x; x̂⁻] + D
// [w; v].
struct Joint {
  RealMatrix A, B, C, D, noise;
};

Joint joint_loop(const Problem& problem, const Solution& s) {
  const RealMatrix &A = s.plant.A, &B = s.plant.B, &C = s.plant.C, &G = s.plant.G, &K = s.regulator->K;
  const EstimatorSolution& f = *s.estimator;
  const Index nx = A.rows(), nw = G.cols(), nu = B.cols(), ny = C.rows();
  const RealMatrix L = problem.estimator->form == Form::filter ? f.L : zeros(nx, ny);
  const RealMatrix u_x = -multiply(K, multiply(L, C)), u_v = -multiply(K, L), u_estimate = -K - u_x;
  Joint joint;
  joint.A = above(
      beside(A + multiply(B, u_x), multiply(B, u_estimate)),
      beside(multiply(B, u_x) + multiply(f.L_predictor, C), A + multiply(B, u_estimate) - multiply(f.L_predictor, C)));
  joint.B = above(beside(G, multiply(B, u_v)), beside(zeros(nx, nw), multiply(B, u_v) + f.L_predictor));
  joint.C = above(beside(identity(nx), zeros(nx, nx)), beside(u_x, u_estimate));
  joint.D = above(zeros(nx, nw + ny), beside(zeros(nu, nw), u_v));
  joint.noise = above(beside(f.noise.W, f.noise.Swv), beside(f.noise.Swv.transpose(), f.noise.V));
  return joint;
}

RealMatrix together(const SampledCost& cost) {
  return above(beside(cost.Q, cost.N), beside(cost.N.transpose(), cost.R));
}

void test_cost_per_sample_is_that_of_the_joint_covariance() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Problem problem = random_problem(seed);
    const Solution found = solved(problem);
    const Digits scope(60);
    const Joint joint = joint_loop(problem, found);
    const RealMatrix states = *solve_stein(joint.A.transpose(), congruence(joint.B, joint.noise));
    const RealMatrix outputs = congruence(joint.C, states) + congruence(joint.D, joint.noise);
    const Real expected = trace_of_product(together(found.regulator->cost), outputs);
    TEST_ASSERT_TRUE(found.loop.cost_per_sample.has_value());
    expect_small(abs(*found.loop.cost_per_sample / expected - 1), rounding, "the difference");
  }
}

void expect_roots(const RealMatrix& covariance, Index first, const std::vector<double>& found) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Index at = first + static_cast<Index>(i);
    const double expected = to_double(sqrt(covariance(at, at)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * expected, expected, found[i]);
  }
}

// In predictor form u is older than v: y = C x + D u + v has the variance of C x + D u, and V.
void test_root_mean_squares_are_those_of_the_joint_covariance() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Problem problem = random_problem(seed);
    const Solution found = solved(problem);
    const Digits scope(60);
    const Joint joint = joint_loop(problem, found);
    const RealMatrix states = *solve_stein(joint.A.transpose(), congruence(joint.B, joint.noise));
    const RealMatrix outputs = congruence(joint.C, states) + congruence(joint.D, joint.noise);
    TEST_ASSERT_TRUE(found.loop.rms.has_value());
    const Rms& rms = *found.loop.rms;
    TEST_ASSERT_EQUAL(problem.plant.A.rows(), rms.x.size());
    TEST_ASSERT_EQUAL(problem.plant.B.cols(), rms.u.size());
    TEST_ASSERT_EQUAL(problem.plant.C.rows(), rms.y.size());
    expect_roots(outputs, 0, rms.x);
    expect_roots(outputs, problem.plant.A.rows(), rms.u);
    if (problem.estimator->form == Form::predictor)
      expect_roots(congruence(beside(found.plant.C, found.plant.D), outputs) + found.estimator->noise.V, 0, rms.y);
  }
}

// One period cut into `parts`: w(t) is followed through all of them while u is held, with the correlation of
// what v tells.
Real cost_of_parts(const Problem& problem, const Solution& s, int parts) {
  Problem fine = problem;
  fine.plant.sample_time /= parts;
  const Samples part = sample(fine);
  const Joint joint = joint_loop(problem, s);
  const RealMatrix states = *solve_stein(joint.A.transpose(), congruence(joint.B, joint.noise));
  RealMatrix z = congruence(joint.C, states) + congruence(joint.D, joint.noise);  // E[x; u][x; u]ᵀ
  const Index nx = part.plant.A.rows(), nu = part.plant.B.cols();
  const RealMatrix step = above(beside(part.plant.A, part.plant.B), beside(zeros(nu, nx), identity(nu)));
  Real total;
  for (int k = 0; k < parts; ++k) {
    total += trace_of_product(together(part.between->cost), z) + part.between->noise_cost;
    z = congruence(step, z);
    z.topLeftCorner(nx, nx) += congruence(part.plant.G, part.noise->W);
  }
  return total / Real(problem.plant.sample_time);
}

void test_cost_per_second_with_continuous_noise_is_the_sum_over_short_parts() {
  const Digits scope(60);
  for (const Form form : {Form::filter, Form::predictor}) {
    Problem problem = chain_of_masses(2);
    problem.estimator->form = form;
    const Solution found = solved(problem);
    for (const int parts : {1, 2, 8})
      expect_small(abs(*found.loop.cost_per_second / cost_of_parts(problem, found, parts) - 1), rounding,
                   "the difference");
  }
}

// ẋ = u + w, y = x + v, all of one: between the samples x(t) = x + t(u + w) with w held, and in filter form u
// = −KL v − … is correlated with w: E[uw] = −KL s. The integral of x² + u² over a period of 1 is E[x² + xu +
// u²/3] + E[u²] + 2 E[xw]/2 + 2 E[uw]/3 + E[w²]/3.
void test_cost_per_second_counts_held_noise_that_the_output_tells() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::continuous, 1, 0 * one, one, one);
  problem.estimator->noise = Noise::discrete;
  problem.estimator->Swv = 0.5 * one;
  const Solution found = solved(problem);
  const Digits scope(60);
  const Real between = Real(1) / 3 - 2 * found.regulator->K(0, 0) * found.estimator->L(0, 0) * Real(0.5) / 3;
  expect_small(abs(*found.loop.cost_per_second - *found.loop.cost_per_sample - between), rounding * 10,
               "the difference");
}

void test_cost_of_the_samples_is_no_cost_per_second() {
  Problem problem = two_mass();
  problem.regulator->cost = Cost::discrete;
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(found.loop.cost_per_sample.has_value());
  TEST_ASSERT_FALSE(found.loop.cost_per_second.has_value());
}

void test_faster_sampling_costs_less_per_second() {
  double before = 1e300;
  for (const double T : {1.0, 0.5, 0.1, 0.01}) {
    Problem problem = double_integrator(T);
    problem.estimator->noise = Noise::continuous;
    const double cost = *solved(problem).loop.cost_per_second;
    TEST_ASSERT_TRUE(cost < before);
    before = cost;
  }
}

void test_no_gain_near_the_optimal_one_costs_less() {
  const Problem problem = two_mass();
  const Solution best = solved(problem);
  Problem other = problem;
  other.regulator->R *= 1.1;  // another gain; its cost in the weights of the first
  const Solution found = solved(other);
  const Digits scope(60);
  const Joint joint = joint_loop(problem, found);
  const RealMatrix states = *solve_stein(joint.A.transpose(), congruence(joint.B, joint.noise));
  const RealMatrix outputs = congruence(joint.C, states) + congruence(joint.D, joint.noise);
  TEST_ASSERT_TRUE(trace_of_product(together(best.regulator->cost), outputs) > *best.loop.cost_per_sample * (1 + 1e-6));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_cost_per_sample_is_that_of_the_joint_covariance);
  RUN_TEST(test_root_mean_squares_are_those_of_the_joint_covariance);
  RUN_TEST(test_cost_per_second_with_continuous_noise_is_the_sum_over_short_parts);
  RUN_TEST(test_cost_per_second_counts_held_noise_that_the_output_tells);
  RUN_TEST(test_cost_of_the_samples_is_no_cost_per_second);
  RUN_TEST(test_faster_sampling_costs_less_per_second);
  RUN_TEST(test_no_gain_near_the_optimal_one_costs_less);
  return UNITY_END();
}
