// SPDX-License-Identifier: MIT
#include "design/numeric/structured_singular_value.hpp"

#include <Eigen/Eigenvalues>
#include <boost/math/tools/minima.hpp>
#include <cmath>

namespace lqg::design {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXd;

// The singular values of D H D⁻¹, d = 2^exponents, squared and rising.
VectorXd squared_values(const MatrixXcd& H, const VectorXd& exponents) {
  MatrixXcd scaled = H;
  for (Index i = 0; i < H.rows(); ++i)
    for (Index j = 0; j < H.cols(); ++j) scaled(i, j) *= std::exp2(exponents(i) - exponents(j));
  return Eigen::SelfAdjointEigenSolver<MatrixXcd>(scaled.adjoint() * scaled, Eigen::EigenvaluesOnly).eigenvalues();
}

double scaled_norm(const MatrixXcd& H, const VectorXd& exponents) {
  return std::sqrt(squared_values(H, exponents)(H.rows() - 1));
}

// (Σ σ^(2 power))^(1/(2 power)): as smooth as σmax is not, and near it for a high power.
double smooth_norm(const MatrixXcd& H, const VectorXd& exponents, double power) {
  const VectorXd squared = squared_values(H, exponents);
  const double largest = squared(squared.size() - 1);
  double sum = 0;
  for (const double value : squared) sum += std::pow(std::max(0.0, value / largest), power);
  return std::sqrt(largest) * std::pow(sum, 0.5 / power);
}

// Of two channels only one ratio counts.
double norm_of_two(const MatrixXcd& H, VectorXd exponents) {
  const auto norm_at = [&](double exponent) {
    exponents(1) = exponent;
    return scaled_norm(H, exponents);
  };
  const double middle = exponents(1);
  return boost::math::tools::brent_find_minima(norm_at, middle - 4, middle + 4, 26).second;
}

// Along `direction` to the least smooth norm, which is convex.
void descend(const MatrixXcd& H, VectorXd& exponents, const VectorXd& direction, double reach, double power) {
  const auto norm_at = [&](double length) { return smooth_norm(H, exponents + length * direction, power); };
  const auto [length, least] = boost::math::tools::brent_find_minima(norm_at, -reach, reach, 16);
  if (least < norm_at(0)) exponents += length * direction;
}

// Beyond 2^±200 nothing is gained that a double would show.
double limited(double exponent) { return std::min(200.0, std::max(-200.0, exponent)); }

// One channel after the other until the norms of its row and of its column, the diagonal left out, agree.
VectorXd balance(const MatrixXcd& H) {
  VectorXd exponents = VectorXd::Zero(H.rows());
  for (int sweep = 0; sweep < 8; ++sweep)
    for (Index i = 0; i < H.rows(); ++i) {
      double row = 0, column = 0;
      for (Index j = 0; j < H.rows(); ++j) {
        if (j == i) continue;
        row += std::norm(H(i, j)) * std::exp2(-2 * exponents(j));
        column += std::norm(H(j, i)) * std::exp2(2 * exponents(j));
      }
      if (row > 0 || column > 0) exponents(i) = limited(std::log2(column / row) / 4);
    }
  return exponents;
}

// σmax(D H D⁻¹) with d = exp(t), and the slope over t of the logarithm of the smooth norm, which is convex in t: of
// the singular vectors u, v of all σ the sum of w (|u|² − |v|²), w = σ^(2 power) / Σ σ^(2 power).
struct Sloped {
  double norm;
  VectorXd slope;
};

Sloped sloped_norm(const MatrixXcd& H, const VectorXd& t, double power) {
  const VectorXd d = t.array().exp();
  const MatrixXcd scaled = d.asDiagonal() * H * d.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXcd> solver(scaled.adjoint() * scaled);
  const VectorXd& squared = solver.eigenvalues();
  const double largest = squared(squared.size() - 1);
  if (!(largest > 0)) return {0, VectorXd::Zero(t.size())};
  VectorXd share = (squared / largest).cwiseMax(0).array().pow(power);
  share /= share.sum();
  const MatrixXcd& V = solver.eigenvectors();
  const VectorXd of_u = share.array() / (squared / largest).array().max(1e-300);
  const Eigen::MatrixXd rows = (scaled * V).cwiseAbs2() / largest;
  return {std::sqrt(largest), rows * of_u - V.cwiseAbs2() * share};
}

constexpr double most_of_a_step = 2;

// By steps against the slope, each as long as the last two slopes say (J. Barzilai, J. M. Borwein, "Two-point step size
// gradient methods", IMA Journal of Numerical Analysis 8 (1988), 141–148). The least norm of all steps, and its t.
double descend_by_slopes(const MatrixXcd& H, VectorXd& t, double power, int steps) {
  VectorXd here = t;
  Sloped at = sloped_norm(H, here, power);
  double least = at.norm, length = 0.5 / power;
  for (int i = 0; i < steps && at.norm > 0; ++i) {
    VectorXd step = -length * at.slope;
    step *= std::min(1.0, most_of_a_step / std::max(step.cwiseAbs().maxCoeff(), 1e-300));
    here += step;
    const Sloped next = sloped_norm(H, here, power);
    if (next.norm < least) {
      least = next.norm;
      t = here;
    }
    const double bend = step.dot(next.slope - at.slope);
    length = bend > 0 ? step.squaredNorm() / bend : 2 * length;
    at = next;
  }
  return least;
}

}  // namespace

double balanced_norm(const MatrixXcd& H) { return scaled_norm(H, balance(H)); }

double structured_norm_of_many(const MatrixXcd& H) {
  VectorXd t = balance(H) * std::log(2.0);
  double norm = balanced_norm(H);
  for (const double power : {4.0, 32.0, 256.0}) norm = std::min(norm, descend_by_slopes(H, t, power, 20));
  return norm;
}

double structured_norm(const MatrixXcd& H) {
  VectorXd exponents = balance(H);
  if (H.rows() == 2) return std::min(scaled_norm(H, exponents), norm_of_two(H, exponents));
  double norm = scaled_norm(H, exponents);
  const bool is_small = H.rows() <= 3;  // with more channels a sweep costs more and is no longer exact anyway
  double reach = 2;
  for (double power = 2; power < 1e4; power *= is_small ? 4 : 16) {
    for (int sweep = 0; sweep < (is_small ? 4 : 1); ++sweep) {
      const VectorXd before = exponents;
      for (Index i = 1; i < H.rows(); ++i) descend(H, exponents, VectorXd::Unit(H.rows(), i), reach, power);
      descend(H, exponents, exponents - before, 8, power);
    }
    norm = std::min(norm, scaled_norm(H, exponents));
    reach = std::max(reach / 3, 1e-3);
  }
  return norm;
}

}  // namespace lqg::design
