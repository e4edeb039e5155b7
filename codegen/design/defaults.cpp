// SPDX-License-Identifier: MIT
#include "design/defaults.hpp"

namespace lqg::design {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void fill(MatrixXd& matrix, const MatrixXd& with) {
  if (matrix.size() == 0) matrix = with;
}

void fill_plant(Plant& plant) {
  const Index nx = plant.A.rows();
  fill(plant.B, MatrixXd::Zero(nx, 0));
  fill(plant.C, MatrixXd::Zero(0, nx));
  fill(plant.D, MatrixXd::Zero(plant.C.rows(), plant.B.cols()));
  fill(plant.G, MatrixXd::Identity(nx, nx));
  fill(plant.H, MatrixXd::Zero(plant.C.rows(), plant.G.cols()));
}

void fill_estimator(const Plant& plant, Estimator& estimator) {
  const Index nx = plant.A.rows();
  fill(estimator.Swv, MatrixXd::Zero(plant.G.cols(), plant.C.rows()));
  fill(estimator.P0, MatrixXd::Identity(nx, nx));
  if (estimator.x0.size() == 0) estimator.x0 = Eigen::VectorXd::Zero(nx);
}

}  // namespace

Problem with_defaults(Problem problem) {
  Plant& plant = problem.plant;
  fill_plant(plant);
  if (problem.regulator) fill(problem.regulator->N, MatrixXd::Zero(plant.A.rows(), plant.B.cols()));
  if (problem.estimator) fill_estimator(plant, *problem.estimator);
  if (plant.domain == Domain::continuous) return problem;
  if (problem.regulator) problem.regulator->cost = Cost::discrete;
  if (problem.estimator) problem.estimator->noise = Noise::discrete;
  return problem;
}

}  // namespace lqg::design
