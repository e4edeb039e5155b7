// SPDX-License-Identifier: MIT
#include "problems.hpp"

#include <limits>
#include <map>
#include <string>

#include <unity.h>

#include "design/rounding.hpp"

namespace design_test {

using namespace lqg::design;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double Random::uniform() {
  state_ ^= state_ >> 12;
  state_ ^= state_ << 25;
  state_ ^= state_ >> 27;
  return static_cast<double>(state_ * 0x2545F4914F6CDD1DULL >> 11) / 4503599627370496.0 - 1;
}

MatrixXd Random::matrix(Index rows, Index columns) {
  MatrixXd result(rows, columns);
  for (Index i = 0; i < result.size(); ++i) result.data()[i] = uniform();
  return result;
}

// Integers, so that the product is exactly symmetric and semidefinite.
MatrixXd Random::semidefinite(Index size, Index rank) {
  const MatrixXd factor = (matrix(size, rank) * 8).array().floor();
  return factor * factor.transpose() / 16;
}

Problem problem_of(Domain domain, double sample_time, const MatrixXd& A, const MatrixXd& B, const MatrixXd& C) {
  const Index nx = A.rows(), nu = B.cols(), ny = C.rows();
  const bool continuous = domain == Domain::continuous;
  Problem problem;
  problem.name = "problem";
  Plant& plant = problem.plant;
  plant.domain = domain;
  plant.sample_time = sample_time;
  plant.A = A;
  plant.B = B;
  plant.C = C;
  plant.D = MatrixXd::Zero(ny, nu);
  plant.G = MatrixXd::Identity(nx, nx);
  plant.H = MatrixXd::Zero(ny, nx);
  for (Index i = 0; i < nx; ++i) problem.plant.states.push_back({"x" + std::to_string(i), ""});
  Regulator regulator;
  regulator.Q = MatrixXd::Identity(nx, nx);
  regulator.R = MatrixXd::Identity(nu, nu);
  regulator.N = MatrixXd::Zero(nx, nu);
  regulator.cost = continuous ? Cost::sampled : Cost::discrete;
  problem.regulator = regulator;
  Estimator estimator;
  estimator.W = MatrixXd::Identity(nx, nx);
  estimator.V = MatrixXd::Identity(ny, ny);
  estimator.Swv = MatrixXd::Zero(nx, ny);
  estimator.noise = continuous ? Noise::continuous : Noise::discrete;
  estimator.x0 = Eigen::VectorXd::Zero(nx);
  estimator.P0 = MatrixXd::Identity(nx, nx);
  problem.estimator = estimator;
  problem.code.real = lqg::design::Scalar::float64;
  return problem;
}

Problem regulator_alone(Problem problem) {
  problem.estimator.reset();
  return problem;
}

Limits limits_of_size(const VectorXd& u_min, const VectorXd& u_max) {
  Limits limits;
  limits.u_min = u_min;
  limits.u_max = u_max;
  return limits;
}

LimitedProblem foreseeing_law(const RiccatiEquation& equation, const std::vector<int>& blocks) {
  const RiccatiResult result = solve_discrete_riccati(equation, {});
  LimitedProblem problem;
  problem.A = equation.A;
  problem.B = equation.B;
  problem.K = result.K;
  problem.weight = equation.R + transpose_congruence(equation.B, result.X);
  problem.blocks = blocks;
  problem.u_max = RealVector::Constant(equation.B.cols(), std::numeric_limits<Real>::infinity());
  problem.u_min = -problem.u_max;
  problem.tolerance = 1e-12;
  problem.softening = 0;
  return problem;
}

Problem double_integrator(double sample_time) {
  return problem_of(Domain::continuous, sample_time, (MatrixXd(2, 2) << 0, 1, 0, 0).finished(),
                    (MatrixXd(2, 1) << 0, 1).finished(), (MatrixXd(1, 2) << 1, 0).finished());
}

Problem two_mass() {
  const MatrixXd A = (MatrixXd(4, 4) << 0, 1, 0, 0,  //
                      -0.1, -0.004, 0.1, 0.004,      //
                      0, 0, 0, 1,                    //
                      0.5, 0.02, -0.5, -0.02)
                         .finished();
  const MatrixXd B = (MatrixXd(4, 1) << 0, 1, 0, 0).finished();
  Problem problem = problem_of(Domain::continuous, 0.5, A, B, (MatrixXd(2, 4) << 1, 0, 0, 0, 0, 0, 1, 0).finished());
  problem.plant.G = B;
  problem.plant.states = {{"dy1", "m"}, {"v1", "m/s"}, {"dy2", "m"}, {"v2", "m/s"}};
  problem.regulator->Q = Eigen::Vector4d(1, 0, 1, 0).asDiagonal();
  problem.regulator->R *= 0.1;
  problem.estimator->W = MatrixXd::Constant(1, 1, 0.01);
  problem.estimator->V = 0.001 * MatrixXd::Identity(2, 2);
  problem.estimator->Swv = MatrixXd::Zero(1, 2);
  problem.estimator->noise = Noise::discrete;
  return problem;
}

Problem chain_of_masses(int masses) {
  const Index nx = 2 * masses;
  MatrixXd A = MatrixXd::Zero(nx, nx), B = MatrixXd::Zero(nx, 1), C = MatrixXd::Zero(2, nx);
  for (Index i = 0; i < masses; ++i) {
    A(2 * i, 2 * i + 1) = 1;
    A(2 * i + 1, 2 * i) = -2 - 0.1 * static_cast<double>(i);
    A(2 * i + 1, 2 * i + 1) = -0.02;
    if (i > 0) A(2 * i + 1, 2 * i - 2) = 1.1;
    if (i + 1 < masses) A(2 * i + 1, 2 * i + 2) = 0.9;
  }
  B(1, 0) = 1;
  C(0, 0) = C(1, nx - 2) = 1;
  Problem problem = problem_of(Domain::continuous, 0.1, A, B, C);
  problem.regulator->R *= 0.1;
  problem.estimator->W *= 0.01;
  problem.estimator->V *= 0.001;
  return problem;
}

Problem random_problem(std::uint64_t seed) {
  Random random(seed);
  const Index nx = 1 + static_cast<Index>(seed % 6), nu = 1 + static_cast<Index>(seed % 2);
  const Index ny = 1 + static_cast<Index>(seed / 2 % 3), nw = 1 + static_cast<Index>(seed % 3);
  const bool continuous = seed % 3 != 0;
  Problem problem = problem_of(continuous ? Domain::continuous : Domain::discrete, std::exp2(4 * random.uniform() - 3),
                               1.5 * random.matrix(nx, nx), random.matrix(nx, nu), random.matrix(ny, nx));
  problem.plant.D = random.matrix(ny, nu);
  problem.plant.G = random.matrix(nx, nw);
  const MatrixXd weight = random.semidefinite(nx + nu, nx + nu + 1);
  problem.regulator->Q = weight.topLeftCorner(nx, nx);
  problem.regulator->R = weight.bottomRightCorner(nu, nu);
  problem.regulator->N = weight.topRightCorner(nx, nu);
  const MatrixXd noise = random.semidefinite(nw + ny, nw + ny + 1);
  problem.estimator->W = noise.topLeftCorner(nw, nw);
  problem.estimator->V = noise.bottomRightCorner(ny, ny);
  problem.estimator->Swv = noise.topRightCorner(nw, ny);
  if (continuous && seed % 2 == 0) problem.estimator->noise = Noise::discrete;
  problem.estimator->form = seed % 4 < 2 ? Form::filter : Form::predictor;
  problem.estimator->gain = Gain::online;
  problem.estimator->P0 = random.semidefinite(nx, (nx + 1) / 2);
  return problem;
}

Solution solved(const Problem& problem) {
  Findings findings;
  const std::optional<Solution> solution = solve(problem, findings);
  const std::string first = findings.empty() ? "" : findings.front().key + ": " + findings.front().message;
  TEST_ASSERT_TRUE_MESSAGE(solution.has_value(), first.c_str());
  return *solution;
}

const Solution& solved_random_problem(std::uint64_t seed) {
  static std::map<std::uint64_t, Solution> solutions;
  const auto known = solutions.find(seed);
  return known != solutions.end() ? known->second : solutions[seed] = solved(random_problem(seed));
}

Real distance(const RealMatrix& a, const RealMatrix& b) {
  const Real difference = largest_entry(a - b);
  return difference.is_zero() ? difference : Real(difference / largest_entry(b));
}

void expect_rounded(const RealMatrix& expected, const RealMatrix& found, const char* name) {
  TEST_ASSERT_EQUAL_MESSAGE(expected.rows(), found.rows(), name);
  TEST_ASSERT_EQUAL_MESSAGE(expected.cols(), found.cols(), name);
  for (Index i = 0; i < expected.rows(); ++i)
    for (Index j = 0; j < expected.cols(); ++j) {
      const std::string where = std::string(name) + "(" + std::to_string(i) + ", " + std::to_string(j) + ")";
      TEST_ASSERT_TRUE_MESSAGE(to_double(expected(i, j)) == to_double(found(i, j)), where.c_str());
    }
}

void expect_small(const Real& value, double bound, const char* what) {
  const std::string message = std::string(what) + " is " + value.str(3);
  TEST_ASSERT_TRUE_MESSAGE(value <= bound, message.c_str());
}

}  // namespace design_test
