// SPDX-License-Identifier: MIT
// What delays cost: chains of them are folded, copies of them are one; the numbers are those of the full matrices.
#include <unity.h>

#include <algorithm>

#include "design/equations/refined_stein.hpp"
#include "design/gains/regulator.hpp"
#include "design/loop/compensator.hpp"
#include "design/loop/cost.hpp"
#include "design/loop/margins.hpp"
#include "design/numeric/chains.hpp"
#include "design/numeric/response.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

// Two masses, the force late by so many periods.
Problem delayed(double periods) {
  Problem problem = two_mass();
  problem.plant.delay = periods * problem.plant.sample_time;
  return problem;
}

OpenLoop loop_at_inputs(const Problem& problem, const Solution& solution) {
  return open_at_inputs(measured_plant(problem, solution.plant), compensator(problem, solution));
}

// The same loop in other coordinates, T s: no row of it is a delay.
OpenLoop disguised(const OpenLoop& loop) {
  const Index n = loop.A.rows();
  const RealMatrix T = real(Random(5).matrix(n, n)) + 4 * identity(n), inverse = *solve(T, identity(n));
  return {multiply(multiply(T, loop.A), inverse), multiply(T, loop.B), multiply(loop.C, inverse)};
}

Index count_kept(const OpenLoop& loop) { return static_cast<Index>(chains_of(loop.A, loop.B).kept().size()); }

// C (zI − A)⁻¹ B by one real system of twice the size.
ComplexMatrix direct_response(const OpenLoop& loop, const Real& angle) {
  const Index n = loop.A.rows();
  const RealMatrix re = cos(angle) * identity(n) - loop.A, im = sin(angle) * identity(n);
  const RealMatrix x = *solve(above(beside(re, -im), beside(im, re)), above(loop.B, zeros(n, loop.B.cols())));
  return {multiply(loop.C, x.topRows(n)), multiply(loop.C, x.bottomRows(n))};
}

// --- folding ----------------------------------------------------------------------------------------------------

void test_state_of_a_chain_is_its_source_some_samples_ago() {
  RealMatrix A = zeros(5, 5), B = zeros(5, 1);
  A(0, 1) = A(1, 3) = 1;     // x0 ← x1 ← x3
  A(2, 0) = 1;               // x2 ← x0
  A(3, 3) = Real(1) / 2;     // a lag
  A(4, 2) = 1, B(4, 0) = 1;  // a delay of x2 and w: more than a delay
  const Chains chains = chains_of(A, B);
  TEST_ASSERT_TRUE((chains.source == std::vector<Index>{3, 3, 3, 3, 4}));
  TEST_ASSERT_TRUE((chains.ago == std::vector<Index>{2, 1, 3, 0, 0}));
  TEST_ASSERT_TRUE((chains.kept() == std::vector<Index>{3, 4}));
}

void test_ring_of_delays_keeps_one_of_them() {
  RealMatrix A = zeros(4, 4);
  A(0, 1) = A(1, 2) = A(2, 0) = A(3, 1) = 1;
  const Chains chains = chains_of(A, zeros(4, 1));
  TEST_ASSERT_TRUE((chains.kept() == std::vector<Index>{0}));
  TEST_ASSERT_TRUE((chains.ago == std::vector<Index>{0, 2, 1, 3}));
}

// Twice: what is not a delay in plant and controller, the newest input among it.
void test_longer_delay_adds_nothing_to_solve_for() {
  for (const double periods : {5., 12., 40.}) {
    const Problem problem = delayed(periods);
    const Solution found = solved(problem);
    const Digits scope(60);
    const OpenLoop loop = loop_at_inputs(problem, found);
    TEST_ASSERT_EQUAL(2 * (4 + static_cast<Index>(periods)), loop.A.rows());
    TEST_ASSERT_EQUAL(2 * (4 + 1), count_kept({loop.A - multiply(loop.B, loop.C), loop.B, loop.C}));
  }
}

