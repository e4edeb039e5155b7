// SPDX-License-Identifier: MIT
// Sampled plants, costs and noises against closed forms, to the last bit, and against numerical integration.
#include <unity.h>

#include "design/equations/sampling.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

const unsigned digits = 120;  // of the closed forms

RealMatrix matrix(Index rows, Index columns, std::initializer_list<Real> entries) {
  RealMatrix result(rows, columns);
  Index i = 0;
  for (const Real& entry : entries) {
    result(i / columns, i % columns) = entry;
    ++i;
  }
  return result;
}

Problem scalar_plant(double a, double sample_time) {
  return problem_of(Domain::continuous, sample_time, Eigen::MatrixXd::Constant(1, 1, a),
                    Eigen::MatrixXd::Constant(1, 1, 1), Eigen::MatrixXd::Constant(1, 1, 1));
}

void test_first_order_lag_has_its_closed_form() {
  const double rate = 0.3, T = 0.7;
  const Solution found = solved(scalar_plant(-rate, T));
  const Digits scope(digits);
  const Real a = rate, E = exp(-a * T), first = (1 - E) / a, second = (1 - E * E) / (2 * a);
  expect_rounded(matrix(1, 1, {E}), found.plant.A, "A");
  expect_rounded(matrix(1, 1, {first}), found.plant.B, "B");
  expect_rounded(matrix(1, 1, {second}), found.regulator->cost.Q, "Q");
  expect_rounded(matrix(1, 1, {(first - second) / a}), found.regulator->cost.N, "N");
  expect_rounded(matrix(1, 1, {T + (T - 2 * first + second) / (a * a)}), found.regulator->cost.R, "R");
  expect_rounded(matrix(1, 1, {second}), found.estimator->noise.W, "W");
  expect_rounded(matrix(1, 1, {1 / Real(T)}), found.estimator->noise.V, "V");
}

void check_double_integrator(double sample_time) {
  const Solution found = solved(double_integrator(sample_time));
  const Digits scope(digits);
  const Real T = sample_time, T2 = T * T / 2, T3 = T * T * T / 3;
  expect_rounded(matrix(2, 2, {1, T, 0, 1}), found.plant.A, "A");
  expect_rounded(matrix(2, 1, {T2, T}), found.plant.B, "B");
  expect_rounded(matrix(2, 2, {T, T2, T2, T + T3}), found.regulator->cost.Q, "Q");
  expect_rounded(matrix(2, 1, {T3 / 2, T2 + T * T3 * 3 / 8}), found.regulator->cost.N, "N");
  expect_rounded(matrix(1, 1, {T + T3 + T * T * T3 * 3 / 20}), found.regulator->cost.R, "R");
  expect_rounded(matrix(2, 2, {T + T3, T2, T2, T}), found.estimator->noise.W, "W");
}

void test_double_integrator_has_its_closed_form() { check_double_integrator(0.01); }
void test_double_integrator_with_a_period_of_a_nanosecond() { check_double_integrator(1e-9); }
void test_double_integrator_with_a_period_of_a_thousand_seconds() { check_double_integrator(1000); }

void test_harmonic_oscillator_has_its_closed_form() {
  const double frequency = 3, T = 0.4;
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 2) << 0, 1, -frequency * frequency, 0).finished();
  const Solution found = solved(problem_of(Domain::continuous, T, A, Eigen::Vector2d(0, 1), Eigen::RowVector2d(1, 0)));
  const Digits scope(digits);
  const Real w = frequency, c = cos(w * T), s = sin(w * T);
  expect_rounded(matrix(2, 2, {c, s / w, -w * s, c}), found.plant.A, "A");
  expect_rounded(matrix(2, 1, {(1 - c) / (w * w), s / w}), found.plant.B, "B");
}

// The two rates differ by 1e10: one block exponential would hold e^(+1e6 T).
void check_stiff_pair(double sample_time) {
  const double slow_rate = -1e-4, fast_rate = -1e6;
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 2) << slow_rate, 1, 0, fast_rate).finished();
  const Solution found =
      solved(problem_of(Domain::continuous, sample_time, A, Eigen::Vector2d(0, 1), Eigen::RowVector2d(1, 0)));
  const Digits scope(digits);
  const Real s = slow_rate, f = fast_rate, T = sample_time, slow = exp(s * T), fast = exp(f * T);
  expect_rounded(matrix(2, 2, {slow, (slow - fast) / (s - f), 0, fast}), found.plant.A, "A");
  expect_rounded(matrix(2, 1, {((slow - 1) / s - (fast - 1) / f) / (s - f), (fast - 1) / f}), found.plant.B, "B");
}

void test_stiff_plant_whose_fast_mode_has_died_out() { check_stiff_pair(1); }
void test_stiff_plant_whose_fast_mode_is_too_small_for_a_double() { check_stiff_pair(1000); }
void test_stiff_plant_sampled_within_its_fast_mode() { check_stiff_pair(1e-7); }

