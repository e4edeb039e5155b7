// SPDX-License-Identifier: MIT
#include "emit/recorded/row_pattern.hpp"

namespace lqg::emit {

namespace {

// What the library asks for: four rows are multiplied at a time, a column is a byte.
constexpr Eigen::Index least_states = 4, most_states = 255;

// An entry of a pattern takes 17 instructions for four products, all entries 15 for four, and a row begins more often.
bool is_cheaper(long entries, long all) { return 4 * entries < 3 * all; }

}  // namespace

RowPattern row_pattern(const Controller& controller, std::size_t start) {
  const design::RealMatrix& A = plant_at(controller, start).A;
  const design::RealMatrix* A_free =
      controller.solution.online && controller.keeps.innovation ? &online_at(controller, start).A_free : nullptr;
  RowPattern pattern(static_cast<std::size_t>(A.rows()));
  if (A.rows() < least_states || A.rows() > most_states) return {};
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (A(i, j) != 0 || (A_free && (*A_free)(i, j) != 0))
        pattern[static_cast<std::size_t>(i)].push_back(static_cast<int>(j));
  return is_cheaper(entries_of(pattern), static_cast<long>(A.size())) ? pattern : RowPattern{};
}

long size_of(const RowPattern& pattern) { return static_cast<long>(pattern.size()) + entries_of(pattern); }

long entries_of(const RowPattern& pattern) {
  long entries = 0;
  for (const std::vector<int>& row : pattern) entries += static_cast<long>(row.size());
  return entries;
}

design::RealMatrix entries_in(const RowPattern& pattern, const design::RealMatrix& matrix) {
  design::RealMatrix row(1, entries_of(pattern));
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i)
    for (const int j : pattern[i]) row(0, at++) = matrix(static_cast<Eigen::Index>(i), j);
  return row;
}

}  // namespace lqg::emit
