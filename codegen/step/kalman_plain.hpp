// SPDX-License-Identifier: MIT
// The Kalman filter with its covariance P carried as a lower triangle; outputs one after the other.
#pragma once

#include "step/online.hpp"

namespace lqg::step {

// cov(x̂, y_i) = P C_iᵀ
template <class S, class Listener>
Vector<S> covariance_with_output(const Model<S>& model, const State<S>& state, int i, Listener& listener) {
  listener.section("cov(x̂, y) = P Cᵀ,  S = C P Cᵀ + V", i);
  Vector<S> f(model.nx);
  for (int j = 0; j < model.nx; ++j) {
    S sum = state.P[triangle(j, 0)] * model.C(i, 0);
    for (int k = 1; k < model.nx; ++k) sum = multiply_add(S(state.P[triangle(j, k)]), S(model.C(i, k)), sum);
    listener.name(sum, "cov", of_state(j));
    f(j) = sum;
  }
  return f;
}

// 1/S and the innovation, 0 where output i is left out.
template <class S>
struct PlainCorrection {
  using Condition = decltype(is_less(S(), S()));
  Condition usable;
  S reciprocal, innovation;
};

template <class S, class Listener>
PlainCorrection<S> plain_correction(const Model<S>& model, State<S>& state, const Vector<S>& f, const S& y, int i,
                                    Listener& listener) {
  S variance = model.V(i);
  for (int k = 0; k < model.nx; ++k) variance = multiply_add(S(model.C(i, k)), S(f(k)), variance);
  listener.name(variance, "variance");

  listener.section(std::string(equation_of_innovation(model)) + "; a gain of 0 leaves the output out", i);
  S innovation = residual(model, state, y, i);
  listener.name(innovation, "raw_innovation");
  auto usable = weigh(model, state, innovation, variance, [&] { return variance; }, i, listener);
  S reciprocal = select(usable, S(1) / variance, S(0));
  listener.name(reciprocal, "reciprocal");
  innovation = select(usable, innovation, S(0));
  listener.name(innovation, "innovation");
  return {usable, reciprocal, innovation};
}

// L_j = cov(x̂_j, y)/S
template <class S, class Listener>
S plain_gain(const Vector<S>& f, const S& reciprocal, int j, Listener& listener) {
  S gain = f(j) * reciprocal;
  listener.name(gain, "gain", of_state(j));
  return gain;
}

template <class S, class Listener>
void correct_state(State<S>& state, const S& gain, const S& innovation, int j, Listener& listener) {
  state.x(j) = multiply_add(gain, innovation, S(state.x(j)));
  listener.name(state.x(j), "x", of_state(j));
}

// Row j of P ← P − L (P Cᵀ)ᵀ
template <class S, class Listener>
void correct_covariance_row(State<S>& state, const S& gain, const Vector<S>& f, int j, Listener& listener) {
  for (int l = j; l >= 0; --l) {
    S& entry = state.P[triangle(j, l)];
    entry = multiply_subtract(gain, S(f(l)), entry);
    listener.name(entry, "P", of_entry(j, l));
  }
}

// Both for state j, of an output with this cov(x̂, y), 1/S and innovation.
template <class S, class Listener>
void correct_plain_row(State<S>& state, const Vector<S>& f, const S& reciprocal, const S& innovation, int j,
                       Listener& listener) {
  const S gain = plain_gain(f, reciprocal, j, listener);
  correct_state(state, gain, innovation, j, listener);
  correct_covariance_row(state, gain, f, j, listener);
}

// S = C P Cᵀ + V, L = P Cᵀ / S, x̂ ← x̂ + L(y − C x̂ − D u), P ← P − L C P for output i; true if it was used.
template <class S, class Listener>
auto update_plain_output(const Model<S>& model, State<S>& state, const S& y, int i, Listener& listener) {
  const Vector<S> f = covariance_with_output(model, state, i, listener);
  const PlainCorrection<S> correction = plain_correction(model, state, f, y, i, listener);
  listener.section("L = P Cᵀ / S,  x̂ ← x̂ + L innovation,  P ← P − L (P Cᵀ)ᵀ", i);
  for (int j = model.nx - 1; j >= 0; --j)  // from the last row up: few P Cᵀ outlive the entry of P that they may be
    correct_plain_row(state, f, correction.reciprocal, correction.innovation, j, listener);
  return correction.usable;
}

// P ← A P Aᵀ + W, lower triangle, with A freed of what the outputs told of w.
template <class S, class Listener>
void predict_plain_covariance(const Model<S>& model, State<S>& state, BoundsCheck<S>& bounds, Listener& listener) {
  const int nx = model.nx;
  listener.section("P ← A P Aᵀ + G W Gᵀ, lower triangle;  squares_to_P_kk adds P_kk");
  std::vector<S> next(state.P.size());
  for (int i = 0; i < nx; ++i) {
    Vector<S> AP(nx);
    for (int j = 0; j < nx; ++j) {
      S sum = model.A_free(i, 0) * state.P[triangle(0, j)];
      for (int k = 1; k < nx; ++k) sum = multiply_add(S(model.A_free(i, k)), S(state.P[triangle(k, j)]), sum);
      listener.name(sum, "AP", of_entry(i, j));
      AP(j) = sum;
    }
    for (int j = 0; j <= i; ++j) {
      S sum = model.W(i, j);
      for (int k = 0; k < nx; ++k) sum = multiply_add(S(AP(k)), S(model.A_free(j, k)), sum);
      listener.name(sum, "prior_P", of_entry(i, j));
      next[triangle(i, j)] = sum;
      if (i == j) bounds.add_variance(sum, model.x_bound, of_entry(i, i, "P"), listener);  // |P_ij| ≤ √(P_ii P_jj)
    }
  }
  state.P = next;
}

// x̂ ← A x̂ + B u where P has been predicted before.
template <class S, class Listener>
auto predict_plain_state(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  BoundsCheck<S> bounds;
  predict_state(model, state, u, bounds, listener);
  listener.section("the variances P_kk;  squares_to_P_kk adds P_kk");
  for (int i = 0; i < model.nx; ++i)
    bounds.add_variance(S(state.P[triangle(i, i)]), model.x_bound, of_entry(i, i, "P"), listener);
  return bounds.is_within();
}

template <class S, class Listener>
auto predict_plain(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  BoundsCheck<S> bounds;
  predict_state(model, state, u, bounds, listener);
  predict_plain_covariance(model, state, bounds, listener);
  return bounds.is_within();
}

}  // namespace lqg::step
