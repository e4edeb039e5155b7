// SPDX-License-Identifier: MIT
// A real matrix in the coordinates of its modes.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// A T = T Λ, the blocks of Λ by falling |λ|: [σ] for a real eigenvalue, [σ ω; −ω σ] for a pair σ ± jω, ω > 0.
struct ModalBasis {
  RealMatrix blocks, T, inverse;
  std::vector<Index> starts;  // of the blocks, and the end
};

// Parts of `A` that know nothing of each other are taken apart first, so that they may have the same eigenvalues.
// Within one part a repeated eigenvalue makes T singular, exactly (empty) or up to the digits.
std::optional<ModalBasis> modal_basis(const RealMatrix& A);

// Uses up what freedom the blocks leave: in each of them the largest row of C T becomes [1] or [1 0], which takes no
// multiplication. A mode that C does not see stays as it is.
void take_to_one(ModalBasis& basis, const RealMatrix& C);

}  // namespace lqg::design
