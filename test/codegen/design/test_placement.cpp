// SPDX-License-Identifier: MIT
// Poles go where they are wanted, to all digits, by one input or several, by duality for the observer; what cannot
// be placed is refused for its reason.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include <unity.h>

#include "design/equations/placement.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Complex = std::complex<double>;
using Eigen::MatrixXd;

namespace {

// Of simple poles in the runs' last digits; what the eigenvectors' condition takes is far less than half of 100.
const double last_digits = 1e-40;

WantedPoles random_poles(Random& random, Index count) {
  WantedPoles wanted;
  while (static_cast<Index>(wanted.values.size()) + 1 < count) {
    const Complex pole = std::polar(0.9 * std::abs(random.uniform()), 3 * random.uniform());
    if (random.uniform() < 0) {
      wanted.values.push_back(pole);
      wanted.values.push_back(std::conj(pole));
    } else {
      wanted.values.emplace_back(0.9 * random.uniform(), 0);
    }
  }
  if (static_cast<Index>(wanted.values.size()) < count) wanted.values.emplace_back(0.9 * random.uniform(), 0);
  return wanted;
}

// A random plant of either domain with nothing but poles to be placed.
Problem placed_problem(std::uint64_t seed) {
  Random random(seed);
  const Index nx = 1 + static_cast<Index>(seed % 7), nu = 1 + static_cast<Index>(seed % 3);
  const Index ny = 1 + static_cast<Index>(seed / 3 % 3);
  Problem problem = problem_of(seed % 2 ? Domain::continuous : Domain::discrete, 0.5, random.matrix(nx, nx),
                               random.matrix(nx, nu), random.matrix(ny, nx));
  problem.regulator = Regulator();
  problem.regulator->poles = random_poles(random, nx);
  problem.estimator = Estimator();
  problem.estimator->x0 = Eigen::VectorXd::Zero(nx);
  problem.estimator->form = seed % 4 < 2 ? Form::predictor : Form::filter;
  problem.estimator->poles = random_poles(random, nx);
  return problem;
}

void expect_poles(const RealMatrix& closed, const WantedPoles& wanted, double bound) {
  std::vector<ComplexReal> found = eigenvalues(closed);
  TEST_ASSERT_EQUAL(wanted.values.size(), found.size());
  for (const Complex& pole : wanted.values) {
    const auto away = [&](const ComplexReal& z) { return Real(hypot(z.re - pole.real(), z.im - pole.imag())); };
    const auto nearest = std::min_element(
        found.begin(), found.end(), [&](const ComplexReal& a, const ComplexReal& b) { return away(a) < away(b); });
    expect_small(away(*nearest), bound, "the distance to a wanted pole");
    found.erase(nearest);
  }
}

void test_random_plants_with_one_to_three_inputs_and_outputs() {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Problem problem = placed_problem(seed);
    const Solution found = solved(problem);
    const Digits scope(found.numerics.digits);
    const SampledPlant& plant = found.plant;
    expect_poles(plant.A - multiply(plant.B, found.regulator->K), *problem.regulator->poles, last_digits);
    const RealMatrix &L = found.estimator->L, &L_predictor = found.estimator->L_predictor;
    expect_poles(plant.A - multiply(L_predictor, plant.C), *problem.estimator->poles, last_digits);
    const bool filtered = problem.estimator->form == Form::filter;
    TEST_ASSERT_TRUE(is_zero(filtered ? found.estimator->M : L));
    if (filtered)
      expect_poles(plant.A - multiply(L, multiply(plant.C, plant.A)), *problem.estimator->poles, last_digits);
  }
}

// Without weights there is no cost, without noise no covariance; margins and poles are there.
void test_placed_loop_has_margins_and_no_cost() {
  const Solution found = solved(placed_problem(16));
  TEST_ASSERT_FALSE(found.loop.cost_per_sample || found.loop.cost_per_second);
  TEST_ASSERT_TRUE(found.loop.at_input.disk.has_value());
  TEST_ASSERT_EQUAL(0, found.regulator->X.size() + found.estimator->P_prior.size() + found.estimator->S.size());
  TEST_ASSERT_EQUAL(6, found.loop.poles.size());
}

