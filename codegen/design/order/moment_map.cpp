// SPDX-License-Identifier: MIT
#include "design/order/moment_map.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace lqg::design::order {

using Eigen::Index;

namespace {

template <class T>
bool has_positive_pivots(Matrix<T> X) {
  for (Index k = 0; k < X.rows(); ++k) {
    if (!(X(k, k) > 0)) return false;
    for (Index i = k + 1; i < X.rows(); ++i) {
      const T share = X(i, k) / X(k, k);
      for (Index j = k + 1; j <= i; ++j) X(i, j) -= share * X(j, k);
    }
  }
  return true;
}

// Column (k, l) of a term: Φ E Φᵀ of the unit matrix E that belongs to it.
template <class T>
void add_term(const Matrix<T>& Phi, Index k, Index l, const T& root, Matrix<T>& image) {
  const Index n = Phi.rows();
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i)
      image(i, j) += k == l ? T(Phi(i, k) * Phi(j, k)) : T((Phi(i, k) * Phi(j, l) + Phi(i, l) * Phi(j, k)) / root);
}

// Φ E + E Φᵀ, the same for a drift.
template <class T>
void add_drift(const Matrix<T>& Phi, Index k, Index l, const T& root, Matrix<T>& image) {
  const auto add = [&](Index i, Index j, const T& value) { image(std::max(i, j), std::min(i, j)) += value; };
  for (Index i = 0; i < Phi.rows(); ++i) {
    if (k == l) {
      add(i, k, i == k ? T(2 * Phi(i, k)) : Phi(i, k));
      continue;
    }
    add(i, l, i == l ? T(2 * Phi(i, k) / root) : T(Phi(i, k) / root));
    add(i, k, i == k ? T(2 * Phi(i, l) / root) : T(Phi(i, l) / root));
  }
}

}  // namespace

template <class T>
Matrix<T> half_column(const Matrix<T>& X) {
  using std::sqrt;
  const Index n = X.rows();
  const T root = sqrt(T(2));
  Matrix<T> column(n * (n + 1) / 2, 1);
  Index next = 0;
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) column(next++, 0) = i == j ? X(i, j) : T((X(i, j) + X(j, i)) / root);
  return column;
}

template <class T>
Matrix<T> from_half_column(const Matrix<T>& column, Index size) {
  using std::sqrt;
  const T root = sqrt(T(2));
  Matrix<T> X(size, size);
  Index next = 0;
  for (Index j = 0; j < size; ++j)
    for (Index i = j; i < size; ++i, ++next) X(i, j) = X(j, i) = i == j ? column(next, 0) : T(column(next, 0) / root);
  return X;
}

template <class T>
Matrix<T> moment_matrix(const std::vector<Matrix<T>>& Phi, bool is_continuous) {
  using std::sqrt;
  const Index n = Phi.front().rows(), N = n * (n + 1) / 2;
  const T root = sqrt(T(2));
  Matrix<T> result(N, N);
  Index column = 0;
  for (Index l = 0; l < n; ++l)
    for (Index k = l; k < n; ++k, ++column) {
      Matrix<T> image = Matrix<T>::Zero(n, n);  // of which the lower triangle counts
      for (std::size_t t = 0; t < Phi.size(); ++t) {
        if (t == 0 && is_continuous)
          add_drift(Phi[t], k, l, root, image);
        else
          add_term(Phi[t], k, l, root, image);
      }
      Index row = 0;
      for (Index j = 0; j < n; ++j)
        for (Index i = j; i < n; ++i, ++row) result(row, column) = i == j ? T(-image(i, j)) : T(-root * image(i, j));
      if (!is_continuous) result(column, column) += 1;
    }
  return result;
}

template <class T>
MomentMap<T>::MomentMap(const std::vector<Matrix<T>>& Phi, bool is_continuous)
    : size_(Phi.front().rows()), factors_(moment_matrix(Phi, is_continuous)) {}

template <class T>
Matrix<T> MomentMap<T>::solve_columns(const Matrix<T>& columns) const {
  return factors_.solve(columns);
}

template <class T>
Matrix<T> MomentMap<T>::solve(const Matrix<T>& Y) const {
  return from_half_column<T>(factors_.solve(half_column<T>(Y)), size_);
}

template <class T>
Matrix<T> MomentMap<T>::solve_dual(const Matrix<T>& Y) const {
  return from_half_column<T>(factors_.transpose().solve(half_column<T>(Y)), size_);
}

template <class T>
bool MomentMap<T>::is_stable() const {
  return size_ == 0 || has_positive_pivots<T>(solve(Matrix<T>::Identity(size_, size_)));
}

double growth_of(const std::vector<Matrix<double>>& Phi, bool is_continuous) {
  if (Phi.front().rows() == 0) return is_continuous ? -HUGE_VAL : 0;
  if (Phi.size() == 1) {
    const Eigen::VectorXcd poles = Phi.front().eigenvalues();
    return is_continuous ? 2 * poles.real().maxCoeff() : poles.cwiseAbs2().maxCoeff();
  }
  Matrix<double> map = -moment_matrix(Phi, is_continuous);
  if (!is_continuous) map.diagonal().array() += 1;
  return map.eigenvalues().real().maxCoeff();  // that eigenvalue is real: the map keeps definiteness
}

template Matrix<double> half_column(const Matrix<double>&);
template Matrix<Real> half_column(const Matrix<Real>&);
template Matrix<double> from_half_column(const Matrix<double>&, Index);
template Matrix<Real> from_half_column(const Matrix<Real>&, Index);
template Matrix<double> moment_matrix(const std::vector<Matrix<double>>&, bool);
template Matrix<Real> moment_matrix(const std::vector<Matrix<Real>>&, bool);
template class MomentMap<double>;
template class MomentMap<Real>;

}  // namespace lqg::design::order
