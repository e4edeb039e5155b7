// SPDX-License-Identifier: MIT
#include "design/numeric/rounding_distance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace lqg::design {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

struct Scaling {
  VectorXd rows, columns;
};

// All rows and columns of diag(rows) E diag(columns) have 1 as their largest entry, or nearly (D. Ruiz, report
// RAL-TR-2001-034).
Scaling equilibrated(const MatrixXd& E) {
  Scaling by = {VectorXd::Ones(E.rows()), VectorXd::Ones(E.cols())};
  const auto divide = [](VectorXd& scale, const VectorXd& largest) {
    for (Index i = 0; i < scale.size(); ++i)
      if (largest(i) > 0) scale(i) /= std::sqrt(largest(i));
  };
  for (int pass = 0; pass < 12; ++pass) {
    const MatrixXd now = by.rows.asDiagonal() * E * by.columns.asDiagonal();
    divide(by.rows, now.rowwise().maxCoeff());
    divide(by.columns, now.colwise().maxCoeff().transpose());
  }
  return by;
}

// w of unit length with ‖wᴴX‖ nearly the smallest: inverse iteration with the triangle of Xᴴ = QT.
VectorXcd least_left_vector(const MatrixXcd& X) {
  const Index n = X.rows();
  const Eigen::HouseholderQR<MatrixXcd> factors(X.adjoint());
  MatrixXcd T = factors.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const double least = 1e-30 * T.cwiseAbs().maxCoeff() + std::numeric_limits<double>::min();
  for (Index i = 0; i < n; ++i)
    if (std::abs(T(i, i)) < least) T(i, i) = least;
  VectorXcd w(n);
  for (Index i = 0; i < n; ++i) w(i) = 1 + static_cast<double>(i) / static_cast<double>(3 * n);
  for (int step = 0; step < 3; ++step) {
    T.adjoint().triangularView<Eigen::Lower>().solveInPlace(w);
    w /= w.cwiseAbs().maxCoeff();
    T.triangularView<Eigen::Upper>().solveInPlace(w);
    w /= w.cwiseAbs().maxCoeff();
  }
  return w;
}

// A row that has no part in w has none at all: what rounding leaves of it would be judged beside itself.
VectorXcd without_rounding(const VectorXcd& w) {
  const double least = 1e-12 * w.cwiseAbs().maxCoeff();
  return w.unaryExpr([&](const std::complex<double>& x) { return std::abs(x) > least ? x : std::complex<double>(); });
}

double largest_share(const VectorXd& residual, const VectorXd& sizes) {
  double share = 0;
  for (Index j = 0; j < residual.size(); ++j)
    if (residual(j) > 0) share = std::max(share, residual(j) / sizes(j));
  return share;
}

}  // namespace

RoundingDistance rounding_distance(const MatrixXcd& M, const MatrixXd& E, double far) {
  Scaling by = equilibrated(M.cwiseAbs().cwiseMax(E));
  const VectorXd rows = by.rows;
  RoundingDistance best = {std::numeric_limits<double>::infinity(), VectorXd::Zero(M.rows())};
  for (int pass = 0; pass < 6; ++pass) {
    const VectorXcd scaled = least_left_vector(rows.asDiagonal() * M * by.columns.asDiagonal());
    VectorXd sizes;
    for (const VectorXcd& each : {without_rounding(scaled), scaled}) {
      const VectorXcd w = rows.asDiagonal() * each;
      sizes = (w.cwiseAbs().transpose() * E).transpose();
      const double share = largest_share((w.adjoint() * M).cwiseAbs().transpose(), sizes);
      if (share < best.share) best = {share, each.cwiseAbs()};
    }
    if (!(best.share < far)) break;
    by.columns = sizes.cwiseMax(1e-30 * sizes.maxCoeff()).cwiseInverse();
  }
  return best;
}

}  // namespace lqg::design
