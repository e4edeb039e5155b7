// SPDX-License-Identifier: MIT
#include "design/numeric/modal_basis.hpp"

#include <algorithm>
#include <numeric>

#include "design/numeric/modes.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// The indices of each part of `a` that shares no entry with the others.
std::vector<std::vector<Index>> parts_of(const RealMatrix& a) {
  std::vector<Index> part(static_cast<std::size_t>(a.rows()));
  std::iota(part.begin(), part.end(), 0);
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < a.cols(); ++j) {
      const Index from = part[static_cast<std::size_t>(i)], to = part[static_cast<std::size_t>(j)];
      if (!a(i, j).is_zero()) std::replace(part.begin(), part.end(), std::max(from, to), std::min(from, to));
    }
  std::vector<std::vector<Index>> parts;
  for (Index first = 0; first < a.rows(); ++first) {
    std::vector<Index> members;
    for (Index i = first; i < a.rows(); ++i)
      if (part[static_cast<std::size_t>(i)] == first) members.push_back(i);
    if (!members.empty()) parts.push_back(members);
  }
  return parts;
}

// A mode with its columns of T, [r] or [re r, im r] of (A − λ) r = 0.
struct Eigenmode {
  ComplexReal value;
  RealMatrix columns;
};

std::vector<Eigenmode> modes_of(const RealMatrix& a, const std::vector<Index>& part) {
  const Index size = static_cast<Index>(part.size());
  RealMatrix own(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j)
      own(i, j) = a(part[static_cast<std::size_t>(i)], part[static_cast<std::size_t>(j)]);
  std::vector<Eigenmode> modes;
  for (const ComplexReal& value : eigenvalues(own)) {
    if (value.im < 0) continue;
    const LeftEigenvector of_transpose = left_eigenvector(own.transpose(), value);
    const RealMatrix vector = value.im.is_zero() ? of_transpose.re : beside(of_transpose.re, of_transpose.im);
    RealMatrix columns = zeros(a.rows(), vector.cols());
    for (Index i = 0; i < size; ++i)
      columns.row(part[static_cast<std::size_t>(i)]) = vector.row(i) / largest_entry(vector);
    modes.push_back({value, columns});
  }
  return modes;
}

// An order that rounding does not change: by falling |λ|, then by falling real part, as floats.
bool is_before(const Eigenmode& a, const Eigenmode& b) {
  const auto size = [](const Eigenmode& mode) { return to_float(hypot(mode.value.re, mode.value.im)); };
  return size(a) != size(b) ? size(a) > size(b) : to_float(a.value.re) > to_float(b.value.re);
}

// Columns of T within a block, times R = [p q; −q p] (or [p]), which the block does not notice.
void take_block_to_one(ModalBasis& basis, Index start, Index size, const RealMatrix& C) {
  const RealMatrix columns = basis.T.middleCols(start, size), own = multiply(C, columns);
  const RealMatrix squares = own.cwiseProduct(own).rowwise().sum();
  Index largest = 0;
  for (Index i = 1; i < own.rows(); ++i)
    if (squares(i) > 1.001 * squares(largest)) largest = i;  // of equal ones the first, whatever their rounding is
  if (!(sqrt(squares(largest)) > negligible(0.6) * largest_entry(C) * largest_entry(columns))) return;
  const RealMatrix row = own.row(largest);
  RealMatrix R = zeros(size, size), inverse = zeros(size, size);
  for (Index i = 0; i < size; ++i) {
    R(i, i) = row(0) / squares(largest);
    inverse(i, i) = row(0);
  }
  if (size == 2) {
    R(1, 0) = row(1) / squares(largest), R(0, 1) = -R(1, 0);
    inverse(0, 1) = row(1), inverse(1, 0) = -row(1);
  }
  basis.T.middleCols(start, size) = multiply(columns, R);
  basis.inverse.middleRows(start, size) = multiply(inverse, basis.inverse.middleRows(start, size));
}

}  // namespace

std::optional<ModalBasis> modal_basis(const RealMatrix& A) {
  std::vector<Eigenmode> modes;
  for (const std::vector<Index>& part : parts_of(A))
    for (const Eigenmode& mode : modes_of(A, part)) modes.push_back(mode);
  std::stable_sort(modes.begin(), modes.end(), is_before);

  ModalBasis basis;
  basis.blocks = zeros(A.rows(), A.rows());
  basis.T = zeros(A.rows(), 0);
  basis.starts = {0};
  for (const Eigenmode& mode : modes) {
    const Index at = basis.T.cols(), size = mode.columns.cols();
    if (at + size > A.rows()) return std::nullopt;  // eigenvalues that were not found
    for (Index i = 0; i < size; ++i) basis.blocks(at + i, at + i) = mode.value.re;
    if (size == 2) basis.blocks(at, at + 1) = mode.value.im, basis.blocks(at + 1, at) = -mode.value.im;
    basis.T = beside(basis.T, mode.columns);
    basis.starts.push_back(at + size);
  }
  if (basis.T.cols() != A.rows()) return std::nullopt;
  const std::optional<RealMatrix> inverse = solve(basis.T, identity(A.rows()));
  if (!inverse) return std::nullopt;
  basis.inverse = *inverse;
  return basis;
}

void take_to_one(ModalBasis& basis, const RealMatrix& C) {
  for (std::size_t i = 0; i + 1 < basis.starts.size(); ++i)
    take_block_to_one(basis, basis.starts[i], basis.starts[i + 1] - basis.starts[i], C);
}

}  // namespace lqg::design
