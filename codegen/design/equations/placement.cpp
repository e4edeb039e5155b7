// SPDX-License-Identifier: MIT
#include "design/equations/placement.hpp"

namespace lqg::design {

namespace detail {

RealMatrix chosen_inputs(const RealMatrix& B, const PlacementChoice& choice) {
  RealMatrix chosen(B.rows(), static_cast<Index>(choice.inputs.size()));
  for (Index j = 0; j < chosen.cols(); ++j) {
    const std::size_t k = static_cast<std::size_t>(j);
    chosen.col(j) = ldexp(Real(1), -choice.exponents[k]) * B.col(choice.inputs[k]);
  }
  return chosen;
}

RealMatrix eigenvector_equation(const RealMatrix& A, const RealMatrix& B, const ComplexReal& pole) {
  const RealMatrix shifted = A - pole.re * identity(A.rows());
  if (pole.im.is_zero()) return beside(shifted, -B);
  const RealMatrix turn = pole.im * identity(A.rows()), none = zeros(B.rows(), B.cols());
  return above(beside(beside(shifted, turn), beside(-B, none)), beside(beside(-turn, shifted), beside(none, -B)));
}

std::optional<RealMatrix> onto_null_space(const RealMatrix& F, const RealMatrix& d) {
  const std::optional<RealMatrix> excess = solve(multiply_transpose(F, F), multiply(F, d));
  if (!excess) return std::nullopt;
  return d - transpose_multiply(F, *excess);
}

}  // namespace detail

namespace {

// row (A − λ), or row (A − λ)(A − λ̄) = row (A² − 2 Re λ A + |λ|²).
RealMatrix times_factor(const RealMatrix& row, const RealMatrix& A, const ComplexReal& pole) {
  const RealMatrix once = multiply(row, A);
  if (pole.im.is_zero()) return once - pole.re * row;
  return multiply(once, A) - 2 * pole.re * once + (pole.re * pole.re + pole.im * pole.im) * row;
}

// K = e_nᵀ φ(H)/(β h₁₀ h₂₁ …) in coordinates where B = β e₀ and A = H is upper Hessenberg; the Hessenberg form of
// [0 0; B A] holds both.
std::optional<RealMatrix> place_by_one_input(const RealMatrix& A, const RealMatrix& B,
                                             const std::vector<ComplexReal>& poles) {
  const Index nx = A.rows();
  RealMatrix both = zeros(nx + 1, nx + 1), none, turned = identity(nx + 1);
  both.block(1, 0, nx, 1) = B;
  both.bottomRightCorner(nx, nx) = A;
  reduce_to_hessenberg(both, none, turned);
  const RealMatrix H = both.bottomRightCorner(nx, nx);
  RealMatrix row = zeros(1, nx);
  row(0, nx - 1) = 1;
  for (const ComplexReal& pole : poles) row = times_factor(row, H, pole);
  for (Index i = 0; i < nx; ++i) {
    if (both(i + 1, i).is_zero()) return std::nullopt;
    row /= both(i + 1, i);
  }
  return multiply_transpose(row, turned.bottomRightCorner(nx, nx));
}

// K X = G.
std::optional<RealMatrix> place_by_eigenvectors(const RealMatrix& A, const RealMatrix& B,
                                                const std::vector<ComplexReal>& poles, const PlacementChoice& choice) {
  const Index nx = A.rows(), nu = B.cols();
  RealMatrix X(nx, 0), G(nu, 0);
  for (std::size_t j = 0; j < poles.size(); ++j) {
    const std::optional<RealMatrix> both =
        detail::onto_null_space(detail::eigenvector_equation(A, B, poles[j]), real(choice.directions[j]));
    if (!both) return std::nullopt;
    const Index parts = poles[j].im.is_zero() ? 1 : 2;
    for (Index part = 0; part < parts; ++part) {
      X = beside(X, both->block(part * nx, 0, nx, 1));
      G = beside(G, both->block(parts * nx + part * nu, 0, nu, 1));
    }
  }
  const std::optional<RealMatrix> K = solve(X.transpose(), G.transpose());
  if (!K) return std::nullopt;
  return K->transpose();
}

// K of all inputs from that of the chosen ones, B = B_chosen T: T⁺ K_chosen = Tᵀ(TTᵀ)⁻¹K_chosen.
std::optional<RealMatrix> spread_over_inputs(const RealMatrix& B, const RealMatrix& chosen, const RealMatrix& K) {
  const std::optional<RealMatrix> T = solve(transpose_multiply(chosen, chosen), transpose_multiply(chosen, B));
  if (!T) return std::nullopt;
  const std::optional<RealMatrix> weighed = solve(multiply_transpose(*T, *T), K);
  if (!weighed) return std::nullopt;
  return transpose_multiply(*T, *weighed);
}

}  // namespace

std::optional<RealMatrix> place(const RealMatrix& A, const RealMatrix& B, const std::vector<ComplexReal>& poles,
                                const PlacementChoice& choice) {
  const RealMatrix chosen = detail::chosen_inputs(B, choice);
  const std::optional<RealMatrix> K =
      chosen.cols() == 1 ? place_by_one_input(A, chosen, poles) : place_by_eigenvectors(A, chosen, poles, choice);
  if (!K) return std::nullopt;
  return spread_over_inputs(B, chosen, *K);
}

}  // namespace lqg::design
