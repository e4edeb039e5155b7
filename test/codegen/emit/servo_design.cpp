// SPDX-License-Identifier: MIT
#include "emit/plan/plan.hpp"
#include "servo_design.hpp"

#include <unity.h>

namespace lqg_test {

using lqg::design::Problem;
using lqg::design::RealMatrix;
using lqg::design::Solution;

RealMatrix matrix(std::initializer_list<std::initializer_list<double>> rows) {
  RealMatrix out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.begin()->size()));
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    Eigen::Index j = 0;
    for (const double value : row) out(i, j++) = value;
    ++i;
  }
  return out;
}

lqg::emit::Controller changed(const DesignText& design, const std::function<void(Problem&, Solution&)>& change) {
  const lqg::emit::Controller made = controller_of(design);
  Problem problem = made.problem;
  Solution solution = made.solution;
  {
    const lqg::design::Digits digits(solution.numerics.digits);
    change(problem, solution);
  }
  lqg::design::Findings findings;
  const auto controller = lqg::emit::make_controller(problem, solution, made.source, findings);
  if (!controller) TEST_FAIL_MESSAGE(findings.empty() ? "refused" : findings.front().message.c_str());
  return *controller;
}

DesignText limited_double_integrator() {
  DesignText design = double_integrator();
  design.u_min = Eigen::VectorXd::Constant(1, -0.6), design.u_max = Eigen::VectorXd::Constant(1, 0.5);
  return design;
}

void integrate_position(Problem& problem, Solution& solution) {
  problem.regulator->integral = lqg::design::Integral{{0}, Eigen::MatrixXd::Identity(1, 1)};
  solution.regulator->K = matrix({{4, 3, -2}});
  solution.regulator->H = matrix({{0.3}});
}

void weigh_changes(Problem& problem, Solution& solution) {
  integrate_position(problem, solution);
  problem.regulator->input_rate = Eigen::MatrixXd::Identity(1, 1);
  solution.regulator->K = matrix({{0.4, 0.6, -0.1, 0.4}});
}

void track_position(Problem& problem, Solution& solution) {
  problem.regulator->track = {0};
  solution.regulator->K = matrix({{4, 3}});
  solution.regulator->Nx = matrix({{1}, {0}});
  solution.regulator->Nu = matrix({{0}});
  solution.regulator->Nbar = matrix({{4}});
}

// The covariance of a state that inputs on their way were added to, which are known.
RealMatrix with_known_states(const RealMatrix& covariance, Eigen::Index added) {
  const Eigen::Index known = covariance.rows();
  RealMatrix out = RealMatrix::Zero(known + added, known + added);
  out.topLeftCorner(known, known) = covariance;
  return out;
}

void delay_input(Problem&, Solution& solution) {
  solution.plant.A = matrix({{1, 0.1, 0.005, 0}, {0, 1, 0.1, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}});
  solution.plant.B = matrix({{0}, {0}, {0}, {1}});
  solution.plant.G = matrix({{0.005}, {0.1}, {0}, {0}});
  solution.plant.C = matrix({{1, 0, 0, 0}});
  if (solution.regulator) solution.regulator->K = matrix({{0.8, 1.2, 0.12, 0.12}});
  if (!solution.estimator) return;
  solution.estimator->L = matrix({{0.3}, {0.5}, {0}, {0}});
  solution.estimator->M = matrix({{0}, {0}, {0}, {0}});
  for (RealMatrix* P : {&solution.estimator->P_prior, &solution.estimator->P_posterior, &solution.start->P0})
    *P = with_known_states(*P, 2);
  solution.start->x0 = lqg::design::above(solution.start->x0, lqg::design::zeros(2, 1));
}

}  // namespace lqg_test