void test_folded_response_is_that_of_the_full_matrices() {
  const double rounding = 1e-9;  // of double, times the 10⁶ by which the poles at 1 make the response grow at 10⁻³
  for (const double periods : {6., 9.4}) {
    const Problem problem = delayed(periods);
    const Solution found = solved(problem);
    const Digits scope(60);
    const OpenLoop loop = loop_at_inputs(problem, found), other = disguised(loop);
    TEST_ASSERT_TRUE(count_kept(loop) < loop.A.rows() && count_kept(other) == loop.A.rows());
    const Response folded(loop.A, loop.B, loop.C), full(other.A, other.B, other.C);
    for (const double angle : {1e-3, 0.1, 0.7, 2., 3.1}) {
      const ComplexMatrix T = folded.at(angle), expected = direct_response(loop, angle), by_form = full.at(angle);
      const Real size = largest_entry(expected.re) + largest_entry(expected.im);
      expect_small(largest_entry(T.re - expected.re) / size, 1e-50, "the real part");
      expect_small(largest_entry(T.im - expected.im) / size, 1e-50, "the imaginary part");
      expect_small(largest_entry(by_form.re - expected.re) / size, 1e-50, "the real part by the Hessenberg form");
      const Eigen::MatrixXcd rough = folded.roughly_at(angle);
      const RealMatrix rough_re = real(rough.real()), rough_im = real(rough.imag());
      expect_small(largest_entry(rough_re - expected.re) / size, rounding, "the real part in double");
      expect_small(largest_entry(rough_im - expected.im) / size, rounding, "the imaginary part in double");
    }
  }
}

// Several inputs late: every one has its own chain.
void test_chains_of_several_inputs_are_folded_together() {
  Random random(3);
  const MatrixXd A = 0.3 * random.matrix(4, 4), B = random.matrix(4, 2), C = random.matrix(2, 4);
  Problem problem = problem_of(Domain::discrete, 1, A, B, C);
  problem.plant.delay = 9;
  const Solution found = solved(problem);
  const Digits scope(60);
  const OpenLoop loop = loop_at_inputs(problem, found);
  const RealMatrix closed = loop.A - multiply(loop.B, loop.C);
  TEST_ASSERT_EQUAL(2 * (4 + 2), count_kept({closed, loop.B, loop.C}));
  const ComplexMatrix T = Response(closed, loop.B, loop.C).at(0.4);
  const ComplexMatrix expected = direct_response({closed, loop.B, loop.C}, 0.4);
  expect_small(distance(T.re, expected.re) + distance(T.im, expected.im), 1e-50, "the response");
}

// --- the design -------------------------------------------------------------------------------------------------

void expect_same_margins(const Margins& a, const Margins& b) {
  TEST_ASSERT_TRUE(a.gain_dB == b.gain_dB && a.phase_deg == b.phase_deg && a.disk == b.disk);
}

void test_margins_of_a_delayed_loop_are_those_of_its_full_matrices_to_the_last_bit() {
  for (const double periods : {6., 7.5}) {
    const Problem problem = delayed(periods);
    const Solution found = solved(problem);
    const Digits scope(100);
    const OpenLoop loop = loop_at_inputs(problem, found);
    std::vector<ComplexReal> poles;
    for (const std::complex<double>& pole : found.loop.poles) poles.push_back({pole.real(), pole.imag()});
    expect_same_margins(margins(loop, poles), found.loop.at_input);
    expect_same_margins(margins(disguised(loop), poles), found.loop.at_input);
    expect_same_margins(rough_margins(disguised(loop), poles), rough_margins(loop, poles));
  }
}

// X and the cost by the closed form, and by the Stein equations of the whole state.
void test_cost_of_a_delayed_loop_is_that_of_its_full_equations_to_the_last_bit() {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Problem problem = delayed(seed % 2 == 0 ? 4 : 5.3);
    if (seed & 2) problem.regulator->cost = Cost::discrete;
    if (seed & 4) problem.regulator->integral = Integral{{0}, MatrixXd::Constant(1, 1, 2)};
    if (seed == 6) problem.regulator->input_rate = MatrixXd::Constant(1, 1, 0.2);
    if (seed == 5) problem.estimator->form = Form::predictor;
    const Solution found = solved(problem);
    const Digits scope(100);
    const Samples samples = sample(problem);
    const RiccatiEquation e = regulator_equation(problem, samples);
    const SteadyRegulator again = solve_regulator(problem, samples, RealMatrix());
    const std::optional<RealMatrix> X = solve_stein(again.riccati.closed, step_cost(e, again.riccati.K));
    TEST_ASSERT_TRUE(X.has_value());
    for (Index i = 0; i < X->size(); ++i) {
      const Real &by_equation = X->data()[i], &by_form = found.regulator->X.data()[i];
      if (abs(by_equation) > 1e-60)  // of a zero the equation leaves the rounding
        TEST_ASSERT_TRUE(to_double(by_equation) == to_double(by_form));
    }
    const std::optional<SteadyCost> cost = steady_cost(problem, samples, compensator(problem, found));
    TEST_ASSERT_TRUE(to_double(cost->per_sample) == *found.loop.cost_per_sample);
  }
}

