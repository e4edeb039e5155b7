// SPDX-License-Identifier: MIT
#include "simulate/designed.hpp"

#include <algorithm>
#include <cmath>

#include "controller/stage_in_force.hpp"
#include "design/numeric/digits.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"
#include "design/sampled/added_states.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// F Fᵀ = S, F lower triangular, S positive semidefinite: a column that rounding alone would fill stays 0.
MatrixXd square_root(const MatrixXd& S) {
  MatrixXd F = MatrixXd::Zero(S.rows(), S.rows());
  for (Index j = 0; j < S.rows(); ++j) {
    double left = S(j, j);
    for (Index k = 0; k < j; ++k) left -= F(j, k) * F(j, k);
    if (left <= 1e-12 * S(j, j)) continue;
    F(j, j) = std::sqrt(left);
    for (Index i = j + 1; i < S.rows(); ++i) {
      double sum = S(i, j);
      for (Index k = 0; k < j; ++k) sum -= F(i, k) * F(j, k);
      F(i, j) = sum / F(j, j);
    }
  }
  return F;
}

// Of G w and v.
MatrixXd joint_covariance_of_model(const Controller& controller, std::size_t sample, PlantNoise wanted) {
  const design::SampledPlant& plant = controller::plant_at(controller, sample);
  const design::SampledNoise* noise = controller::noise_at(controller, sample);
  const Index size = plant.A.rows() + plant.C.rows();
  if (wanted == PlantNoise::none) return MatrixXd::Zero(size, size);
  if (!noise || noise->V.size() == 0)
    return wanted == PlantNoise::assumed ? MatrixXd(1e-4 * MatrixXd::Identity(size, size)) : MatrixXd::Zero(size, size);
  const design::Digits digits(std::max(controller.solution.numerics.digits, 50u));
  return design::to_doubles(
      design::joint(design::congruence(plant.G, noise->W), design::multiply(plant.G, noise->Swv), noise->V));
}

// The disturbances of the inputs stay 0 in what is designed: scenarios have loads.
MatrixXd joint_covariance(const Controller& controller, std::size_t sample, PlantNoise wanted) {
  MatrixXd S = joint_covariance_of_model(controller, sample, wanted);
  if (wanted != PlantNoise::designed) return S;
  const Index first = controller.problem.plant.A.rows();
  for (Index i = first; i < first + design::disturbance_count(controller.problem); ++i)
    S.row(i).setZero(), S.col(i).setZero();
  return S;
}

}  // namespace

MatrixXd noise_factor(const Controller& controller, std::size_t sample, PlantNoise wanted) {
  return square_root(joint_covariance(controller, sample, wanted));
}

const design::SampledCost* sampled_cost(const Controller& controller, std::size_t sample) {
  const design::StageSolution* stage = controller::stage_in_force(controller.solution, sample);
  if (stage && stage->cost) return &*stage->cost;
  return controller.solution.regulator ? &controller.solution.regulator->cost : nullptr;
}

}  // namespace lqg::simulate
