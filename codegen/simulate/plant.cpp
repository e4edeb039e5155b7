// SPDX-License-Identifier: MIT
#include "simulate/plant.hpp"

#include <algorithm>
#include <cmath>

#include "controller/stage_in_force.hpp"
#include "design/numeric/digits.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd product(const MatrixXd& M, const VectorXd& x) {
  VectorXd y = VectorXd::Zero(M.rows());
  for (Index i = 0; i < M.rows(); ++i)
    for (Index j = 0; j < M.cols(); ++j) y(i) += M(i, j) * x(j);
  return y;
}

double inner_product(const VectorXd& a, const VectorXd& b) {
  double sum = 0;
  for (Index i = 0; i < a.size(); ++i) sum += a(i) * b(i);
  return sum;
}

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
MatrixXd joint_covariance(const Controller& controller, std::size_t sample, PlantNoise wanted) {
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

const design::SampledCost* cost_at(const Controller& controller, std::size_t sample) {
  const design::StageSolution* stage = controller::stage_in_force(controller.solution, sample);
  if (stage && stage->cost) return &*stage->cost;
  return controller.solution.regulator ? &controller.solution.regulator->cost : nullptr;
}

}  // namespace

Plant::Stage Plant::stage_of(const Controller& controller, std::size_t from, PlantNoise noise) {
  const design::StageSolution* stage = controller::stage_in_force(controller.solution, from);
  const design::SampledPlant& plant = stage ? stage->plant : controller.solution.plant;
  Stage result;
  result.from = from;
  result.A = design::to_doubles(plant.A);
  result.B = design::to_doubles(plant.B);
  result.C = design::to_doubles(plant.C);
  result.D = design::to_doubles(plant.D);
  result.noise_factor = square_root(joint_covariance(controller, from, noise));
  if (const design::SampledCost* cost = cost_at(controller, from)) {
    result.Q = design::to_doubles(cost->Q);
    result.R = design::to_doubles(cost->R);
    result.N = design::to_doubles(cost->N);
  }
  return result;
}

Plant::Plant(const Controller& controller, const VectorXd& x, PlantNoise noise, std::uint64_t seed)
    : noise_(seed), x_(x) {
  stages_.push_back(stage_of(controller, 0, noise));
  for (const design::StageSolution& stage : controller.solution.stages)
    stages_.push_back(stage_of(controller, static_cast<std::size_t>(stage.from), noise));
}

const Plant::Stage& Plant::stage() const {
  std::size_t at = 0;
  while (at + 1 < stages_.size() && stages_[at + 1].from <= sample_) ++at;
  return stages_[at];
}

VectorXd Plant::measure(const VectorXd& u) {
  const Stage& now = stage();
  VectorXd white(now.noise_factor.rows());
  for (Index i = 0; i < white.size(); ++i) white(i) = noise_.normal();
  drawn_ = product(now.noise_factor, white);
  return product(now.C, x_) + product(now.D, u) + drawn_.tail(now.C.rows());
}

void Plant::advance(const VectorXd& u) {
  const Stage& now = stage();
  x_ = product(now.A, x_) + product(now.B, u) + drawn_.head(now.A.rows());
  ++sample_;
}

double Plant::cost(const VectorXd& u) const {
  const Stage& now = stage();
  if (now.Q.size() == 0) return 0;
  return inner_product(x_, product(now.Q, x_) + 2 * product(now.N, u)) + inner_product(u, product(now.R, u));
}

}  // namespace lqg::simulate
