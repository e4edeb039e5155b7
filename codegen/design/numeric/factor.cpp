// SPDX-License-Identifier: MIT
#include "design/numeric/factor.hpp"

namespace lqg::design {

Factors lower_factors(const RealMatrix& P) {
  const Index n = P.rows();
  Factors result = {identity(n), RealVector(n)};
  for (Index j = 0; j < n; ++j) {
    Real pivot = P(j, j);
    for (Index k = 0; k < j; ++k) pivot -= result.U(j, k) * result.U(j, k) * result.d(k);
    result.d(j) = pivot;
    if (!(pivot > 0)) continue;
    for (Index i = j + 1; i < n; ++i) {
      Real entry = P(i, j);
      for (Index k = 0; k < j; ++k) entry -= result.U(i, k) * result.d(k) * result.U(j, k);
      result.U(i, j) = entry / pivot;
    }
  }
  return result;
}

Factors upper_factors(const RealMatrix& P) {
  const Index n = P.rows();
  const Real least = power_of_ten(-40);
  Factors result = {identity(n), RealVector(n)};
  for (Index j = n - 1; j >= 0; --j) {
    Real pivot = P(j, j);
    for (Index k = j + 1; k < n; ++k) pivot -= result.U(j, k) * result.U(j, k) * result.d(k);
    if (abs(pivot) <= least * P(j, j)) pivot = 0;
    result.d(j) = pivot;
    if (pivot.is_zero()) continue;
    for (Index i = 0; i < j; ++i) {
      Real entry = P(i, j);
      for (Index k = j + 1; k < n; ++k) entry -= result.U(i, k) * result.d(k) * result.U(j, k);
      result.U(i, j) = entry / pivot;
    }
  }
  return result;
}

bool positive_definite(const RealMatrix& P) {
  const Factors factors = lower_factors(P);
  for (Index i = 0; i < factors.d.size(); ++i)
    if (!(factors.d(i) > 0)) return false;
  return true;
}

Real least_scaled_eigenvalue(const RealMatrix& P) {
  RealMatrix scaled = P;
  for (Index i = 0; i < P.rows(); ++i)
    for (Index j = 0; j < P.cols(); ++j) {
      const Real scale = sqrt(abs(P(i, i)) * abs(P(j, j)));
      if (!scale.is_zero()) scaled(i, j) /= scale;
    }
  Real least;
  bool first = true;
  for (const ComplexReal& value : eigenvalues(scaled)) {
    if (first || value.re < least) least = value.re;
    first = false;
  }
  return least;
}

}  // namespace lqg::design
