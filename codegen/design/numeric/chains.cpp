// SPDX-License-Identifier: MIT
#include "design/numeric/chains.hpp"

#include <algorithm>
#include <numeric>

namespace lqg::design {

namespace {

constexpr Index none = -1;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The state that state i takes its value of; `none` when it is more than a delay.
Index delayed_by_one(const RealMatrix& A, const RealMatrix& B, Index i) {
  Index from = none;
  for (Index j = 0; j < A.cols(); ++j) {
    if (A(i, j).is_zero()) continue;
    if (from != none || j == i || A(i, j) != 1) return none;
    from = j;
  }
  return is_zero(B.row(i)) ? from : none;
}

// Those that are named by themselves.
std::vector<Index> own_names(const std::vector<Index>& names) {
  std::vector<Index> result;
  for (Index i = 0; i < static_cast<Index>(names.size()); ++i)
    if (names[at(i)] == i) result.push_back(i);
  return result;
}

// Each state's first equal one.
std::vector<Index> equal_states(const RealMatrix& A, const RealMatrix& B) {
  const Index n = A.rows();
  RealMatrix columns = beside(A, B).transpose();  // a state's row is a column: it lies in one piece
  std::vector<Index> first(at(n)), unsettled(at(n));
  std::iota(first.begin(), first.end(), Index{0});
  std::iota(unsettled.begin(), unsettled.end(), Index{0});
  while (!unsettled.empty()) {
    const Index i = unsettled.back();
    unsettled.pop_back();
    for (Index j = 0; j < n && first[at(i)] == i; ++j) {
      if (j == i || first[at(j)] != j || columns.col(i) != columns.col(j)) continue;
      const Index stays = std::min(i, j), goes = std::max(i, j);
      std::replace(first.begin(), first.end(), goes, stays);
      for (Index k = 0; k < n; ++k) {
        if (columns(goes, k).is_zero()) continue;
        columns(stays, k) += columns(goes, k);
        columns(goes, k) = 0;
        unsettled.push_back(k);
      }
      unsettled.push_back(stays);
    }
  }
  return first;
}

}  // namespace

std::vector<Index> Chains::kept() const { return own_names(source); }

Chains chains_of(const RealMatrix& A, const RealMatrix& B) {
  const Index n = A.rows();
  std::vector<Index> before;
  for (Index i = 0; i < n; ++i) before.push_back(delayed_by_one(A, B, i));
  Chains chains = {std::vector<Index>(at(n)), std::vector<Index>(at(n), 0)};
  for (Index i = 0; i < n; ++i) {
    Index source = i, ago = 0;
    for (; before[at(source)] != none && ago < n; ++ago) source = before[at(source)];
    if (ago == n) {  // a ring of delays: one of them has to be there
      before[at(i)] = none;
      source = i;
      ago = 0;
    }
    chains.source[at(i)] = source;
    chains.ago[at(i)] = ago;
  }
  return chains;
}

Merged with_equal_states_merged(const RealMatrix& A, const RealMatrix& B) {
  const std::vector<Index> first = equal_states(A, B), kept = own_names(first);
  const Index all = A.rows(), size = static_cast<Index>(kept.size());
  Merged merged = {RealMatrix(size, all), RealMatrix(size, B.cols()), zeros(all, size)};
  for (Index k = 0; k < size; ++k) {
    merged.A.row(k) = A.row(kept[at(k)]);
    if (B.cols() > 0) merged.B.row(k) = B.row(kept[at(k)]);
    for (Index i = 0; i < all; ++i)
      if (first[at(i)] == kept[at(k)]) merged.spread(i, k) = 1;
  }
  merged.A = multiply(merged.A, merged.spread);
  return merged;
}

}  // namespace lqg::design
