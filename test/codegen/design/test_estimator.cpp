// SPDX-License-Identifier: MIT
// The Kalman filter: closed forms, duality, its own relations, and its form for the target.
#include <unity.h>

#include "design/gains/estimator.hpp"
#include "design/numeric/factor.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"
#include "design/sampled/noise.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

const std::uint64_t seeds = 24;
const double rounding = 1e-35;  // of 100 digits of which the correction of P has half, less condition

// P_prior = (w + √(w² + 4wv))/2.
void test_constant_in_noise_has_its_closed_form() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::discrete, 1, one, one, one);
  problem.estimator->W *= 0.3;
  problem.estimator->V *= 7;
  const EstimatorSolution found = *solved(problem).estimator;
  const Digits scope(60);
  const Real w = 0.3, v = 7, P = (w + sqrt(w * w + 4 * w * v)) / 2;
  TEST_ASSERT_TRUE(to_double(found.P_prior(0, 0)) == to_double(P));
  TEST_ASSERT_TRUE(to_double(found.L(0, 0)) == to_double(P / (P + v)));
  TEST_ASSERT_TRUE(to_double(found.P_posterior(0, 0)) == to_double(P * v / (P + v)));
}

// The α–β tracker: P. R. Kalata, "The tracking index", IEEE Transactions on Aerospace and Electronic Systems
// 20 (1984), 174–182: with λ = T²σ_w/σ_v, r = (4 + λ − √(8λ + λ²))/4 it is α = 1 − r², β = 2(2 − α) − 4√(1 −
// α); L = [α; β/T].
void test_tracker_of_position_and_speed_has_the_gains_of_the_tracking_index() {
  const double T = 0.5, sigma_w = 3, sigma_v = 2;
  Problem problem = double_integrator(T);
  problem.plant.G = problem.plant.B;
  problem.estimator->noise = Noise::discrete;
  problem.estimator->W = MatrixXd::Constant(1, 1, sigma_w * sigma_w);
  problem.estimator->V = MatrixXd::Constant(1, 1, sigma_v * sigma_v);
  problem.estimator->Swv = MatrixXd::Zero(1, 1);
  const EstimatorSolution found = *solved(problem).estimator;
  const Digits scope(60);
  const Real index = Real(T) * T * sigma_w / sigma_v, r = (4 + index - sqrt(8 * index + index * index)) / 4;
  const Real alpha = 1 - r * r, beta = 2 * (2 - alpha) - 4 * sqrt(1 - alpha);
  TEST_ASSERT_TRUE(to_double(found.L(0, 0)) == to_double(alpha));
  TEST_ASSERT_TRUE(to_double(found.L(1, 0)) == to_double(beta / T));
}

void test_predictor_gain_is_the_gain_of_the_dual_regulator() {
  for (std::uint64_t seed = 3; seed <= seeds; seed += 3) {  // the discrete ones
    Problem problem = random_problem(seed);
    const Solution filter = solved(problem);
    const Plant plant = problem.plant;
    const Estimator noise = *problem.estimator;
    problem.plant.A = plant.A.transpose();
    problem.plant.B = plant.C.transpose();
    problem.plant.C = plant.B.transpose();
    problem.plant.D = plant.D.transpose();
    problem.regulator->Q = plant.G * noise.W * plant.G.transpose();  // in double: compared to double
    problem.regulator->Q = (problem.regulator->Q + problem.regulator->Q.transpose()).eval() / 2;
    problem.regulator->R = noise.V;
    problem.regulator->N = plant.G * noise.Swv;
    problem.estimator.reset();
    const Solution dual = solved(problem);
    const Digits scope(100);
    expect_small(distance(dual.regulator->K.transpose(), filter.estimator->L_predictor), 1e-10, "the difference");
  }
}

