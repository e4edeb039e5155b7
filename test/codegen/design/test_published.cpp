// SPDX-License-Identifier: MIT
// Numbers that other systems print in the examples of their manuals, in the digits that stand there.
#include <cmath>

#include <unity.h>

#include "design/rounding.hpp"
#include "problems.hpp"

namespace {

using namespace design_test;
using namespace lqg::design;
using Eigen::MatrixXd;

// `found` rounds to what is printed with this many decimals.
void expect_printed(const MatrixXd& printed, int decimals, const RealMatrix& found) {
  TEST_ASSERT_EQUAL_INT(printed.size(), found.size());
  const double half = 0.5001 * std::pow(10, -decimals);
  for (Eigen::Index i = 0; i < printed.size(); ++i)
    TEST_ASSERT_DOUBLE_WITHIN(half, printed.data()[i], to_double(found.data()[i]));
}

Problem weighed(Domain domain, Cost cost, const MatrixXd& A, const MatrixXd& B, const MatrixXd& C) {
  Problem problem = regulator_alone(problem_of(domain, 1e-3, A, B, C));
  problem.regulator->cost = cost;
  return problem;
}

// MATLAB, "Kalman Filter Design" (Control System Toolbox): [kalmf, L, ~, M] = kalman(ss(A, [B B], C, 0, -1), 2.3, 1).
void test_kalman_of_matlab() {
  const MatrixXd A = (MatrixXd(3, 3) << 1.1269, -0.4940, 0.1129, 1, 0, 0, 0, 1, 0).finished();
  const MatrixXd B = (MatrixXd(3, 1) << -0.3832, 0.5919, 0.5191).finished();
  Problem problem = problem_of(Domain::discrete, 1, A, B, (MatrixXd(1, 3) << 1, 0, 0).finished());
  problem.plant.G = B;
  problem.plant.H = MatrixXd::Zero(1, 1);
  problem.estimator->W = MatrixXd::Constant(1, 1, 2.3);
  problem.estimator->Swv = MatrixXd::Zero(1, 1);
  expect_printed((MatrixXd(3, 1) << 0.5345, 0.0101, -0.4776).finished(), 4, solved(problem).estimator->L);
}

// Altair Compose, reference page `dlqr`.
void test_dlqr_of_compose() {
  Problem problem = weighed(Domain::discrete, Cost::discrete, (MatrixXd(2, 2) << 9, 0.2, 0, 8).finished(),
                            (MatrixXd(2, 1) << 0, 1).finished(), MatrixXd::Zero(0, 2));
  problem.regulator->Q = (MatrixXd(2, 2) << 2, 1, 1, 2).finished();
  const Solution found = solved(problem);
  expect_printed((MatrixXd(1, 2) << 394.61003, 16.76761).finished(), 5, found.regulator->K);
  TEST_ASSERT_DOUBLE_WITHIN(5.001e-6, 0.12166, found.regulator->poles[0].real());
  TEST_ASSERT_DOUBLE_WITHIN(5.001e-6, 0.11073, found.regulator->poles[1].real());
}

// MATLAB, reference page `lqr`: pendulum on a cart.
void test_lqr_of_matlab() {
  const MatrixXd A = (MatrixXd(4, 4) << 0, 1, 0, 0, 0, -0.1, 3, 0, 0, 0, 0, 1, 0, -0.5, 30, 0).finished();
  Problem problem =
      weighed(Domain::continuous, Cost::continuous, A, (MatrixXd(4, 1) << 0, 2, 0, 5).finished(), MatrixXd::Zero(0, 4));
  problem.regulator->Q = Eigen::Vector4d(1, 0, 1, 0).asDiagonal();
  const Solution found = solved(problem);
  expect_printed((MatrixXd(1, 4) << -1.0000, -1.7559, 16.9145, 3.2274).finished(), 4, found.regulator->K);
  const MatrixXd X = (MatrixXd(4, 4) << 1.5346, 1.2127, -3.2274, -0.6851, 1.2127, 1.5321, -4.5626, -0.9640, -3.2274,
                      -4.5626, 26.5487, 5.2079, -0.6851, -0.9640, 5.2079, 1.0311)
                         .finished();
  expect_printed(X, 4, found.regulator->X);
}

// Control Tutorials for MATLAB and Simulink, "Aircraft Pitch: State-Space Methods for Controller Design": Q = 2 CᵀC, as
// lqry and Q_output weigh it.
void test_lqry_of_the_tutorials() {
  const MatrixXd A = (MatrixXd(3, 3) << -0.313, 56.7, 0, -0.0139, -0.426, 0, 0, 56.7, 0).finished();
  Problem problem = weighed(Domain::continuous, Cost::continuous, A, (MatrixXd(3, 1) << 0.232, 0.0203, 0).finished(),
                            (MatrixXd(1, 3) << 0, 0, 1).finished());
  problem.regulator->Q.resize(0, 0);
  problem.regulator->Q_output = MatrixXd::Constant(1, 1, 2);
  expect_printed((MatrixXd(1, 3) << -0.5034, 52.8645, 1.4142).finished(), 4, solved(problem).regulator->K);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_kalman_of_matlab);
  RUN_TEST(test_dlqr_of_compose);
  RUN_TEST(test_lqr_of_matlab);
  RUN_TEST(test_lqry_of_the_tutorials);
  return UNITY_END();
}
