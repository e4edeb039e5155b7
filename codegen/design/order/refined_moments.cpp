// SPDX-License-Identifier: MIT
#include "design/order/refined_moments.hpp"

#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design::order {

namespace {

RealMatrix moved(const RealMatrix& Phi, Side side, const RealMatrix& X) {
  return side == Side::moments ? congruence(Phi, X) : transpose_congruence(Phi, X);
}

// Y + what the map adds − X; continuous: Y + Φ₀X + XΦ₀ᵀ + …
RealMatrix residual_of(const std::vector<RealMatrix>& Phi, bool is_continuous, Side side, const RealMatrix& Y,
                       const RealMatrix& X) {
  RealMatrix sum = Y;
  for (std::size_t t = 0; t < Phi.size(); ++t) {
    if (t == 0 && is_continuous) {
      const RealMatrix drift = side == Side::moments ? multiply(Phi[t], X) : transpose_multiply(Phi[t], X);
      sum += drift + drift.transpose();
    } else {
      sum += moved(Phi[t], side, X);
    }
  }
  return is_continuous ? sum : RealMatrix(sum - X);
}

template <class T>
Matrix<T> solved(const MomentMap<T>& map, Side side, const Matrix<T>& Y) {
  return side == Side::moments ? map.solve(Y) : map.solve_dual(Y);
}

}  // namespace

std::optional<RealMatrix> refined_moments(const MomentMap<double>& rough, const std::vector<RealMatrix>& Phi,
                                          bool is_continuous, Side side, const RealMatrix& Y, const RealMatrix& near) {
  const int most_corrections = 100;
  RealMatrix X = near.size() > 0 ? near : zeros(Y.rows(), Y.cols());
  RealMatrix residual = residual_of(Phi, is_continuous, side, Y, X);
  Real size = largest_entry(residual);
  for (int k = 0; k < most_corrections; ++k) {
    report_progress("Second moments, refinement", k);
    if (size <= negligible(0.95) * (largest_entry(X) + largest_entry(Y))) return X;
    const Matrix<double> correction = solved<double>(rough, side, to_doubles(residual / size));
    if (!correction.allFinite()) break;
    X += size * symmetric_part(real(correction));
    residual = residual_of(Phi, is_continuous, side, Y, X);
    const Real before = size;
    size = largest_entry(residual);
    if (!(size < before / 4)) break;
  }
  const RealMatrix exact = solved<Real>(MomentMap<Real>(Phi, is_continuous), side, Y);
  for (Index i = 0; i < exact.size(); ++i)
    if (!isfinite(exact.data()[i])) return std::nullopt;
  return exact;
}

}  // namespace lqg::design::order
