// SPDX-License-Identifier: MIT
// The second derivatives of the cost of a closed loop.
#include "design/order/closed_loop.hpp"
#include "design/order/loop_parts.hpp"

namespace lqg::design::order {

namespace {

// What the directions of one point share: for each product of each term, R P̂ T̃ᵀ and Lᵀ Ŝ T̃, columns ξ.
template <class T>
struct DirectionParts {
  std::vector<Matrix<T>> seen, weighed;
  std::vector<Matrix<T>> L, R;
};

template <class T>
DirectionParts<T> direction_parts(const LoopFamily<T>& family, const LoopPoint<T>& point) {
  const Index n = family.size();
  const Matrix<T> moments = detail::with_moments(family, point.P), weights = detail::with_weights(family, point.S);
  DirectionParts<T> parts;
  for (std::size_t t = 0; t < family.terms.size(); ++t) {
    const Matrix<T>& tilde = point.terms.tilde[t];
    const Matrix<T> moved = moments * tilde.topRows(n).transpose(), weighed = weights * tilde.leftCols(n);
    for (const auto& product : family.terms[t].products) {
      parts.seen.push_back(product.R * moved);
      parts.weighed.push_back(product.L.transpose() * weighed);
      parts.L.push_back(product.L.topRows(n));
      parts.R.push_back(product.R.leftCols(n));
    }
  }
  return parts;
}

// The entry (row, column) of Θ as a direction: what it adds to the equation of P, and ∂_P. Columns of half matrices.
template <class T>
void direction(const DirectionParts<T>& parts, Index row, Index column, Matrix<T>& added, Matrix<T>& slope) {
  for (std::size_t k = 0; k < parts.L.size(); ++k) {
    added += parts.L[k].col(row) * parts.seen[k].row(column);
    slope += parts.R[k].row(column).transpose() * parts.weighed[k].row(row);
  }
}

// ∂²[E, F] = 2 Σ_t tr Ŝ T'_E P̂ T̃'_Fᵀ for entries E = (a, b), F = (c, d) is 2 Σ (LᵀŜL)(c, a) (RP̂Rᵀ)(b, d): the sums
// of such pairs of matrices.
template <class T>
struct SecondPart {
  std::vector<Matrix<T>> left, right;
};

template <class T>
SecondPart<T> second_part(const LoopFamily<T>& family, const LoopPoint<T>& point) {
  const Index n = family.size(), weights = family.weight.rows(), noises = family.noise.rows();
  SecondPart<T> part;
  for (std::size_t t = 0; t < family.terms.size(); ++t)
    for (const auto& first : family.terms[t].products)
      for (const auto& second : family.terms[t].products) {
        const Matrix<T> on_S = second.L.topRows(n).transpose() * point.S * first.L.topRows(n);
        const Matrix<T> on_M = second.L.bottomRows(weights).transpose() * family.weight * first.L.bottomRows(weights);
        const Matrix<T> of_P = first.R.leftCols(n) * point.P * second.R.leftCols(n).transpose();
        const Matrix<T> of_noise = first.R.rightCols(noises) * family.noise * second.R.rightCols(noises).transpose();
        if (family.is_continuous && t == 0) {
          part.left.insert(part.left.end(), {on_S, on_M});  // nothing of second order in Φ₀P
          part.right.insert(part.right.end(), {of_noise, of_P});
        } else {
          part.left.push_back(on_S + on_M);
          part.right.push_back(of_P + of_noise);
        }
      }
  return part;
}

}  // namespace

template <class T>
Matrix<T> hessian(const LoopFamily<T>& family, const LoopPoint<T>& point) {
  const Index n = family.size(), count = family.free_entries(), N = n * (n + 1) / 2;
  const DirectionParts<T> parts = direction_parts(family, point);
  const SecondPart<T> second = second_part(family, point);
  Matrix<T> added(N, count), slopes(N, count);
  std::vector<std::pair<Index, Index>> entries;
  for (Index column = 0; column < family.ny + family.order; ++column)
    for (Index row = 0; row < family.nu + family.order; ++row) {
      if (!family.is_free(row, column)) continue;
      Matrix<T> addition = Matrix<T>::Zero(n, n), slope = Matrix<T>::Zero(n, n);
      direction(parts, row, column, addition, slope);
      const Index k = static_cast<Index>(entries.size());
      added.col(k) = half_column<T>(addition + addition.transpose());
      slopes.col(k) = half_column<T>(slope + slope.transpose());
      entries.emplace_back(row, column);
    }
  const Matrix<T> changes = point.map.solve_columns(added);
  const Matrix<T> cross = slopes.transpose() * changes;
  Matrix<T> result = cross + cross.transpose();
  for (Index k = 0; k < count; ++k)
    for (Index l = 0; l < count; ++l) {
      const auto [a, b] = entries[static_cast<std::size_t>(k)];
      const auto [c, d] = entries[static_cast<std::size_t>(l)];
      for (std::size_t s = 0; s < second.left.size(); ++s)
        result(k, l) += T(2) * second.left[s](c, a) * second.right[s](b, d);
    }
  return detail::symmetric(result);
}

template Matrix<double> hessian(const LoopFamily<double>&, const LoopPoint<double>&);
template Matrix<Real> hessian(const LoopFamily<Real>&, const LoopPoint<Real>&);

}  // namespace lqg::design::order
