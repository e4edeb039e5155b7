// SPDX-License-Identifier: MIT
#include "input/definite.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "input/values.hpp"

namespace lqg::input {
namespace {

double least_eigenvalue(const Eigen::MatrixXd& Q) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Q, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

// λ_min(Q), with Q brought to entries ≤ 1 first so that nothing overflows on the way.
double least_eigenvalue_of_any_size(const Eigen::MatrixXd& Q) {
  const double scale = Q.cwiseAbs().maxCoeff();
  if (scale == 0) return 0;
  return least_eigenvalue(Q.unaryExpr([scale](double q) { return q / scale; })) * scale;
}

// Semidefinite: diagonal entries ≥ 0, definite: > 0.
std::optional<std::string> bad_diagonal(const Eigen::MatrixXd& Q, bool strictly) {
  for (int i = 0; i < Q.rows(); ++i)
    if (Q(i, i) < 0 || (strictly && Q(i, i) == 0))
      return "[" + std::to_string(i) + "][" + std::to_string(i) + "] = " + shown(Q(i, i));
  return {};
}

// D⁻¹ Q D⁻¹ with D = diag(√q_ii); where q_ii = 0 the largest entry takes its place.
Eigen::MatrixXd with_unit_diagonal(const Eigen::MatrixXd& Q) {
  const double largest = Q.cwiseAbs().maxCoeff();
  const auto root = [&](int i) { return std::sqrt(Q(i, i) > 0 ? Q(i, i) : largest); };
  Eigen::MatrixXd result = Q;
  for (int i = 0; i < Q.rows(); ++i)
    for (int j = 0; j < Q.cols(); ++j)
      if (Q(i, j) != 0) result(i, j) = Q(i, j) / root(i) / root(j);
  return result;
}

}  // namespace

Asymmetry worst_asymmetry(const Eigen::MatrixXd& Q) {
  Asymmetry worst;
  for (int i = 0; i < Q.rows(); ++i) {
    for (int j = i + 1; j < Q.cols(); ++j) {
      const double natural = std::sqrt(std::abs(Q(i, i))) * std::sqrt(std::abs(Q(j, j)));
      const double scale = std::max({std::abs(Q(i, j)), std::abs(Q(j, i)), natural});
      const double size = scale == 0 ? 0 : std::abs(Q(i, j) / scale - Q(j, i) / scale);
      if (size > worst.size) worst = {i, j, size};
    }
  }
  return worst;
}

Eigen::MatrixXd symmetrised(const Eigen::MatrixXd& Q) {
  return Q.binaryExpr(Q.transpose(), [](double a, double b) { return a == b ? a : a / 2 + b / 2; });
}

std::optional<std::string> indefinite(const Eigen::MatrixXd& Q, bool strictly) {
  if (const auto entry = bad_diagonal(Q, strictly)) return entry;
  const double least = strictly ? static_cast<double>(Q.rows()) * definite_margin : -semidefinite_tolerance;
  if (least_eigenvalue(with_unit_diagonal(Q)) >= least) return {};
  return "the eigenvalue " + shown(least_eigenvalue_of_any_size(Q), 3);
}

Eigen::MatrixXd joint(const Eigen::MatrixXd& Q, const Eigen::MatrixXd& N, const Eigen::MatrixXd& R) {
  Eigen::MatrixXd result(Q.rows() + R.rows(), Q.rows() + R.rows());
  result << Q, N, N.transpose(), R;
  return result;
}

}  // namespace lqg::input
