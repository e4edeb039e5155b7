// SPDX-License-Identifier: MIT
// Linear equations for second moments, with several terms: P = Σ Φ_t P Φ_tᵀ + Y.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "design/real.hpp"

namespace lqg::design::order {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

// A symmetric matrix as a column: its lower triangle, what is off the diagonal times √2, so that the inner product of
// two columns is tr(XY).
template <class T>
Matrix<T> half_column(const Matrix<T>& X);
template <class T>
Matrix<T> from_half_column(const Matrix<T>& column, Eigen::Index size);

// The matrix of P → P − Σ Φ_t P Φ_tᵀ on such columns; continuous, Φ₀ the drift: P → −Φ₀P − PΦ₀ᵀ − Σ_{t>0} Φ_t P Φ_tᵀ.
// n(n + 1)/2 rows.
template <class T>
Matrix<T> moment_matrix(const std::vector<Matrix<T>>& Phi, bool is_continuous);

// Its factors. They make every equation cost as much as a product with a matrix of that size.
template <class T>
class MomentMap {
 public:
  MomentMap() = default;
  MomentMap(const std::vector<Matrix<T>>& Phi, bool is_continuous);

  // P of Y, and the S of the dual equation, S = Σ Φ_tᵀ S Φ_t + Y.
  Matrix<T> solve(const Matrix<T>& Y) const;
  Matrix<T> solve_dual(const Matrix<T>& Y) const;
  // Columns, several at once.
  Matrix<T> solve_columns(const Matrix<T>& columns) const;

  // Do the second moments settle? The map keeps definiteness, and so the moments settle exactly if the solution of
  // Y = I is positive definite.
  bool is_stable() const;

 private:
  Eigen::Index size_ = 0;
  Eigen::PartialPivLU<Matrix<T>> factors_;
};

// The spectral radius of P → Σ Φ_t P Φ_tᵀ; continuous: the spectral abscissa of P → Φ₀P + PΦ₀ᵀ + Σ_{t>0} Φ_t P Φ_tᵀ.
double growth_of(const std::vector<Matrix<double>>& Phi, bool is_continuous);

}  // namespace lqg::design::order
