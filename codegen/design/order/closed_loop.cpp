// SPDX-License-Identifier: MIT
#include "design/order/closed_loop.hpp"

#include "design/order/loop_parts.hpp"
#include "design/rounding.hpp"

namespace lqg::design::order {

namespace {

template <class T>
Matrix<T> in_scalar(const RealMatrix& a);
template <>
Matrix<double> in_scalar<double>(const RealMatrix& a) {
  return to_doubles(a);
}
template <>
Matrix<Real> in_scalar<Real>(const RealMatrix& a) {
  return in_present_digits(a);
}

// F₀ = [A 0 I 0; 0 0 0 0; I 0 0 0; 0 0 0 0], rows ξ⁺ = [x; z], e = [x; u], columns ξ, ω = [w; v].
template <class T>
Matrix<T> fixed_part(const LoopFamily<T>& family, const Matrix<T>& A) {
  const Index nx = family.nx, n = family.size();
  Matrix<T> F = Matrix<T>::Zero(n + nx + family.nu, n + nx + family.ny);
  F.topLeftCorner(nx, nx) = A;
  return F;
}

// L of ū = [u; z⁺]: [B 0; 0 I; 0 0; I 0]
template <class T>
Matrix<T> left_factor(const LoopFamily<T>& family, const Matrix<T>& B) {
  Matrix<T> L = Matrix<T>::Zero(family.size() + family.nx + family.nu, family.nu + family.order);
  L.topLeftCorner(family.nx, family.nu) = B;
  return L;
}

// R of ȳ = [y; z]: [C 0 0 I; 0 I 0 0]
template <class T>
Matrix<T> right_factor(const LoopFamily<T>& family, const Matrix<T>& C) {
  Matrix<T> R = Matrix<T>::Zero(family.ny + family.order, family.size() + family.nx + family.ny);
  R.topLeftCorner(family.ny, family.nx) = C;
  return R;
}

template <class T>
LoopTerm<T> mean_term(const LoopFamily<T>& family, const OrderProblem& problem) {
  const Index nx = family.nx, n = family.size(), nu = family.nu, ny = family.ny, order = family.order;
  Matrix<T> F = fixed_part(family, in_scalar<T>(problem.A));
  F.block(0, n, nx, nx).setIdentity();
  F.block(n, 0, nx, nx).setIdentity();
  Matrix<T> L = left_factor(family, in_scalar<T>(problem.B));
  L.block(nx, nu, order, order).setIdentity();
  L.bottomLeftCorner(nu, nu).setIdentity();
  Matrix<T> R = right_factor(family, in_scalar<T>(problem.C));
  R.topRightCorner(ny, ny).setIdentity();
  R.block(ny, nx, order, order).setIdentity();
  return {F, {{L, R}}};
}

// γ multiplies A₁ + B₁ΘR₀ + L₀ΘC₁.
template <class T>
LoopTerm<T> white_term(const LoopFamily<T>& family, const WhiteParameter& white) {
  const auto& mean = family.terms.front().products.front();
  LoopTerm<T> term;
  term.fixed = fixed_part(family, in_scalar<T>(white.A));
  if (!is_zero(white.B)) term.products.push_back({left_factor(family, in_scalar<T>(white.B)), mean.R});
  if (!is_zero(white.C)) term.products.push_back({mean.L, right_factor(family, in_scalar<T>(white.C))});
  return term;
}

// With feed-through γ_i γ_j multiplies B_i D C_j. It is white, too; for i = j it is 1 + (γ² − 1), whose second part
// has the variance E γ⁴ − 1 = 2 of a normal γ.
template <class T>
void add_product_terms(const OrderProblem& problem, LoopFamily<T>& family) {
  using std::sqrt;
  for (std::size_t i = 0; i < problem.white.size(); ++i)
    for (std::size_t j = 0; j < problem.white.size(); ++j) {
      if (is_zero(problem.white[i].B) || is_zero(problem.white[j].C)) continue;
      LoopTerm<T> term;
      term.fixed = fixed_part(family, Matrix<T>(Matrix<T>::Zero(family.nx, family.nx)));
      term.products.push_back({left_factor(family, in_scalar<T>(problem.white[i].B)),
                               right_factor(family, in_scalar<T>(problem.white[j].C))});
      if (i == j) {
        family.terms.front().products.push_back(term.products.front());
        term.products.front().L *= sqrt(T(2));
      }
      family.terms.push_back(term);
    }
}

}  // namespace

template <class T>
LoopFamily<T> loop_family(const OrderProblem& problem, Index order) {
  LoopFamily<T> family;
  family.nx = problem.A.rows();
  family.nu = problem.B.cols();
  family.ny = problem.C.rows();
  family.order = order;
  family.is_continuous = problem.is_continuous;
  family.has_feedthrough = problem.has_feedthrough;
  family.noise = in_scalar<T>(joint(problem.W, problem.Swv, problem.V));
  family.weight = in_scalar<T>(joint(problem.Q, problem.N, problem.R));
  family.terms.push_back(mean_term(family, problem));
  for (const WhiteParameter& white : problem.white) family.terms.push_back(white_term(family, white));
  if (problem.has_feedthrough) add_product_terms(problem, family);
  return family;
}

LoopFamily<double> eased(LoopFamily<double> family, double ease) {
  const Index n = family.size();
  if (family.is_continuous) {
    family.terms.front().fixed.topLeftCorner(n, n).diagonal().array() -= ease;
    return family;
  }
  for (LoopTerm<double>& term : family.terms) {
    term.fixed.topRows(n) /= 1 + ease;
    for (auto& product : term.products) product.L.topRows(n) /= 1 + ease;
  }
  return family;
}

template <class T>
Matrix<T> packed(const LoopFamily<T>& family, const Matrix<T>& Theta) {
  Matrix<T> column(family.free_entries(), 1);
  Index next = 0;
  for (Index j = 0; j < Theta.cols(); ++j)
    for (Index i = 0; i < Theta.rows(); ++i)
      if (family.is_free(i, j)) column(next++, 0) = Theta(i, j);
  return column;
}

template <class T>
Matrix<T> unpacked(const LoopFamily<T>& family, const Matrix<T>& column) {
  Matrix<T> Theta = Matrix<T>::Zero(family.nu + family.order, family.ny + family.order);
  Index next = 0;
  for (Index j = 0; j < Theta.cols(); ++j)
    for (Index i = 0; i < Theta.rows(); ++i)
      if (family.is_free(i, j)) Theta(i, j) = column(next++, 0);
  return Theta;
}

template <class T>
LoopTerms<T> terms_at(const LoopFamily<T>& family, const Matrix<T>& Theta) {
  const Index n = family.size();
  LoopTerms<T> result;
  for (const LoopTerm<T>& term : family.terms) {
    Matrix<T> full = term.fixed;
    for (const auto& product : term.products) full += product.L * (Theta * product.R);
    result.Phi.push_back(full.topLeftCorner(n, n));
    result.full.push_back(full);
    if (family.is_continuous && result.tilde.empty()) full.topLeftCorner(n, n).setIdentity();
    result.tilde.push_back(full);
  }
  return result;
}

template <class T>
Matrix<T> moments_added(const LoopFamily<T>& family, const LoopTerms<T>& terms) {
  const Index n = family.size(), noises = family.noise.rows();
  Matrix<T> Y = Matrix<T>::Zero(n, n);
  for (const Matrix<T>& full : terms.full) {
    const Matrix<T> Gamma = full.topRightCorner(n, noises);
    Y += Gamma * family.noise * Gamma.transpose();
  }
  return detail::symmetric(Y);
}

template <class T>
Matrix<T> duals_added(const LoopFamily<T>& family, const LoopTerms<T>& terms) {
  const Index n = family.size(), weights = family.weight.rows();
  Matrix<T> Y = Matrix<T>::Zero(n, n);
  for (const Matrix<T>& full : terms.full) {
    const Matrix<T> E = full.bottomLeftCorner(weights, n);
    Y += E.transpose() * family.weight * E;
  }
  return detail::symmetric(Y);
}

template <class T>
T cost_of(const LoopFamily<T>& family, const LoopTerms<T>& terms, const Matrix<T>& P) {
  const Index weights = family.weight.rows(), noises = family.noise.rows();
  T cost = (duals_added(family, terms) * P).trace();
  for (const Matrix<T>& full : terms.full) {
    const Matrix<T> F = full.bottomRightCorner(weights, noises);
    cost += (family.weight * F * family.noise * F.transpose()).trace();
  }
  return cost;
}

template <class T>
Matrix<T> gradient_of(const LoopFamily<T>& family, const LoopTerms<T>& terms, const Matrix<T>& P, const Matrix<T>& S) {
  const Matrix<T> moments = detail::with_moments(family, P), weights = detail::with_weights(family, S);
  Matrix<T> sum = Matrix<T>::Zero(family.nu + family.order, family.ny + family.order);
  for (std::size_t t = 0; t < terms.tilde.size(); ++t) {
    const Matrix<T> middle = weights * terms.tilde[t] * moments;
    for (const auto& product : family.terms[t].products) sum += product.L.transpose() * middle * product.R.transpose();
  }
  return packed<T>(family, T(2) * sum);
}

template <class T>
LoopPoint<T> point_at(const LoopFamily<T>& family, const Matrix<T>& Theta) {
  LoopPoint<T> point;
  point.Theta = Theta;
  if (!Theta.allFinite()) return point;
  point.terms = terms_at(family, Theta);
  point.map = MomentMap<T>(point.terms.Phi, family.is_continuous);
  if (!point.map.is_stable()) return point;
  point.P = point.map.solve(moments_added(family, point.terms));
  point.S = point.map.solve_dual(duals_added(family, point.terms));
  point.cost = cost_of(family, point.terms, point.P);
  point.is_stable = point.P.allFinite() && point.S.allFinite() && point.cost >= 0;
  return point;
}

template <class T>
Matrix<T> gradient(const LoopFamily<T>& family, const LoopPoint<T>& point) {
  return gradient_of(family, point.terms, point.P, point.S);
}

template <class T>
Matrix<T> orbit_tangents(const LoopFamily<T>& family, const Matrix<T>& Theta) {
  const Index order = family.order, nu = family.nu, ny = family.ny;
  Matrix<T> tangents(family.free_entries(), order * order);
  for (Index i = 0; i < order; ++i)
    for (Index j = 0; j < order; ++j) {
      Matrix<T> change = Matrix<T>::Zero(Theta.rows(), Theta.cols());
      change.row(nu + i) += Theta.row(nu + j);
      change.col(ny + j) -= Theta.col(ny + i);
      tangents.col(i * order + j) = packed<T>(family, change);
    }
  return tangents;
}

#define LQG_ORDER_INSTANCES(T)                                                                                   \
  template LoopFamily<T> loop_family(const OrderProblem&, Index);                                                \
  template Matrix<T> packed(const LoopFamily<T>&, const Matrix<T>&);                                             \
  template Matrix<T> unpacked(const LoopFamily<T>&, const Matrix<T>&);                                           \
  template LoopTerms<T> terms_at(const LoopFamily<T>&, const Matrix<T>&);                                        \
  template Matrix<T> moments_added(const LoopFamily<T>&, const LoopTerms<T>&);                                   \
  template Matrix<T> duals_added(const LoopFamily<T>&, const LoopTerms<T>&);                                     \
  template T cost_of(const LoopFamily<T>&, const LoopTerms<T>&, const Matrix<T>&);                               \
  template Matrix<T> gradient_of(const LoopFamily<T>&, const LoopTerms<T>&, const Matrix<T>&, const Matrix<T>&); \
  template LoopPoint<T> point_at(const LoopFamily<T>&, const Matrix<T>&);                                        \
  template Matrix<T> gradient(const LoopFamily<T>&, const LoopPoint<T>&);                                        \
  template Matrix<T> orbit_tangents(const LoopFamily<T>&, const Matrix<T>&);

LQG_ORDER_INSTANCES(double)
LQG_ORDER_INSTANCES(Real)

#undef LQG_ORDER_INSTANCES

}  // namespace lqg::design::order