// With a decay X is no cost of the loop, nor with a continuous cost that of its samples: the equation of the states
// says it.
void test_cost_without_a_closed_form_is_that_of_any_controller() {
  Problem decaying = delayed(4);
  decaying.regulator->decay = 1.05;
  Problem continuous = two_mass();
  continuous.plant.sample_time = 0.01;
  continuous.regulator->cost = Cost::continuous;
  for (const Problem& problem : {decaying, continuous}) {
    const Solution found = solved(problem);
    const Digits scope(60);
    const std::optional<SteadyCost> any = steady_cost(problem, sample(problem), compensator(problem, found));
    TEST_ASSERT_TRUE(any.has_value() && found.loop.cost_per_sample.has_value());
    expect_small(abs(any->per_sample / *found.loop.cost_per_sample - 1), 1e-14, "the difference");
  }
}

// Of radius 0.9; 1 − 10⁻⁹, where double has too few digits to refine with; and 1.1.
void test_refined_stein_equation_has_the_solution_of_the_doubling() {
  const Digits scope(60);
  for (const double radius : {0.9, 1 - 1e-9}) {
    RealMatrix A = zeros(9, 9);
    for (Index i = 0; i + 1 < 9; ++i) A(i, i + 1) = 1;
    A(8, 0) = Real(radius) / 2;
    A(0, 0) = radius;
    A(0, 1) = 0;
    const RealMatrix Y = real(Random(2).semidefinite(9, 3));
    const std::optional<RealMatrix> X = refined_stein(A, Y), expected = solve_stein(A, Y);
    TEST_ASSERT_TRUE(X.has_value() && expected.has_value());
    expect_small(distance(*X, *expected), 1e-40, "X");
    expect_small(largest_entry(Y + transpose_congruence(A, *X) - *X) / largest_entry(*X), 1e-48, "the residual");
  }
  TEST_ASSERT_FALSE(refined_stein(Real(1.1) * identity(3), identity(3)).has_value());
}

// --- states that are equal --------------------------------------------------------------------------------------

// s = [x; c; d]: c copies what x0 was, over two samples, and d copies c's source again.
void test_copies_of_a_chain_are_one_state_each() {
  RealMatrix A = zeros(6, 6), B = zeros(6, 1);
  A(0, 0) = A(0, 2) = Real(1) / 2, A(0, 4) = Real(1) / 8, B(0, 0) = 1;
  A(1, 0) = Real(1) / 4, A(1, 1) = Real(1) / 3;
  A(2, 3) = A(4, 5) = 1;            // two chains …
  A(3, 1) = A(5, 1) = Real(2) / 3;  // … of the same signal
  const Merged merged = with_equal_states_merged(A, B);
  TEST_ASSERT_EQUAL(4, merged.A.rows());
  TEST_ASSERT_TRUE(merged.A(0, 2) == Real(1) / 2 + Real(1) / 8);
  TEST_ASSERT_TRUE(is_zero(multiply(A, merged.spread) - multiply(merged.spread, merged.A)));
  TEST_ASSERT_TRUE(is_zero(B - multiply(merged.spread, merged.B)));
  B(5, 0) = 1;  // now the chains hear different things
  TEST_ASSERT_EQUAL(6, with_equal_states_merged(A, B).A.rows());
}

// The controller's copies of the inputs on their way differ from these only at the start. By sweeps alone 24 such zeros
// become a ring of radius 10^(−50/24).
void test_copies_of_inputs_on_their_way_have_poles_at_zero_exactly() {
  const int periods = 24;
  const Solution found = solved(delayed(periods));
  const Poles& poles = found.loop.rounded->poles;
  TEST_ASSERT_EQUAL(2 * (4 + periods), poles.size());
  TEST_ASSERT_EQUAL(periods, std::count(poles.begin(), poles.end(), std::complex<double>(0, 0)));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_state_of_a_chain_is_its_source_some_samples_ago);
  RUN_TEST(test_ring_of_delays_keeps_one_of_them);
  RUN_TEST(test_longer_delay_adds_nothing_to_solve_for);
  RUN_TEST(test_folded_response_is_that_of_the_full_matrices);
  RUN_TEST(test_chains_of_several_inputs_are_folded_together);
  RUN_TEST(test_margins_of_a_delayed_loop_are_those_of_its_full_matrices_to_the_last_bit);
  RUN_TEST(test_cost_of_a_delayed_loop_is_that_of_its_full_equations_to_the_last_bit);
  RUN_TEST(test_cost_without_a_closed_form_is_that_of_any_controller);
  RUN_TEST(test_refined_stein_equation_has_the_solution_of_the_doubling);
  RUN_TEST(test_copies_of_a_chain_are_one_state_each);
  RUN_TEST(test_copies_of_inputs_on_their_way_have_poles_at_zero_exactly);
  return UNITY_END();
}
