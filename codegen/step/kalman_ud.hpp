// SPDX-License-Identifier: MIT
// The Kalman filter with P = U diag(D) Uᵀ, U unit upper triangular: Bierman's update, Thornton's prediction.
//
// D stays positive because it is only ever multiplied and divided by positive numbers or a sum of squares.
#pragma once

#include "step/online.hpp"

namespace lqg::step {

// S = V + Σ f (D f), rounded like the α that ends as S.
template <class S>
S variance_ud(const Model<S>& model, const State<S>& state, const Vector<S>& f, int i) {
  S variance = model.V(i);
  for (int j = 0; j < model.nx; ++j) variance = multiply_add(S(f(j)), S(state.D[j] * f(j)), variance);
  return variance;
}

// Bierman: column by column α_j = α_{j−1} + f_j g_j, f = Uᵀ Cᵀ, g = D f, α_{−1} = V; S = α at the end.
// The reciprocal of α is carried along, so that one division a column is enough; f = 0 changes nothing, to the bit.
template <class S, class Listener>
auto update_ud_output(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  const int nx = model.nx;
  listener.section("f = Uᵀ Cᵀ", i);
  Vector<S> f(nx), g(nx), b(nx);
  for (int j = 0; j < nx; ++j) {
    S sum = model.C(i, j);
    for (int k = 0; k < j; ++k) sum = multiply_add(S(state.U[strict_triangle(k, j)]), S(model.C(i, k)), sum);
    f(j) = sum;
    if (!is_zero(model.gate)) listener.name(f(j), "projected", of_entry(j));
  }
  listener.section(std::string(equation_of_innovation(model)) + ", 0 if it is not used", i);
  S innovation = residual(model, state, y, i);
  listener.name(innovation, "raw_innovation");
  // S is V at least, and asked for only where that is not enough.
  const auto variance = [&] { return variance_ud(model, state, f, i); };
  auto usable = weigh(model, state, innovation, S(model.V(i)), variance, i, listener);
  innovation = select(usable, innovation, S(0));
  listener.name(innovation, "innovation");

  listener.section("f, 0 leaves the output out;  g = d f", i);
  for (int j = 0; j < nx; ++j) {
    f(j) = select(usable, S(f(j)), S(0));
    listener.name(f(j), "f", of_entry(j));
    g(j) = state.D[j] * f(j);
    listener.name(g(j), "g", of_entry(j));
  }

  listener.section("α ← α + f g from α = V to S;  d ← d α₋₁/α,  U ← U − λ bᵀ,  λ = f/α₋₁,  b = U g", i);
  S alpha = model.V(i);
  S reciprocal = S(1) / alpha;
  for (int j = 0; j < nx; ++j) {
    S next = multiply_add(f(j), g(j), alpha);
    listener.name(next, "alpha", of_entry(j));
    S ratio = alpha / next;
    listener.name(ratio, "ratio", of_entry(j));
    state.D[j] = state.D[j] * ratio;
    listener.name(state.D[j], "d", of_entry(j));
    S lambda = f(j) * reciprocal;
    listener.name(lambda, "lambda", of_entry(j));
    for (int k = 0; k < j; ++k) {
      S& entry = state.U[strict_triangle(k, j)];
      const S before = entry;
      entry = multiply_subtract(lambda, S(b(k)), before);
      listener.name(entry, "U", of_entry(k, j));
      b(k) = multiply_add(g(j), before, S(b(k)));
      listener.name(b(k), "b", of_entry(k, j));
    }
    b(j) = g(j);
    reciprocal = reciprocal * ratio;
    listener.name(reciprocal, "reciprocal_alpha", of_entry(j));
    alpha = next;
  }

  listener.section("L = b / S,  x̂ ← x̂ + L innovation", i);
  for (int j = 0; j < nx; ++j) {
    S gain = b(j) * reciprocal;
    listener.name(gain, "gain", of_state(j));
    state.x(j) = multiply_add(gain, innovation, S(state.x(j)));
    listener.name(state.x(j), "x", of_state(j));
  }
  return usable;
}

// [A U | G], the rows that Thornton makes orthogonal under the weights [d | w].
template <class S, class Listener>
Matrix<S> rows_of_the_prior(const Model<S>& model, const State<S>& state, Listener& listener) {
  const int nx = model.nx, nq = static_cast<int>(model.G.cols());
  listener.section(
      "rows [A U | G] with the weights [d | w];  squares_to_d_k adds d_k, and sum_to_U_jk is finite where each U is");
  Matrix<S> T(nx, nx + nq);
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < nx; ++j) {
      S sum = model.A_free(i, j);
      for (int k = 0; k < j; ++k) sum = multiply_add(S(model.A_free(i, k)), S(state.U[strict_triangle(k, j)]), sum);
      listener.name(sum, "AU", of_entry(i, j));
      T(i, j) = sum;
    }
    for (int q = 0; q < nq; ++q) T(i, nx + q) = model.G(i, q);
  }
  return T;
}

