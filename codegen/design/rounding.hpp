// SPDX-License-Identifier: MIT
// From many digits to the numbers of a machine: correctly rounded, to nearest even, subnormals included. Whatever
// digits are in force elsewhere: a number brings its own.
#pragma once

#include "design/real.hpp"

namespace lqg::design {

inline double to_double(const Real& x) { return mpfr_get_d(x.backend().data(), MPFR_RNDN); }
inline float to_float(const Real& x) { return mpfr_get_flt(x.backend().data(), MPFR_RNDN); }

// Entry by entry, of any matrix of Real.
template <class T, class Derived, class Round>
auto rounded_entries(const Eigen::MatrixBase<Derived>& matrix, Round round) {
  Eigen::Matrix<T, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> result(matrix.rows(), matrix.cols());
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) result(i, j) = round(matrix(i, j));
  return result;
}
template <class Derived>
auto to_doubles(const Eigen::MatrixBase<Derived>& matrix) {
  return rounded_entries<double>(matrix, to_double);
}
template <class Derived>
auto to_floats(const Eigen::MatrixBase<Derived>& matrix) {
  return rounded_entries<float>(matrix, to_float);
}

}  // namespace lqg::design