void test_relations_between_the_gains_and_covariances() {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Solution& found = solved_random_problem(seed);
    const EstimatorSolution& f = *found.estimator;
    const SampledPlant& p = found.plant;
    const Digits scope(100);
    const RealMatrix C = p.C, PCt = multiply(f.P_prior, C.transpose());
    expect_small(distance(multiply(C, PCt) + f.noise.V, f.S), rounding, "S");
    expect_small(distance(multiply(f.L, f.S), PCt), rounding, "L S − P Cᵀ");
    expect_small(distance(multiply(p.A, f.L) + f.M, f.L_predictor), rounding, "A L + M − L_predictor");
    expect_small(distance(multiply(f.M, f.S), multiply(p.G, f.noise.Swv)), rounding, "M S − G Swv");
    const RealMatrix keep = identity(p.A.rows()) - multiply(f.L, C);  // Joseph's form
    expect_small(distance(congruence(keep, f.P_prior) + congruence(f.L, f.noise.V), f.P_posterior), rounding,
                 "P_posterior");
    const RealMatrix next = p.A - multiply(f.L_predictor, C);
    const RealMatrix cross = multiply(p.G, multiply(f.noise.Swv, f.L_predictor.transpose()));
    const RealMatrix drive =
        congruence(p.G, f.noise.W) + congruence(f.L_predictor, f.noise.V) - cross - cross.transpose();
    expect_small(distance(congruence(next, f.P_prior) + drive, f.P_prior), rounding, "the Riccati equation");
    TEST_ASSERT_TRUE(least_scaled_eigenvalue(f.P_posterior) > -rounding);
    TEST_ASSERT_TRUE(std::abs(f.poles.front()) < 1);
  }
}

void test_outputs_of_the_online_filter_are_not_correlated() {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Solution& found = solved_random_problem(seed);
    const OnlineSolution& o = *found.online;
    const SampledNoise& noise = found.estimator->noise;
    const Digits scope(100);
    expect_small(distance(congruence(o.E, noise.V), RealMatrix(o.V.asDiagonal())), rounding, "E V Eᵀ");
    for (Index i = 0; i < o.E.rows(); ++i) {
      TEST_ASSERT_TRUE(o.E(i, i) == 1 && o.V(i) > 0);
      for (Index j = i + 1; j < o.E.cols(); ++j) TEST_ASSERT_TRUE(o.E(i, j).is_zero());
    }
    expect_small(distance(multiply(o.E, found.plant.C), o.C), rounding, "C");
    expect_small(distance(multiply(o.E, found.plant.D), o.D), rounding, "D");
  }
}

void test_online_noise_is_factored_and_free_of_what_the_outputs_tell() {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Solution& found = solved_random_problem(seed);
    const OnlineSolution& o = *found.online;
    const SampledNoise& noise = found.estimator->noise;
    const Digits scope(100);
    // w' = G w − M y'-noise has no correlation with it: G Swv Eᵀ = M diag(V), and W is what is left.
    const RealMatrix V = o.V.asDiagonal(), GS = multiply(found.plant.G, noise.Swv);
    expect_small(distance(multiply(GS, o.E.transpose()), multiply(o.M, V)), rounding, "M");
    expect_small(
        distance(congruence(found.plant.G, noise.W) - congruence(GS, *solve(noise.V, identity(V.rows()))), o.W),
        rounding, "W");
    expect_small(distance(found.plant.A - multiply(GS, *solve(noise.V, found.plant.C)), o.A_free), rounding, "A_free");
    expect_small(distance(congruence(o.G, RealMatrix(o.w.asDiagonal())), o.W), rounding, "G diag(w) Gᵀ");
    for (Index q = 0; q < o.w.size(); ++q) TEST_ASSERT_TRUE(o.w(q) > 0);
    expect_small(distance(congruence(o.U0, RealMatrix(o.D0.asDiagonal())), o.P0), rounding, "U0 diag(D0) U0ᵀ");
  }
}

void test_noise_of_rank_one_has_one_column() {
  Problem problem = two_mass();
  problem.estimator->gain = Gain::online;
  const Solution found = solved(problem);
  TEST_ASSERT_EQUAL(1, found.online->G.cols());
  TEST_ASSERT_TRUE(found.online->E(1, 0).is_zero() && found.online->E(0, 0) == 1);
  TEST_ASSERT_TRUE(is_zero(found.online->M));
}

// P ← A_free (P − P Cᵀ S⁻¹ C P) A_freeᵀ + W from P0 on, `steps` times.
RealMatrix recursion(const OnlineSolution& o, int steps) {
  RealMatrix P = o.P0;
  for (int k = 0; k < steps; ++k) {
    const RealMatrix PCt = multiply(P, o.C.transpose()), S = congruence(o.C, P) + RealMatrix(o.V.asDiagonal());
    P = congruence(o.A_free, P - multiply(PCt, *solve(S, PCt.transpose()))) + o.W;
  }
  return P;
}

