// SPDX-License-Identifier: MIT
// Whole designs: numbers from an independent source to the last bit, digits as the problem wants them, the
// same every time.
#include <chrono>
#include <cmath>
#include <thread>

#include <unity.h>

#include "design/progress.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

// Scilab's lqe example, by reference.py.
void test_two_mass_agrees_with_an_independent_solver_to_the_last_bit() {
  const Solution found = solved(two_mass());
  const MatrixXd K =
      (MatrixXd(1, 4) << 2.4226156789566144, 2.1417978292566491, -0.33327203942904532, 1.9239638074097958).finished();
  const MatrixXd L = (MatrixXd(4, 2) << 0.7008787708470462, 0.0350096186852598,  //
                      0.83040338046772444, -0.10583810842648636,                 //
                      0.0350096186852598, 0.2635524708484982,                    //
                      0.17161791353928399, 0.078661028195893351)
                         .finished();
  expect_rounded(real(K), found.regulator->K, "K");
  expect_rounded(real(L), found.estimator->L, "L");
  TEST_ASSERT_EQUAL(100, found.numerics.digits);
}

void test_random_problems_of_both_domains_are_solved() {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Solution found = solved(random_problem(seed));
    for (const std::complex<double>& pole : found.loop.poles) TEST_ASSERT_TRUE(std::abs(pole) < 1);
    TEST_ASSERT_TRUE(found.numerics.condition >= 1);
  }
}

bool same(const RealMatrix& a, const RealMatrix& b) {
  for (Index i = 0; i < a.size(); ++i)
    if (to_double(a.data()[i]) != to_double(b.data()[i])) return false;
  return a.size() == b.size();
}

void test_same_problem_has_the_same_numbers_whatever_digits_are_in_force() {
  const Solution first = solved(random_problem(5));
  const Digits scope(17);
  const Solution second = solved(random_problem(5));
  TEST_ASSERT_EQUAL(17, Real::default_precision());
  TEST_ASSERT_TRUE(same(first.regulator->X, second.regulator->X) && same(first.estimator->L, second.estimator->L));
  TEST_ASSERT_TRUE(*first.loop.at_input.phase_deg == *second.loop.at_input.phase_deg);
  TEST_ASSERT_TRUE(*first.loop.at_input.disk == *second.loop.at_input.disk);
}

// e^100 in one period: the filter's pole is the difference of numbers of 1e43. (With L = 1 to a double it is 0; no
// double of K is near enough to stabilise.)
void test_fast_unstable_plant_takes_more_digits() {
  const MatrixXd one = MatrixXd::Constant(1, 1, 1);
  Problem problem = problem_of(Domain::continuous, 1, 100 * one, one, one);
  problem.regulator.reset();
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(found.numerics.digits > 100);
  const Digits scope(300);
  TEST_ASSERT_TRUE(to_double(found.plant.A(0, 0)) == to_double(exp(Real(100))));
}

// An unstable mode behind a coupling of 1e-40.
void test_nearly_unreached_mode_takes_more_digits() {
  MatrixXd A(2, 2);
  A << 1.5, 1e-40, 0, 0.5;
  Problem problem = problem_of(Domain::discrete, 1, A, Eigen::Vector2d(0, 1), MatrixXd::Identity(2, 2));
  problem.estimator.reset();
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(found.numerics.digits > 100);
  TEST_ASSERT_TRUE(std::abs(found.loop.poles[0]) < 0.9);
}

void expect_last_refusal(double coupling, const char* key, const char* part) {
  MatrixXd A(2, 2);
  A << 1.5, coupling, 0, 0.5;
  Problem problem = problem_of(Domain::discrete, 1, A, Eigen::Vector2d(0, 1), MatrixXd::Identity(2, 2));
  problem.estimator.reset();
  Findings findings;
  TEST_ASSERT_FALSE(solve(problem, findings).has_value());
  TEST_ASSERT_EQUAL(1, findings.size());
  TEST_ASSERT_EQUAL_STRING(key, findings[0].key.c_str());
  TEST_ASSERT_TRUE(findings[0].message.find(part) != std::string::npos);
}

void test_what_400_digits_do_not_settle_is_refused() { expect_last_refusal(1e-200, "design", "400 digits"); }

// The rank is exact: such a coupling is never called none.
void test_coupling_below_all_digits_is_called_weak() { expect_last_refusal(1e-250, "plant.B", "too weakly"); }

