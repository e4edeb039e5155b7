// SPDX-License-Identifier: MIT
// How near a matrix is to one of less rank, in roundings of its own numbers.
#pragma once

#include <Eigen/Core>

namespace lqg::design {

// The least share ε by which numbers of sizes E have to move for wᴴ(M + ΔM) = 0 with |ΔM| ≤ ε E:
//   ε(w) = max_j |wᴴM|_j / (|w|ᵀE)_j     (W. Oettli, W. Prager, Numerische Mathematik 6, 1964),
// small over w. It does not depend on the units of rows and columns, and a number that is 0 stays 0. What is found
// is that of one w, a witness: the least may be smaller by a small factor.
struct RoundingDistance {
  double share = 0;
  Eigen::VectorXd weights;  // |w|, of rows that are scaled to be alike
};

// M has no more rows than columns. Where a w is far from a witness, above `far`, none better is looked for.
RoundingDistance rounding_distance(const Eigen::MatrixXcd& M, const Eigen::MatrixXd& E, double far);

}  // namespace lqg::design
