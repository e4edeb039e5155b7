// SPDX-License-Identifier: MIT
#include "design/numeric/elimination.hpp"

#include <numeric>

namespace lqg::design {

namespace {

struct Place {
  Index row, column;
  Real size;
};

Place largest_of_rest(const RealMatrix& A, Index from) {
  Place place = {from, from, Real(0)};
  for (Index j = from; j < A.cols(); ++j)
    for (Index i = from; i < A.rows(); ++i)
      if (abs(A(i, j)) > place.size) place = {i, j, abs(A(i, j))};
  return place;
}

void scale_rows(RealMatrix& A, RealMatrix& b) {
  for (Index i = 0; i < A.rows(); ++i) {
    const Real size = largest_entry(A.row(i));
    if (size.is_zero()) continue;
    A.row(i) /= size;
    b.row(i) /= size;
  }
}

// Makes column `k` of all rows but `k` zero, and the pivot 1.
void clear_column(RealMatrix& A, RealMatrix& b, Index k) {
  const Real pivot = A(k, k);
  A.row(k) /= pivot;
  b.row(k) /= pivot;
  for (Index i = 0; i < A.rows(); ++i) {
    const Real factor = A(i, k);
    if (i == k || factor.is_zero()) continue;
    A.row(i) -= factor * A.row(k);
    b.row(i) -= factor * b.row(k);
    A(i, k) = 0;
  }
}

// Rows of the unknowns in their own order again.
RealMatrix in_order(const RealMatrix& a, const std::vector<Index>& unknowns) {
  RealMatrix result(a.rows(), a.cols());
  for (Index i = 0; i < a.rows(); ++i) result.row(unknowns[static_cast<std::size_t>(i)]) = a.row(i);
  return result;
}

}  // namespace

Eliminated eliminated(const RealMatrix& A_given, const RealMatrix& b_given) {
  RealMatrix A = A_given, b = b_given;
  scale_rows(A, b);
  const Real rounding = negligible(0.6);
  std::vector<Index> unknowns(static_cast<std::size_t>(A.cols()));
  std::iota(unknowns.begin(), unknowns.end(), Index{0});
  Eliminated result;
  for (Index k = 0; k < std::min(A.rows(), A.cols()); ++k) {
    const Place pivot = largest_of_rest(A, k);
    if (pivot.size <= rounding) break;
    A.row(k).swap(A.row(pivot.row));
    b.row(k).swap(b.row(pivot.row));
    A.col(k).swap(A.col(pivot.column));
    std::swap(unknowns[static_cast<std::size_t>(k)], unknowns[static_cast<std::size_t>(pivot.column)]);
    clear_column(A, b, k);
    ++result.rank;
  }
  const Index rank = result.rank, free = A.cols() - rank;
  result.null = in_order(above(-A.topRightCorner(rank, free), identity(free)), unknowns);
  result.particular = in_order(above(b.topRows(rank), zeros(free, b.cols())), unknowns);
  result.is_solvable = largest_entry(b.bottomRows(b.rows() - rank)) <= rounding * (1 + largest_entry(b));
  return result;
}

Eliminated eliminated(const RealMatrix& A) { return eliminated(A, zeros(A.rows(), 0)); }

RealMatrix without_rounding(RealMatrix solution) {
  const Real least = negligible(0.6) * largest_entry(solution);
  for (Index i = 0; i < solution.size(); ++i)
    if (abs(solution.data()[i]) <= least) solution.data()[i] = 0;
  return solution;
}

}  // namespace lqg::design
