// SPDX-License-Identifier: MIT
#include "design/limits/active_rows.hpp"

#include <algorithm>
#include <cmath>

namespace lqg::design {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// a b, with plain loops: the same bits on every machine.
MatrixXd product(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd result = MatrixXd::Zero(a.rows(), b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < b.cols(); ++j)
      for (Eigen::Index k = 0; k < a.cols(); ++k) result(i, j) += a(i, k) * b(k, j);
  return result;
}

}  // namespace

ActiveRows::ActiveRows(const MatrixXd& G, bool is_float)
    : G_(&G), unit_(is_float ? 0x1p-24 : double_unit), plain_({is_float, false}), fused_({is_float, true}) {}

std::vector<double> ActiveRows::column_of(int row) const {
  std::vector<double> column;
  for (const int other : rows_) column.push_back((*G_)(row, other));
  column.push_back((*G_)(row, row));
  return column;
}

void ActiveRows::append(int row, LimitSide side) {
  const std::vector<double> column = column_of(row);
  plain_.append(column);
  fused_.append(column);
  rows_.push_back(row);
  signs_.push_back(side == LimitSide::low ? 1 : -1);
  refresh();
}

void ActiveRows::drop(int k) {
  plain_.drop(k);
  fused_.drop(k);
  rows_.erase(rows_.begin() + k);
  signs_.erase(signs_.begin() + k);
  refresh();
}

bool ActiveRows::is_regular(double negligible) const {
  if (length() == 0) return true;
  const double least = negligible * G(length() - 1, length() - 1);
  return has_bounds_ && plain_.d(length() - 1) > least && fused_.d(length() - 1) > least;
}

void ActiveRows::refresh() {
  set_inverse();
  const MatrixXd plain = residual_of(plain_), fused = residual_of(fused_);
  residual_ = plain.cwiseMax(fused);
  has_bounds_ = has_bounds_ && plain.allFinite() && fused.allFinite();
}

// |G⁻¹ − inverse| ≤ |inverse| |defect| / (1 − η), where defect = G inverse − 1 and η is its norm in units of √G_ii.
void ActiveRows::set_inverse() {
  const int n = length();
  RoundedFactor factor({});
  MatrixXd whole(n, n);
  inverse_.resize(n, n);
  for (int i = 0; i < n; ++i) {
    std::vector<double> column;
    for (int j = 0; j < n; ++j) whole(i, j) = G(i, j);
    for (int j = 0; j <= i; ++j) column.push_back(G(i, j));
    factor.append(column);
  }
  for (int i = 0; i < n; ++i) inverse_.col(i) = factor.solution(VectorXd::Unit(n, i));
  MatrixXd defect = product(whole, inverse_) - MatrixXd::Identity(n, n);
  defect = (defect.cwiseAbs() +
            (n + 2) * double_unit * (product(whole.cwiseAbs(), inverse_.cwiseAbs()) + MatrixXd::Identity(n, n)))
               .eval();
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int j = 0; j < n; ++j) sum += defect(i, j) * std::sqrt(G(j, j) / G(i, i));
    largest = sum > largest || std::isnan(sum) ? sum : largest;
  }
  has_bounds_ = largest < 0.01;
  inverse_error_ = 1.02 * product(inverse_.cwiseAbs(), defect);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double rest = 0;  // of the terms of higher order
      for (int k = 0; k < n; ++k) rest += std::abs(inverse_(i, k)) * std::sqrt(G(k, k) / G(j, j));
      inverse_error_(i, j) += 1.02 * largest * largest * rest;
    }
}

// What the factors miss G by, as it is found here; and what the target's substitutions do, two triangles and a
// diagonal: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, theorem 8.5.
MatrixXd ActiveRows::residual_of(const RoundedFactor& factor) const {
  const int n = length();
  MatrixXd result(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = 0, size = 0;
      for (int k = 0; k <= j; ++k) {
        const double term = (k < i ? factor.L(i, k) : 1) * (k < j ? factor.L(j, k) : 1) * factor.d(k);
        sum += term;
        size += std::abs(term);
      }
      const double missed = std::abs(sum - G(i, j)) + (n + 4) * double_unit * (size + std::abs(G(i, j)));
      result(i, j) = result(j, i) = 1.01 * (missed + (2 * n + 2) * unit_ * size);
    }
  return result;
}

}  // namespace lqg::design