void test_weights_with_an_observer_and_noise_with_placed_poles() {
  Problem problem = two_mass();
  problem.estimator->poles = WantedPoles{{0.2, 0.25, {0.1, 0.1}, {0.1, -0.1}}, false};
  problem.estimator->form = Form::predictor;
  const Solution observed = solved(problem);
  TEST_ASSERT_FALSE(observed.loop.cost_per_sample.has_value());
  expect_rounded(observed.regulator->K, solved(two_mass()).regulator->K, "K");
  problem = two_mass();
  problem.regulator->poles = WantedPoles{{0.5, 0.5, 0.5, 0.5}, false};
  const Solution placed = solved(problem);
  expect_rounded(placed.estimator->L, solved(two_mass()).estimator->L, "L");
  TEST_ASSERT_TRUE(placed.regulator->poles[3] == 0.5);
}

// K = [1/T² 3/(2T)] takes a sampled double integrator to rest in two samples.
void test_deadbeat_of_a_double_integrator_has_its_closed_form() {
  Problem problem = double_integrator(0.1);
  problem.estimator.reset();
  problem.regulator->poles = WantedPoles{{0, 0}, false};
  const Solution found = solved(problem);
  const Digits scope(60);
  const Real T = 0.1;
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 0)) == to_double(1 / (T * T)));
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 1)) == to_double(3 / (2 * T)));
}

// (z − e^(−T))(z − e^(−2T)) for x⁺ = x + Tv + T²/2 u, v⁺ = v + Tu.
void test_poles_of_the_s_plane_are_mapped() {
  Problem problem = double_integrator(0.1);
  problem.estimator.reset();
  problem.regulator->poles = WantedPoles{{-1, -2}, true};
  const Solution found = solved(problem);
  const Digits scope(60);
  const Real T = 0.1, a = exp(-T), b = exp(-2 * T);
  // z² + (T²/2 k₀ + T k₁ − 2) z + 1 + T²/2 k₀ − T k₁
  const Real sum = 2 - a - b, product = a * b - 1;
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 0)) == to_double((sum + product) / (T * T)));
  TEST_ASSERT_TRUE(to_double(found.regulator->K(0, 1)) == to_double((sum - product) / (2 * T)));
}

// The regulator's poles are those of the plant and of the input on its way, the observer's of the plant alone.
void test_delayed_plant_has_poles_for_the_input_on_its_way() {
  Problem problem = double_integrator(0.1);
  problem.plant.delay = 0.04;
  problem.regulator = Regulator();
  problem.regulator->poles = WantedPoles{{0.5, 0.25, 0.125}, false};
  problem.estimator->poles = WantedPoles{{0.5, 0.25}, false};
  for (const Form form : {Form::filter, Form::predictor}) {
    problem.estimator->form = form;
    const Solution found = solved(problem);
    const Digits scope(found.numerics.digits);
    const SampledPlant& plant = found.plant;
    expect_poles(plant.A - multiply(plant.B, found.regulator->K), *problem.regulator->poles, last_digits);
    expect_poles(plant.A - multiply(found.estimator->L_predictor, plant.C), WantedPoles{{0.5, 0.25, 0}, false},
                 last_digits);
    TEST_ASSERT_TRUE(found.estimator->L_predictor(2, 0).is_zero());
  }
}

Problem placement_of(const MatrixXd& A, const MatrixXd& B, const std::vector<Complex>& poles) {
  Problem problem = problem_of(Domain::discrete, 1, A, B, MatrixXd::Identity(1, A.rows()));
  problem.estimator.reset();
  problem.regulator = Regulator();
  problem.regulator->poles = WantedPoles{poles, false};
  return problem;
}

