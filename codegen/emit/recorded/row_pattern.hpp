// SPDX-License-Identifier: MIT
// Where the rows of A are not zero, for loops that leave out the rest.
#pragma once

#include <vector>

#include "controller/controller.hpp"

namespace lqg::emit {

// The columns of each row, ascending.
using RowPattern = std::vector<std::vector<int>>;

// Of A, and of A_free where noise is shared, from sample `start` on; empty where loops over all entries are no dearer.
RowPattern row_pattern(const Controller& controller, std::size_t start);

// Its length in numbers of the target: of each row how many, and which.
long size_of(const RowPattern& pattern);

// How many entries there are.
long entries_of(const RowPattern& pattern);

// One row: the entries of the matrix in the pattern, row by row.
design::RealMatrix entries_in(const RowPattern& pattern, const design::RealMatrix& matrix);

}  // namespace lqg::emit