// Mode −700 leaves 1e-304: far below the digits beside the other entries, and still a double.
void test_tiny_entry_beside_large_ones_keeps_all_its_digits() {
  const Eigen::MatrixXd A = Eigen::Vector2d(-700, 1).asDiagonal();
  const Solution found = solved(problem_of(Domain::continuous, 1, A, Eigen::Vector2d(1, 1), Eigen::RowVector2d(1, 1)));
  const Digits scope(digits);
  expect_rounded(matrix(2, 2, {exp(Real(-700)), 0, 0, exp(Real(1))}), found.plant.A, "A");
}

// The entry of the highest order, T⁵/120, is 1e-47 of the largest.
void test_chain_of_integrators_keeps_its_smallest_entry() {
  const Index nx = 6;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(nx, nx);
  for (Index i = 0; i + 1 < nx; ++i) A(i, i + 1) = 1;
  HeldPlant plant;
  const Digits scope(50);
  plant.A = real(A);
  plant.B = identity(nx).col(nx - 1);
  const SampledPeriod period = sample(plant, 1e-9);
  const Real T = 1e-9;
  TEST_ASSERT_TRUE(to_double(period.A(0, 5)) == to_double(pow(T, 5) / 120));
  TEST_ASSERT_TRUE(to_double(period.B(0, 0)) == to_double(pow(T, 6) / 720));
}

// e^(Ft) by its plain series: good for the short times used here.
RealMatrix exponential(const RealMatrix& F, const Real& t) {
  RealMatrix sum = identity(F.rows()), term = sum;
  for (int k = 1; k < 80; ++k) {
    term = multiply(F, term) * (t / k);
    sum += term;
  }
  return sum;
}

// Composite Simpson: the error of 64 panels is (1/64)⁴ of the fourth derivative, a few 1e-8 here.
const double simpson_error = 1e-6;

template <typename Integrand>
RealMatrix simpson(const Integrand& f, double T) {
  const int panels = 64;
  RealMatrix sum = f(Real(0)) + f(Real(T));
  for (int i = 1; i < 2 * panels; ++i) sum += Real(i % 2 == 1 ? 4 : 2) * f(Real(T) * i / (2 * panels));
  return sum * (Real(T) / (6 * panels));
}

void test_cost_and_noise_of_a_random_plant_agree_with_quadrature() {
  Random random(3);
  const Digits scope(30);
  const double T = 0.8;
  HeldPlant plant = {real(random.matrix(3, 3)), real(random.matrix(3, 2)), real(random.semidefinite(5, 4)),
                     real(random.semidefinite(3, 2))};
  RealMatrix F = zeros(5, 5);
  F.topLeftCorner(3, 3) = plant.A;
  F.topRightCorner(3, 2) = plant.B;
  const SampledPeriod period = sample(plant, T);
  const auto cost = [&](const Real& t) { return transpose_congruence(exponential(F, t), plant.cost); };
  expect_small(distance(period.cost, simpson(cost, T)), simpson_error, "the cost's difference");
  const auto noise = [&](const Real& t) { return congruence(exponential(plant.A, t), plant.noise); };
  expect_small(distance(period.noise, simpson(noise, T)), simpson_error, "the noise's difference");
  const auto share = [&](const Real& t) {
    const RealMatrix W = sample(HeldPlant{plant.A, plant.B, RealMatrix(), plant.noise}, to_double(t)).noise;
    return RealMatrix(identity(1) * trace_of_product(plant.cost.topLeftCorner(3, 3), W));
  };
  const RealMatrix own = simpson([&](const Real& t) { return t.is_zero() ? zeros(1, 1) : share(t); }, T);
  expect_small(distance(identity(1) * period.noise_cost, own), simpson_error, "the noise's share");
}

void test_two_short_periods_make_one_long_one() {
  Random random(9);
  const Digits scope(50);
  HeldPlant plant = {real(random.matrix(4, 4)), real(random.matrix(4, 1)), real(random.semidefinite(5, 5)),
                     real(random.semidefinite(4, 4))};
  const SampledPeriod half = sample(plant, 0.375), whole = sample(plant, 0.75);
  const double rounding = 1e-45;
  expect_small(distance(multiply(half.A, half.A), whole.A), rounding, "A");
  expect_small(distance(multiply(half.A, half.B) + half.B, whole.B), rounding, "B");
  expect_small(distance(congruence(half.A, half.noise) + half.noise, whole.noise), rounding, "the noise");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_first_order_lag_has_its_closed_form);
  RUN_TEST(test_double_integrator_has_its_closed_form);
  RUN_TEST(test_double_integrator_with_a_period_of_a_nanosecond);
  RUN_TEST(test_double_integrator_with_a_period_of_a_thousand_seconds);
  RUN_TEST(test_harmonic_oscillator_has_its_closed_form);
  RUN_TEST(test_stiff_plant_whose_fast_mode_has_died_out);
  RUN_TEST(test_stiff_plant_whose_fast_mode_is_too_small_for_a_double);
  RUN_TEST(test_stiff_plant_sampled_within_its_fast_mode);
  RUN_TEST(test_tiny_entry_beside_large_ones_keeps_all_its_digits);
  RUN_TEST(test_chain_of_integrators_keeps_its_smallest_entry);
  RUN_TEST(test_cost_and_noise_of_a_random_plant_agree_with_quadrature);
  RUN_TEST(test_two_short_periods_make_one_long_one);
  return UNITY_END();
}