// Thornton: modified weighted Gram–Schmidt from the last row up; P ← A P Aᵀ + G diag(w) Gᵀ.
template <class S, class Listener>
void predict_ud_covariance(const Model<S>& model, State<S>& state, BoundsCheck<S>& bounds, Listener& listener) {
  const int nx = model.nx, nt = nx + static_cast<int>(model.G.cols());
  Matrix<S> T = rows_of_the_prior(model, state, listener);
  std::vector<S> weight = state.D;
  for (int q = nx; q < nt; ++q) weight.push_back(model.w(q - nx));
  Vector<S> v(nt);
  for (int i = nx - 1; i >= 0; --i) {
    listener.section("row " + std::to_string(i) +
                     ": d = Σ weight row²;  each row j above it: U = Σ weight row row_j / d,  row_j ← row_j − U row");
    for (int k = 0; k < nt; ++k) {
      v(k) = weight[k] * T(i, k);
      listener.name(v(k), k < nx ? "dAU" : "wG", of_entry(i, k < nx ? k : k - nx));
    }
    S diagonal = T(i, 0) * v(0);
    for (int k = 1; k < nt; ++k) diagonal = multiply_add(S(T(i, k)), S(v(k)), diagonal);
    listener.name(diagonal, "prior_d", of_entry(i));
    state.D[i] = diagonal;
    bounds.add_variance(diagonal, model.x_bound, of_entry(i, -1, "d"), listener);
    S reciprocal = S(1) / diagonal;  // not finite when the variance of a state has died out: nothing depends on it then
    listener.name(reciprocal, "raw_reciprocal_d", of_entry(i));
    reciprocal = select(is_finite(reciprocal), reciprocal, S(0));
    listener.name(reciprocal, "reciprocal_d", of_entry(i));
    for (int j = 0; j < i; ++j) {
      S sum = T(j, 0) * v(0);
      for (int k = 1; k < nt; ++k) sum = multiply_add(S(T(j, k)), S(v(k)), sum);
      S entry = sum * reciprocal;
      listener.name(entry, "prior_U", of_entry(j, i));
      state.U[strict_triangle(j, i)] = entry;
      bounds.add(entry, of_entry(j, i, "U"), listener);
      for (int k = 0; k < nt; ++k) {
        T(j, k) = multiply_subtract(entry, S(T(i, k)), S(T(j, k)));
        listener.name(T(j, k), k < nx ? "AU" : "G", of_entry_without(i, j, k < nx ? k : k - nx));
      }
    }
  }
}

template <class S, class Listener>
auto predict_ud(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  BoundsCheck<S> bounds;
  predict_state(model, state, u, bounds, listener);
  predict_ud_covariance(model, state, bounds, listener);
  return bounds.is_within();
}

}  // namespace lqg::step
