// SPDX-License-Identifier: MIT
// Linear equations of any rank.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// A x = b after elimination with the largest pivot of all that is left.
struct Eliminated {
  Index rank = 0;           // pivots that are more than rounding, of rows scaled to a largest entry of 1
  RealMatrix null;          // columns: a basis of A x = 0
  RealMatrix particular;    // A x = b where that has a solution, with zeros for the free unknowns
  bool is_solvable = true;  // b depends on the columns of A
};

Eliminated eliminated(const RealMatrix& A);
Eliminated eliminated(const RealMatrix& A, const RealMatrix& b);

// A solution whose entries are 0 where they are nothing beside the largest one: what elimination leaves of a zero is
// one.
RealMatrix without_rounding(RealMatrix solution);

}  // namespace lqg::design
