// SPDX-License-Identifier: MIT
// What the files of closed_loop.hpp share.
#pragma once

#include "design/order/closed_loop.hpp"

namespace lqg::design::order::detail {

template <class T>
Matrix<T> symmetric(const Matrix<T>& a) {
  return (a + a.transpose()) / T(2);
}

// diag(a, b)
template <class T>
Matrix<T> diagonal_of(const Matrix<T>& a, const Matrix<T>& b) {
  Matrix<T> result = Matrix<T>::Zero(a.rows() + b.rows(), a.cols() + b.cols());
  result.topLeftCorner(a.rows(), a.cols()) = a;
  result.bottomRightCorner(b.rows(), b.cols()) = b;
  return result;
}

// P̂ = diag(P, Ω) and Ŝ = diag(S, M)
template <class T>
Matrix<T> with_moments(const LoopFamily<T>& family, const Matrix<T>& P) {
  return diagonal_of<T>(P, family.noise);
}

template <class T>
Matrix<T> with_weights(const LoopFamily<T>& family, const Matrix<T>& S) {
  return diagonal_of<T>(S, family.weight);
}

}  // namespace lqg::design::order::detail
