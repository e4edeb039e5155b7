// SPDX-License-Identifier: MIT
// Gains that give a closed loop the poles that are wanted.
#pragma once

#include <optional>
#include <vector>

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// With several inputs the poles leave a choice: the eigenvectors x of A − BK, and g = Kx. It is made once, for a
// well-conditioned set of eigenvectors, and kept in doubles, so that K is a function of exact numbers.
struct PlacementChoice {
  std::vector<Index> inputs;   // independent columns of B, the others follow from them
  std::vector<int> exponents;  // column j of them is scaled by 2^(−exponent)
  // For each pole, for a conjugate pair once: near [x; g], or near [Re x; Im x; Re g; Im g].
  std::vector<Eigen::VectorXd> directions;
};

// The choice for A (nx × nx), B (nx × nu) and the poles: those with an imaginary part ≥ 0, each standing for its
// conjugate, too. Alternating projections of one eigenvector after the other away from the span of all others, so
// that |det X| of the unit eigenvectors grows: J. Kautsky, N. K. Nichols, P. Van Dooren, "Robust pole assignment in
// linear state feedback", International Journal of Control 41 (1985), 1129–1155, method 0; conjugate pairs together:
// A. L. Tits, Y. Yang, "Globally convergent algorithms for robust pole assignment by state feedback", IEEE
// Transactions on Automatic Control 41 (1996), 1432–1452. Empty when (A, B) is not reachable, or when a pole is
// repeated more often than these inputs allow independent eigenvectors.
std::optional<PlacementChoice> choose_placement(const RealMatrix& A, const RealMatrix& B,
                                                const std::vector<ComplexReal>& poles);

// K (nu × nx) with the poles of A − BK. With one independent input K is unique, and poles may repeat as they like:
// J. Ackermann's formula, taken through the controller's Hessenberg form. Else, for each pole, [x; g] is the
// direction of the choice projected onto (A − λ)x = Bg, and K X = G. Empty as above.
std::optional<RealMatrix> place(const RealMatrix& A, const RealMatrix& B, const std::vector<ComplexReal>& poles,
                                const PlacementChoice& choice);

namespace detail {

// B with the chosen columns, scaled.
RealMatrix chosen_inputs(const RealMatrix& B, const PlacementChoice& choice);

// [A − λ, −B] on [x; g]; of a complex λ = a + jb on [Re x; Im x; Re g; Im g].
RealMatrix eigenvector_equation(const RealMatrix& A, const RealMatrix& B, const ComplexReal& pole);

// d − Fᵀ(FFᵀ)⁻¹F d, column by column; empty when F has not the full row rank.
std::optional<RealMatrix> onto_null_space(const RealMatrix& F, const RealMatrix& d);

}  // namespace detail

}  // namespace lqg::design
