// SPDX-License-Identifier: MIT
#include "simulate/error_covariance.hpp"

#include <algorithm>
#include <cmath>

#include "controller/stage_in_force.hpp"
#include "design/rounding.hpp"
#include "simulate/period.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd congruence(const MatrixXd& F, const MatrixXd& P) {
  const MatrixXd out = ordered_product(ordered_product(F, P), F.transpose());
  return (out + out.transpose()) / 2;
}

}  // namespace

// By a Cholesky factor of S scaled to a unit diagonal; a pivot that rounding alone would leave has no direction.
NormalisedSquare normalised_square(const MatrixXd& S, const VectorXd& nu, const std::vector<bool>& used) {
  constexpr double no_direction = 1e-10;
  NormalisedSquare result;
  MatrixXd F = MatrixXd::Zero(S.rows(), S.rows());
  VectorXd white = VectorXd::Zero(S.rows());
  for (Index j = 0; j < S.rows(); ++j) {
    if (!used[static_cast<std::size_t>(j)]) continue;
    double left = S(j, j), residual = nu(j);
    for (Index k = 0; k < j; ++k) left -= F(j, k) * F(j, k), residual -= F(j, k) * white(k);
    if (!(left > no_direction * S(j, j))) continue;
    const double pivot = std::sqrt(left);
    for (Index i = j + 1; i < S.rows(); ++i) {
      double sum = S(i, j);
      for (Index k = 0; k < j; ++k) sum -= F(i, k) * F(j, k);
      F(i, j) = sum / pivot;
    }
    F(j, j) = pivot;
    white(j) = residual / pivot;
    result.value += white(j) * white(j);
    ++result.degrees;
  }
  return result;
}

NormalisedSquare normalised_square(const MatrixXd& S, const VectorXd& nu) {
  return normalised_square(S, nu, std::vector<bool>(static_cast<std::size_t>(nu.size()), true));
}

ErrorCovariance::ErrorCovariance(const Controller& controller) : controller_(controller), sample_(1) {
  go_to(0);
  if (!controller.filters.empty()) load_gains(0);
  begin_anew();
}

void ErrorCovariance::go_to(std::size_t sample) {
  sample = std::min(sample, controller_.last_sample);
  if (sample == sample_) return;
  const design::SampledPlant& plant = controller::plant_at(controller_, sample);
  const design::SampledNoise& noise = *controller::noise_at(controller_, sample);
  A_ = design::to_doubles(plant.A), C_ = design::to_doubles(plant.C), V_ = design::to_doubles(noise.V);
  const MatrixXd G = design::to_doubles(plant.G);
  GWG_ = congruence(G, design::to_doubles(noise.W));
  cross_ = noise.Swv.size() ? ordered_product(G, design::to_doubles(noise.Swv)) : MatrixXd::Zero(A_.rows(), C_.rows());
  sample_ = sample;
  is_settled_ = false;
}

void ErrorCovariance::load_gains(std::size_t gain_row) {
  const controller::Gains& gains = controller_.filters[std::min(gain_row, controller_.filters.size() - 1)];
  L_ = design::to_doubles(gains[0]), M_ = design::to_doubles(gains[1]);
  if (M_.size() == 0) M_ = MatrixXd::Zero(L_.rows(), L_.cols());
  gain_row_ = gain_row;
  is_settled_ = false;
}

void ErrorCovariance::begin_anew() {
  P_ = design::to_doubles(controller_.solution.start->P0);
  before_ = P_;
  is_settled_ = false;
}

MatrixXd ErrorCovariance::of_innovation(const MatrixXd& C) const { return congruence(C, P_) + V_; }

void ErrorCovariance::update(std::size_t gain_row, const std::vector<bool>& left_out) {
  if (gain_row != gain_row_) load_gains(gain_row);
  all_used_ = std::find(left_out.begin(), left_out.end(), true) == left_out.end();
  is_settled_ = is_settled_ && all_used_;
  before_ = P_;
  if (is_settled_) {
    P_ = settled_after_;
    return;
  }
  used_L_ = L_, used_M_ = M_;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (left_out[i]) used_L_.col(static_cast<Index>(i)).setZero(), used_M_.col(static_cast<Index>(i)).setZero();
  const MatrixXd kept = MatrixXd::Identity(P_.rows(), P_.rows()) - ordered_product(used_L_, C_);
  P_ = congruence(kept, before_) + congruence(used_L_, V_);
}

void ErrorCovariance::predict() {
  constexpr double settled = 1e-13;  // of an entry's two standard deviations
  const MatrixXd after = P_;
  if (is_settled_) {
    P_ = before_;
    return;
  }
  const MatrixXd gain = ordered_product(A_, used_L_) + used_M_;
  const MatrixXd mixed = ordered_product(cross_, gain.transpose());
  P_ = congruence(A_ - ordered_product(gain, C_), before_) + congruence(gain, V_) + GWG_ - mixed - mixed.transpose();
  const VectorXd deviations = P_.diagonal().cwiseMax(0).cwiseSqrt();
  const MatrixXd largest = settled * deviations * deviations.transpose();
  is_settled_ = all_used_ && ((P_ - before_).cwiseAbs().array() <= largest.array()).all();
  settled_after_ = after;
}

}  // namespace lqg::simulate
