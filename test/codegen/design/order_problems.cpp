// SPDX-License-Identifier: MIT
#include "order_problems.hpp"

#include <Eigen/Eigenvalues>

#include "design/equations/sampling.hpp"

namespace design_test {

using namespace lqg::design;
using Eigen::MatrixXd;

namespace {

RealMatrix decimal(Index rows, std::initializer_list<const char*> numbers) {
  RealMatrix result(rows, static_cast<Index>(numbers.size()) / rows);
  Index next = 0;
  for (const char* number : numbers) {
    result(next / result.cols(), next % result.cols()) = Real(number);
    ++next;
  }
  return result;
}

std::vector<WhiteParameter> white_parameters() {
  return {{zeros(2, 2), decimal(2, {"0.02", "0.2"}), decimal(1, {"0.3", "0"})},
          {decimal(2, {"0.1", "0", "0", "0.1"}), zeros(2, 1), zeros(1, 2)}};
}

}  // namespace

OrderProblem unit_problem(bool is_continuous, const RealMatrix& A, const RealMatrix& B, const RealMatrix& C) {
  const Index nx = A.rows(), nu = B.cols(), ny = C.rows();
  return {is_continuous, false,        A, B, C, identity(nx), zeros(nx, nu), identity(nu), identity(nx),
          zeros(nx, ny), identity(ny), {}};
}

OrderProblem stable_plant(bool is_continuous, Index nx, Index nu, Index ny, std::uint64_t seed) {
  Random random(seed);
  MatrixXd A = random.matrix(nx, nx);
  A *= 0.8 / A.eigenvalues().cwiseAbs().maxCoeff();
  if (is_continuous) A -= MatrixXd::Identity(nx, nx);
  return unit_problem(is_continuous, real(A), real(random.matrix(nx, nu)), real(random.matrix(ny, nx)));
}

OrderProblem unstable_plant(std::uint64_t seed) {
  Random random(seed);
  const Index nx = 2 + static_cast<Index>(seed % 3);
  MatrixXd A = random.matrix(nx, nx);
  A *= (0.8 + 0.05 * static_cast<double>(seed % 8)) / A.eigenvalues().cwiseAbs().maxCoeff();
  const Index nu = 1 + static_cast<Index>(seed / 2 % 2), ny = 1 + static_cast<Index>(seed / 4 % 2);
  return unit_problem(false, real(A), real(random.matrix(nx, nu)), real(random.matrix(ny, nx)));
}

void add_white_parameters(OrderProblem& problem, std::uint64_t seed) {
  Random random(seed);
  const Index nx = problem.A.rows(), nu = problem.B.cols(), ny = problem.C.rows();
  problem.white.push_back(
      {real(0.1 * random.matrix(nx, nx)), real(0.1 * random.matrix(nx, nu)), real(0.1 * random.matrix(ny, nx))});
  problem.white.push_back({zeros(nx, nx), real(0.2 * random.matrix(nx, nu)), real(0.2 * random.matrix(ny, nx))});
}

OrderProblem third_order_reference(bool has_feedthrough) {
  OrderProblem problem = unit_problem(false, decimal(3, {"1.1", "0.3", "0", "-0.3", "0.9", "0.2", "0", "0.1", "0.7"}),
                                      decimal(3, {"0", "0.5", "1"}), decimal(1, {"1", "0", "0.2"}));
  problem.has_feedthrough = has_feedthrough;
  return problem;
}

OrderProblem white_reference(bool has_feedthrough) {
  OrderProblem problem =
      unit_problem(false, decimal(2, {"1.05", "0.2", "-0.1", "0.9"}), decimal(2, {"0.1", "1"}), decimal(1, {"1", "0"}));
  problem.has_feedthrough = has_feedthrough;
  problem.white = white_parameters();
  return problem;
}

OrderProblem moving_reference(bool is_white) {
  OrderProblem problem =
      unit_problem(true, decimal(2, {"-0.1", "1", "-1", "0.05"}), decimal(2, {"0", "1"}), decimal(1, {"1", "0"}));
  if (is_white) problem.white = white_parameters();
  return problem;
}

OrderProblem six_masses() {
  const Index masses = 6, nx = 2 * masses;
  MatrixXd A = MatrixXd::Zero(nx, nx), weight = MatrixXd::Zero(nx + 1, nx + 1), noise = MatrixXd::Zero(nx, nx);
  for (Index i = 0; i < masses; ++i) {
    A(i, masses + i) = 1;
    A(masses + i, i) = -2;
    A(masses + i, masses + i) = -0.02;
    if (i > 0) A(masses + i, i - 1) = 1;
    if (i + 1 < masses) A(masses + i, i + 1) = 1;
    noise(masses + i, masses + i) = i == 0 ? 1 : 0.01;
  }
  weight(0, 0) = weight(masses - 1, masses - 1) = 1;
  weight(nx, nx) = 0.1;
  MatrixXd B = MatrixXd::Zero(nx, 1), C = MatrixXd::Zero(1, nx);
  B(masses, 0) = 1;
  C(0, masses - 1) = 1;
  const SampledPeriod period = sample({real(A), real(B), real(weight), real(noise)}, Real(0.5));
  OrderProblem problem = unit_problem(false, period.A, period.B, real(C));
  problem.Q = period.cost.topLeftCorner(nx, nx);
  problem.N = period.cost.topRightCorner(nx, 1);
  problem.R = period.cost.bottomRightCorner(1, 1);
  problem.W = period.noise;
  problem.V = real(MatrixXd::Constant(1, 1, 0.01));
  return problem;
}

}  // namespace design_test
