// SPDX-License-Identifier: MIT
// The regulator under white parameters: W. L. De Koning, "Infinite horizon optimal control of linear discrete time
// systems with stochastic parameters", Automatica 18 (1982), 443–453.
#include <Eigen/QR>
#include <cmath>

#include "design/numeric/factor.hpp"
#include "design/order/order_search.hpp"
#include "design/order/refined_moments.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

using order::Matrix;

// A and B of each term: the means, then the white parameters.
template <class T>
struct PlantTerms {
  std::vector<Matrix<T>> A, B;

  std::vector<Matrix<T>> closed(const Matrix<T>& K) const {
    std::vector<Matrix<T>> result;
    for (std::size_t t = 0; t < A.size(); ++t) result.push_back(A[t] - B[t] * K);
    return result;
  }
  // Σ BᵀXB and Σ BᵀXA
  Matrix<T> on_inputs(const Matrix<T>& X) const {
    Matrix<T> sum = Matrix<T>::Zero(B.front().cols(), B.front().cols());
    for (const Matrix<T>& b : B) sum += b.transpose() * X * b;
    return (sum + sum.transpose()) / T(2);
  }
  Matrix<T> on_both(const Matrix<T>& X) const {
    Matrix<T> sum = Matrix<T>::Zero(B.front().cols(), A.front().cols());
    for (std::size_t t = 0; t < A.size(); ++t) sum += B[t].transpose() * X * A[t];
    return sum;
  }
};

PlantTerms<Real> plant_terms(const OrderProblem& problem) {
  PlantTerms<Real> terms{{problem.A}, {problem.B}};
  for (const WhiteParameter& white : problem.white) {
    terms.A.push_back(white.A);
    terms.B.push_back(white.B);
  }
  return terms;
}

PlantTerms<double> rounded_terms(const PlantTerms<Real>& terms) {
  PlantTerms<double> result;
  for (const RealMatrix& a : terms.A) result.A.push_back(to_doubles(a));
  for (const RealMatrix& b : terms.B) result.B.push_back(to_doubles(b));
  return result;
}

struct LeastGrowth {
  double growth = 0;
  Matrix<double> K;
};

// The least spectral radius ρ of the second moments' map over all K, or the first K with ρ < 1. R. A. Howard's policy
// iteration: X of the moments discounted by g just below 1/ρ is nearly the eigenmatrix of the dual map, whose growth
// K = (Σ BᵀXB)⁻¹ Σ BᵀXA makes least.
LeastGrowth least_growth(const PlantTerms<double>& terms) {
  const Index nx = terms.A.front().rows();
  const int most_steps = 200;
  LeastGrowth best;
  Matrix<double> K = Matrix<double>::Zero(terms.B.front().cols(), nx);
  double margin = 0.3;
  for (int step = 0; step < most_steps && margin > 1e-9; ++step) {
    const double growth = order::growth_of(terms.closed(K), false);
    const bool is_less = step == 0 || growth < best.growth * (1 - 1e-3 * margin);
    if (step == 0 || growth < best.growth) best = {growth, K};
    if (best.growth < 1) return best;
    if (!is_less) {
      margin /= 4;
      K = best.K;
    }
    std::vector<Matrix<double>> discounted = terms.closed(K);
    for (Matrix<double>& Phi : discounted) Phi *= std::sqrt((1 - margin) / best.growth);
    const Matrix<double> X = order::MomentMap<double>(discounted, false).solve_dual(Matrix<double>::Identity(nx, nx));
    K = terms.on_inputs(X).completeOrthogonalDecomposition().solve(terms.on_both(X));
  }
  return best;
}

// One of Newton's steps: the X that u = −Kx costs.
std::optional<RealMatrix> cost_matrix(const OrderProblem& problem, const PlantTerms<Real>& terms, const RealMatrix& K,
                                      const RealMatrix& near) {
  const RiccatiEquation weights{problem.A, problem.B, problem.Q, problem.R, problem.N};
  const order::MomentMap<double> rough(rounded_terms(terms).closed(to_doubles(K)), false);
  return order::refined_moments(rough, terms.closed(K), false, order::Side::duals, step_cost(weights, K), near);
}

// Quadratic from a stabilising K on, one linear equation a step; every K on the way stabilises.
WhiteRegulator newton(const OrderProblem& problem, const PlantTerms<Real>& terms, RealMatrix K) {
  const int most_steps = 200;
  WhiteRegulator result;
  RealMatrix X;
  Real before = 1;
  for (int step = 0; step < most_steps; ++step) {
    const std::optional<RealMatrix> next = cost_matrix(problem, terms, K, X);
    if (!next) return result;
    const RealMatrix weight = problem.R + terms.on_inputs(*next);
    if (!positive_definite(weight)) return result;
    K = *solve(weight, terms.on_both(*next) + problem.N.transpose());
    const Real change =
        X.size() > 0 ? Real(largest_entry(*next - X) / (largest_entry(*next) + negligible(1))) : Real(1);
    X = *next;
    if (change < negligible(0.45) || (change < negligible(0.3) && change > before / 2)) {
      result.exists = true;
      result.X = X;
      result.K = K;
      return result;
    }
    before = change;
  }
  return result;
}

}  // namespace

WhiteRegulator white_regulator(const OrderProblem& problem) {
  const PlantTerms<Real> terms = plant_terms(problem);
  const LeastGrowth least = least_growth(rounded_terms(terms));
  WhiteRegulator result;
  if (least.growth < 1) result = newton(problem, terms, real(least.K));
  result.growth = least.growth;
  return result;
}

}  // namespace lqg::design