void test_online_covariance_tends_to_the_steady_one() {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Solution& found = solved_random_problem(seed);
    if (std::abs(found.estimator->poles[0]) > 0.9) continue;  // 0.9^(2 · 400) is 1e-37
    const Digits scope(60);
    expect_small(distance(recursion(*found.online, 400), found.estimator->P_prior), 1e-30, "the distance");
    ++tried;
  }
  TEST_ASSERT_GREATER_THAN(5, tried);
}

void test_singular_initial_covariance_has_exact_zeros_in_D0() {
  Problem problem = double_integrator(0.1);
  problem.estimator->gain = Gain::online;
  problem.estimator->P0 = (MatrixXd(2, 2) << 1, 3, 3, 9).finished();
  const OnlineSolution found = *solved(problem).online;
  TEST_ASSERT_TRUE(found.D0(0).is_zero());
  TEST_ASSERT_TRUE(found.D0(1) == 9);
}

// A double integrator pushed by white noise of density q, its position seen in white noise of density r: L = (√2
// (q/r)^¼, (q/r)^½). (B. D. O. Anderson and J. B. Moore, Optimal Filtering, 1979, have its P.)
void test_continuous_gain_of_a_double_integrator() {
  Problem problem = double_integrator(0.1);
  problem.plant.G = Eigen::Vector2d(0, 1);
  problem.plant.H = problem.estimator->Swv = MatrixXd::Zero(1, 1);
  problem.estimator->noise = Noise::continuous;
  problem.estimator->W = MatrixXd::Constant(1, 1, 16);
  problem.estimator->V = MatrixXd::Constant(1, 1, 1);
  const Solution found = solved(problem);
  const Digits scope(50);
  expect_rounded(above(RealMatrix::Constant(1, 1, 2 * sqrt(Real(2))), RealMatrix::Constant(1, 1, Real(4))),
                 found.estimator->L_continuous, "L_continuous");
  problem.plant.sample_time = 1e-7;
  const RealMatrix of_samples = solved(problem).estimator->L_predictor / Real(1e-7);
  expect_small(distance(of_samples, found.estimator->L_continuous), 1e-6, "L_predictor / T");
  problem.estimator->noise = Noise::discrete;
  TEST_ASSERT_EQUAL(0, solved(problem).estimator->L_continuous.size());
}

// Shared noise and several outputs: the equation holds, and the filter is stable.
void test_continuous_gain_satisfies_its_equation() {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Problem problem = random_problem(seed);
    if (problem.plant.domain == Domain::discrete || problem.estimator->noise == Noise::discrete) continue;
    const EstimatorSolution& filter = *solved_random_problem(seed).estimator;
    const Digits scope(50);
    const SampledNoise noise = noise_of(problem);
    const RealMatrix A = real(problem.plant.A), C = real(problem.plant.C), G = real(problem.plant.G);
    const RealMatrix &P = filter.P_continuous, &L = filter.L_continuous, drive = congruence(G, noise.W);
    const RealMatrix turned = multiply(A, P);
    expect_small(distance(turned + turned.transpose() + drive, congruence(L, noise.V)), rounding,
                 "A P + P Aᵀ + GWGᵀ − L V Lᵀ");
    expect_small(distance(multiply(L, noise.V), multiply_transpose(P, C) + multiply(G, noise.Swv)), rounding,
                 "L V − P Cᵀ − G Swv");
    for (const ComplexReal& pole : eigenvalues(A - multiply(L, C))) TEST_ASSERT_TRUE(pole.re < 0);
    ++tried;
  }
  TEST_ASSERT_TRUE(tried >= 3);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_constant_in_noise_has_its_closed_form);
  RUN_TEST(test_tracker_of_position_and_speed_has_the_gains_of_the_tracking_index);
  RUN_TEST(test_predictor_gain_is_the_gain_of_the_dual_regulator);
  RUN_TEST(test_relations_between_the_gains_and_covariances);
  RUN_TEST(test_outputs_of_the_online_filter_are_not_correlated);
  RUN_TEST(test_online_noise_is_factored_and_free_of_what_the_outputs_tell);
  RUN_TEST(test_noise_of_rank_one_has_one_column);
  RUN_TEST(test_online_covariance_tends_to_the_steady_one);
  RUN_TEST(test_singular_initial_covariance_has_exact_zeros_in_D0);
  RUN_TEST(test_continuous_gain_of_a_double_integrator);
  RUN_TEST(test_continuous_gain_satisfies_its_equation);
  return UNITY_END();
}
