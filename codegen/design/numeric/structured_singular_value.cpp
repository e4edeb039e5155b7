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

}  // namespace

double balanced_norm(const MatrixXcd& H) { return scaled_norm(H, balance(H)); }

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
