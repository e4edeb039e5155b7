// SPDX-License-Identifier: MIT
// The Kalman filter of the textbooks, with all outputs at once and an explicit inverse, in the host's longest numbers.
#pragma once

#include "random_model.hpp"

namespace lqg_test {

// x⁺ = A x + B u + w,  y = C x + D u + v,  E[w wᵀ] = W, E[v vᵀ] = V, E[w vᵀ] = Swv
class Textbook {
 public:
  using Number = long double;

  // The filter that the decorrelated model stands for: C = E⁻¹ C', V = E⁻¹ diag(V') E⁻ᵀ, Swv = M diag(V') E⁻ᵀ,
  // W = W' + M diag(V') Mᵀ.
  explicit Textbook(const Model<double>& model);

  // S = C P Cᵀ + V,  L = P Cᵀ S⁻¹,  x ← x + L ν,  ν = y − C x − D u
  void update(const Vector<Number>& y, const Vector<Number>& u_applied);
  // x ← A x⁻ + B u + (A P⁻ Cᵀ + Swv) S⁻¹ ν,  P ← A P⁻ Aᵀ + W − (A P⁻ Cᵀ + Swv) S⁻¹ (…)ᵀ,  of the prior x⁻, P⁻
  void predict(const Vector<Number>& u);

  const Vector<Number>& x() const { return x_; }
  const Matrix<Number>& P() const { return P_; }
  Matrix<Number> L() const { return P_prior_ * C_.transpose() * S_inverse_; }
  Matrix<Number> M() const { return Swv_ * S_inverse_; }
  Vector<Number> output(const Vector<Number>& x, const Vector<Number>& u) const;
  Matrix<double> raw_C() const { return C_.cast<double>(); }
  Matrix<double> raw_D() const { return D_.cast<double>(); }
  double worst_condition() const { return worst_condition_; }  // of S, so far

 private:
  Matrix<Number> A_, B_, C_, D_, W_, V_, Swv_;
  Matrix<Number> P_, P_prior_, S_inverse_;
  Vector<Number> x_, x_prior_, innovation_;
  double worst_condition_ = 1;
};

}  // namespace lqg_test
