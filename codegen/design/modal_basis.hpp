// A real matrix in the coordinates of its modes.
#pragma once

#include "design/linear_algebra.hpp"

namespace lqg::design {

// A T = T Λ, the blocks of Λ by falling |λ|: [σ] for a real eigenvalue, [σ ω; −ω σ] for a pair σ ± jω, ω > 0.
struct ModalBasis {
  RealMatrix blocks, T, inverse;
  std::vector<Index> starts;  // of the blocks, and the end
  // max κ over the eigenvalues, κ = Σ_k |l_k| |r_k| of the left and right eigenvectors with l r = 1: to first order, by how
  // much a relative change of A's entries moves an eigenvalue, whatever the units of the states. (R. D. Skeel, "Scaling for
  // numerical stability in Gaussian elimination", J. ACM 26 (1979), 494–526, has this condition for linear systems.)
  Real condition;
};

// Parts of `A` that know nothing of each other are taken apart first, so that they may have the same eigenvalues. Within one
// part a repeated eigenvalue makes T singular: then there is no basis, or one with a condition of the order of the digits.
std::optional<ModalBasis> modal_basis(const RealMatrix& A);

}  // namespace lqg::design