// All closed-loop poles at zero: each run knows a fifth of its digits of them.
void test_deadbeat_poles_are_exact_zeros() {
  const Index nx = 5;
  MatrixXd A = MatrixXd::Zero(nx, nx);
  for (Index i = 0; i + 1 < nx; ++i) A(i, i + 1) = 1;
  A.row(nx - 1).setConstant(0.5);
  Problem problem =
      problem_of(Domain::discrete, 1, A, MatrixXd::Identity(nx, nx).col(nx - 1), MatrixXd::Identity(1, nx));
  problem.regulator->R.setZero();
  problem.regulator->Q = MatrixXd::Zero(nx, nx);
  problem.regulator->Q(nx - 1, nx - 1) = 1;
  problem.estimator.reset();
  for (const std::complex<double>& pole : solved(problem).loop.poles) TEST_ASSERT_TRUE(pole == 0.0);
}

void test_exact_zeros_of_the_plant_stay_exact() {
  const Solution found = solved(double_integrator(0.1));
  TEST_ASSERT_TRUE(found.plant.A(1, 0).is_zero());
  TEST_ASSERT_FALSE(std::signbit(to_double(found.plant.A(1, 0))));
  TEST_ASSERT_TRUE(found.plant.A(0, 0) == 1);
  TEST_ASSERT_TRUE(is_zero(found.estimator->M));
}

void test_estimator_alone_and_regulator_alone() {
  Problem problem = two_mass();
  problem.regulator.reset();
  const Solution filter = solved(problem);
  TEST_ASSERT_TRUE(filter.estimator && !filter.regulator && !filter.online);
  problem = two_mass();
  problem.estimator.reset();
  const Solution regulator = solved(problem);
  TEST_ASSERT_TRUE(regulator.regulator && !regulator.estimator);
  TEST_ASSERT_EQUAL(4, regulator.loop.poles.size());
}

// No input at all, and with discrete states nothing to sample.
void test_estimator_of_a_plant_without_inputs() {
  Problem problem =
      problem_of(Domain::discrete, 1, MatrixXd::Constant(1, 1, 1), MatrixXd::Zero(1, 0), MatrixXd::Identity(1, 1));
  problem.regulator.reset();
  problem.estimator->gain = Gain::online;
  const Solution found = solved(problem);
  TEST_ASSERT_EQUAL(0, found.plant.B.cols());
  TEST_ASSERT_EQUAL(0, found.online->D.cols());
}

void test_regulator_of_a_continuous_plant_without_outputs() {
  Problem problem =
      problem_of(Domain::continuous, 0.1, MatrixXd::Constant(1, 1, 1), MatrixXd::Identity(1, 1), MatrixXd::Zero(0, 1));
  problem.estimator.reset();
  TEST_ASSERT_EQUAL(0, solved(problem).plant.C.rows());
}

// A person who waits is told once a second what is going on, and how much of it there is.
void test_progress_comes_once_a_second() {
  std::vector<std::string> lines;
  const Digits digits(50);
  {
    const Progress keep = [&](const std::string& line) { lines.push_back(line); };
    const ProgressScope scope(keep);
    report_progress("too early", 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    report_progress("gains", 3, 10);
    report_progress("too early again", 4);
  }
  report_progress("too late", 5);
  TEST_ASSERT_EQUAL(1, lines.size());
  TEST_ASSERT_EQUAL_STRING("gains in 50 digits, step 3 of 10", lines.front().c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_two_mass_agrees_with_an_independent_solver_to_the_last_bit);
  RUN_TEST(test_random_problems_of_both_domains_are_solved);
  RUN_TEST(test_same_problem_has_the_same_numbers_whatever_digits_are_in_force);
  RUN_TEST(test_fast_unstable_plant_takes_more_digits);
  RUN_TEST(test_nearly_unreached_mode_takes_more_digits);
  RUN_TEST(test_what_400_digits_do_not_settle_is_refused);
  RUN_TEST(test_coupling_below_all_digits_is_called_weak);
  RUN_TEST(test_deadbeat_poles_are_exact_zeros);
  RUN_TEST(test_exact_zeros_of_the_plant_stay_exact);
  RUN_TEST(test_estimator_alone_and_regulator_alone);
  RUN_TEST(test_estimator_of_a_plant_without_inputs);
  RUN_TEST(test_regulator_of_a_continuous_plant_without_outputs);
  RUN_TEST(test_progress_comes_once_a_second);
  return UNITY_END();
}