// As many independent inputs as states leave every eigenvector free: orthogonal ones.
void test_poles_that_repeat_as_often_as_there_are_inputs() {
  Random random(3);
  const Problem problem = placement_of(random.matrix(3, 3), random.matrix(3, 3), {0.5, 0.5, 0.5});
  const Solution found = solved(problem);
  const Digits scope(50);
  const RealMatrix closed = found.plant.A - multiply(found.plant.B, found.regulator->K);
  expect_small(largest_entry(closed - Real(0.5) * identity(3)), last_digits, "A − BK − 1/2");
}

void test_wanted_pole_that_the_plant_has_already() {
  const MatrixXd A = Eigen::Vector3d(0.5, 0.25, 2).asDiagonal();
  Random random(4);
  const Problem problem = placement_of(A, random.matrix(3, 2), {0.5, 0.25, 0.125});
  const Solution found = solved(problem);
  const Digits scope(50);
  expect_poles(found.plant.A - multiply(found.plant.B, found.regulator->K), *problem.regulator->poles, last_digits);
}

void test_second_input_that_is_a_multiple_of_the_first_shares_the_work() {
  Random random(5);
  const MatrixXd A = random.matrix(4, 4), b = random.matrix(4, 1);
  MatrixXd B(4, 2);
  B << b, 2 * b;
  const std::vector<Complex> poles = {0.5, 0.5, 0.5, 0.25};
  const Solution one = solved(placement_of(A, b, poles)), two = solved(placement_of(A, B, poles));
  const Digits scope(60);
  expect_rounded(one.regulator->K / 5, two.regulator->K.topRows(1), "the first input's share");
  expect_rounded(one.regulator->K * 2 / 5, two.regulator->K.bottomRows(1), "the second input's share");
}

// ‖X‖‖X⁻¹‖ in the Frobenius norm of the unit eigenvectors of A − BK: 4 when four are orthogonal.
double eigenvector_condition(const Solution& found) {
  const RealMatrix closed = found.plant.A - multiply(found.plant.B, found.regulator->K);
  MatrixXd rounded(closed.rows(), closed.cols());
  for (Index i = 0; i < rounded.size(); ++i) rounded.data()[i] = to_double(closed.data()[i]);
  const Eigen::MatrixXcd X = Eigen::EigenSolver<MatrixXd>(rounded).eigenvectors();
  return X.norm() * X.inverse().norm();
}

// The chemical reactor of Kautsky, Nichols and Van Dooren (1985), example 1, with its poles −0.2, −0.5, −5.0566,
// −8.6659.
void test_published_reactor_gets_well_conditioned_eigenvectors() {
  MatrixXd A(4, 4), B(4, 2);
  A << 1.38, -0.2077, 6.715, -5.676, -0.5814, -4.29, 0, 0.675, 1.067, 4.273, -6.654, 5.893, 0.048, 4.273, 1.343, -2.104;
  B << 0, 0, 5.679, 0, 1.136, -3.146, 1.136, 0;
  const Digits scope(50);
  std::vector<ComplexReal> poles;
  for (const double pole : {-0.2, -0.5, -5.0566, -8.6659}) poles.push_back({Real(pole), Real(0)});
  const std::optional<PlacementChoice> choice = choose_placement(real(A), real(B), poles);
  const std::optional<RealMatrix> K = place(real(A), real(B), poles, *choice);
  Solution found;
  found.plant.A = real(A);
  found.plant.B = real(B);
  found.regulator.emplace();
  found.regulator->K = *K;
  TEST_ASSERT_TRUE(eigenvector_condition(found) < 7);
}

void expect_refusal(const Problem& problem, const char* key, const char* part) {
  Findings findings;
  TEST_ASSERT_FALSE_MESSAGE(solve(problem, findings).has_value(), part);
  TEST_ASSERT_EQUAL_STRING(key, findings[0].key.c_str());
  TEST_ASSERT_TRUE_MESSAGE(findings[0].message.find(part) != std::string::npos, findings[0].message.c_str());
}

