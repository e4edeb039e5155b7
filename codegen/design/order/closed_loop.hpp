// SPDX-License-Identifier: MIT
// The closed loop of a plant and a compensator Θ = [D C; B A], its cost, and the derivatives of the cost in Θ.
//
// Every term t of the loop is affine in Θ. With ξ = [x; z], the noise ω = [w; v] and e = [x; u], which is weighed:
//
//   [ξ⁺; e] = Σ_t γ_t T_t [ξ; ω],   T_t = F_t + Σ_s L_ts Θ R_ts,   E[γ_t γ_s] = 1 where t = s, else 0,   γ₀ = 1
//   P = [Σ_t T_t P̂ T_tᵀ]_ξξ,  P̂ = diag(P, Ω)        S = [Σ_t T_tᵀ Ŝ T_t]_ξξ,  Ŝ = diag(S, M)
//   J = tr M [Σ_t T_t P̂ T_tᵀ]_ee                    ∂J/∂Θ = 2 Σ_t Σ_s L_tsᵀ Ŝ T̃_t P̂ R_tsᵀ
//
// where T̃ = T. A continuous loop, ξ̇ in the place of ξ⁺, has Φ₀P + PΦ₀ᵀ for the term 0 of its ξξ block; then T̃₀ is T₀
// with the identity in the place of Φ₀, and the same formulas hold.
#pragma once

#include <vector>

#include "design/order/moment_map.hpp"
#include "design/order/order_search.hpp"

namespace lqg::design::order {

template <class T>
struct LoopTerm {
  struct Product {
    Matrix<T> L, R;
  };
  Matrix<T> fixed;
  std::vector<Product> products;
};

template <class T>
struct LoopFamily {
  Index nx = 0, nu = 0, ny = 0, order = 0;
  bool is_continuous = false, has_feedthrough = false;
  std::vector<LoopTerm<T>> terms;
  Matrix<T> noise, weight;  // Ω, M

  Index size() const { return nx + order; }  // of ξ
  bool is_free(Index row, Index column) const { return has_feedthrough || row >= nu || column >= ny; }
  Index free_entries() const { return (nu + order) * (ny + order) - (has_feedthrough ? 0 : nu * ny); }
};

// The loops of a problem with compensators of that order, in doubles or in the digits in force.
template <class T>
LoopFamily<T> loop_family(const OrderProblem& problem, Index order);

// An easier problem, which 0 leaves as it is: Φ → Φ/(1 + ease), the square root of a discount; continuous:
// Φ₀ → Φ₀ − ease I.
LoopFamily<double> eased(LoopFamily<double> family, double ease);

// The free entries of Θ as a column, and back.
template <class T>
Matrix<T> packed(const LoopFamily<T>& family, const Matrix<T>& Theta);
template <class T>
Matrix<T> unpacked(const LoopFamily<T>& family, const Matrix<T>& column);

// T_t, T̃_t and Φ_t at one Θ.
template <class T>
struct LoopTerms {
  std::vector<Matrix<T>> full, tilde, Phi;
};
template <class T>
LoopTerms<T> terms_at(const LoopFamily<T>& family, const Matrix<T>& Theta);

// Y of the two equations: all but what P (S) itself adds.
template <class T>
Matrix<T> moments_added(const LoopFamily<T>& family, const LoopTerms<T>& terms);
template <class T>
Matrix<T> duals_added(const LoopFamily<T>& family, const LoopTerms<T>& terms);

template <class T>
T cost_of(const LoopFamily<T>& family, const LoopTerms<T>& terms, const Matrix<T>& P);
template <class T>
Matrix<T> gradient_of(const LoopFamily<T>& family, const LoopTerms<T>& terms, const Matrix<T>& P, const Matrix<T>& S);

// Everything at one Θ whose loop is stable in the mean square.
template <class T>
struct LoopPoint {
  bool is_stable = false;
  Matrix<T> Theta;
  LoopTerms<T> terms;
  MomentMap<T> map;
  Matrix<T> P, S;
  T cost;
};
template <class T>
LoopPoint<T> point_at(const LoopFamily<T>& family, const Matrix<T>& Theta);

// Gradient and Hessian in the free entries. With dP[E] the change of P under the change E of Θ, Lagrange's function
// tr Ŝ Σ T P̂ Tᵀ − tr S P gives d²J[E, F] = ∂²[E, F] + ∂_P[E] dP[F] + ∂_P[F] dP[E]: one equation a direction.
template <class T>
Matrix<T> gradient(const LoopFamily<T>& family, const LoopPoint<T>& point);
template <class T>
Matrix<T> hessian(const LoopFamily<T>& family, const LoopPoint<T>& point);

// The tangents of the orbit Θ → diag(I, X) Θ diag(I, X)⁻¹, along which J does not change: a column each.
template <class T>
Matrix<T> orbit_tangents(const LoopFamily<T>& family, const Matrix<T>& Theta);

}  // namespace lqg::design::order