void test_poles_that_cannot_be_wanted() {
  const MatrixXd A = (MatrixXd(2, 2) << 1, 1, 0, 1).finished(), B = Eigen::Vector2d(0, 1);
  const char* key = "pole_placement.poles";
  expect_refusal(placement_of(A, B, {0.5}), key, "expected 2 poles");
  expect_refusal(placement_of(A, B, {{0.5, 0.1}, 0.5}), key, "[0.5, 0.1] lacks its conjugate");
  expect_refusal(placement_of(A, B, {{0.8, 0.6}, {0.8, -0.6}}), key, "[0.8, 0.6] is not stable");
  Problem problem = placement_of(A, B, {0, -1});
  problem.regulator->poles->continuous = true;
  expect_refusal(problem, "pole_placement.continuous_poles", "0 is not stable: expected a negative real part");
}

void test_stable_mode_that_no_input_reaches_cannot_be_moved() {
  expect_refusal(placement_of(Eigen::Vector2d(0.5, 0.25).asDiagonal(), Eigen::Vector2d(1, 0), {0.1, 0.2}), "plant.B",
                 "the mode at z = 0.25 (state x1) is reached by no input: its pole cannot be moved");
}

void test_filter_form_cannot_move_what_is_forgotten_before_it_is_seen() {
  Problem problem = placement_of((MatrixXd(2, 2) << 0, 1, 0, 0).finished(), Eigen::Vector2d(0, 1), {0.1, 0.2});
  problem.estimator = Estimator();
  problem.estimator->poles = WantedPoles{{0.1, 0.2}, false};
  problem.estimator->form = Form::predictor;
  solved(problem);
  problem.estimator->form = Form::filter;
  expect_refusal(problem, "plant.C", "the mode at z = 0 ");
}

void test_pole_that_repeats_more_often_than_there_are_inputs() {
  Random random(6);
  expect_refusal(placement_of(random.matrix(4, 4), random.matrix(4, 2), {0.5, 0.5, 0.5, 0.1}), "pole_placement.poles",
                 "0.5 is wanted more than 2 times");
}

// Three integrators in a row for one input, one for the other: two poles, both double, have no four eigenvectors
// (H. H. Rosenbrock, "State-space and multivariable theory", 1970: the degrees 2, 2 do not majorise 3, 1).
void test_repeated_poles_against_the_reachability_indices() {
  MatrixXd A = MatrixXd::Zero(4, 4), B = MatrixXd::Zero(4, 2);
  A(0, 1) = A(1, 2) = B(2, 0) = B(3, 1) = 1;
  expect_refusal(placement_of(A, B, {0.5, 0.5, 0.25, 0.25}), "pole_placement.poles", "no independent eigenvectors");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_random_plants_with_one_to_three_inputs_and_outputs);
  RUN_TEST(test_placed_loop_has_margins_and_no_cost);
  RUN_TEST(test_weights_with_an_observer_and_noise_with_placed_poles);
  RUN_TEST(test_deadbeat_of_a_double_integrator_has_its_closed_form);
  RUN_TEST(test_poles_of_the_s_plane_are_mapped);
  RUN_TEST(test_delayed_plant_has_poles_for_the_input_on_its_way);
  RUN_TEST(test_poles_that_repeat_as_often_as_there_are_inputs);
  RUN_TEST(test_wanted_pole_that_the_plant_has_already);
  RUN_TEST(test_second_input_that_is_a_multiple_of_the_first_shares_the_work);
  RUN_TEST(test_published_reactor_gets_well_conditioned_eigenvectors);
  RUN_TEST(test_poles_that_cannot_be_wanted);
  RUN_TEST(test_stable_mode_that_no_input_reaches_cannot_be_moved);
  RUN_TEST(test_filter_form_cannot_move_what_is_forgotten_before_it_is_seen);
  RUN_TEST(test_pole_that_repeats_more_often_than_there_are_inputs);
  RUN_TEST(test_repeated_poles_against_the_reachability_indices);
  return UNITY_END();
}
