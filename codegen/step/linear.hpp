// SPDX-License-Identifier: MIT
// A controller that is one linear system in numbers z of its own: what it does in a sample, for any scalar.
//
// Each function is written for outputs that may be anything. `control_expected` is the short way, for a sample in which
// all is finite; its condition says whether that was so, and where it was, both ways give the same bits.
#pragma once

#include "step/bounds_check.hpp"
#include "step/model.hpp"

namespace lqg::step {

template <class S>
struct LinearModel {
  bool predictor_form = false;  // u needs no y: D has no columns
  Matrix<S> A, B;               // z⁺ = A z + B y
  Matrix<S> C, D;               // u = C z + D y
  Matrix<S> expected;           // what the outputs should be: `expected` z
  Matrix<S> estimate, heard;    // x̂ = `estimate` z + `heard` y; in predictor form `heard` has no columns
  Matrix<S> of_state, keep;     // z of a state x: `of_state` x + `keep` z; keep may have no columns
  Vector<S> z0;
  OperatingPoint<S> point;  // of x, u and y, which are deviations
};

template <class S>
struct LinearState {
  Vector<S> z;
  Vector<S> y;  // filter form: the outputs that control has heard, for advance; else empty
};

template <class S>
LinearState<S> initial_state(const LinearModel<S>& model) {
  return {model.z0, Vector<S>(Vector<S>::Constant(model.predictor_form ? 0 : model.B.cols(), S(0)))};
}

constexpr const char* sum_of_z = ";  sum_to_z_k = Σ z_i, i ≤ k, is finite where each z_i is";

// sum + row i of M times v
template <class S>
S add_product(S sum, const Matrix<S>& M, int i, const Vector<S>& v) {
  for (int j = 0; j < M.cols(); ++j) sum = multiply_add(S(M(i, j)), S(v(j)), sum);
  return sum;
}

// y, what is expected where it is not finite: an output that is left out counts as one that came as expected.
template <class S, class Listener>
Vector<S> heard_outputs(const LinearModel<S>& model, const LinearState<S>& state, const Vector<S>& y,
                        Listener& listener) {
  Vector<S> heard(y.size());
  for (int i = 0; i < y.size(); ++i) {
    listener.section("y, or what is expected where it is not finite", i);
    auto usable = listener.accept(is_finite(S(y(i))), i);
    heard(i) = select(usable, S(y(i)), add_product(S(0), model.expected, i, state.z));
    listener.name(heard(i), "heard");
  }
  return heard;
}

// u = C z + D y, 0 where it is not finite.
template <class S, class Listener>
Vector<S> act_on(const LinearModel<S>& model, const LinearState<S>& state, const Vector<S>& y, Listener& listener) {
  listener.section(std::string(model.D.cols() ? "u = C z + D y" : "u = C z") + ", 0 where it is not finite");
  Vector<S> u(model.C.rows());
  for (int i = 0; i < u.size(); ++i) {
    const S sum = add_product(add_product(S(0), model.C, i, state.z), model.D, i, y);
    listener.name(sum, "law", of_input(i));
    auto finite = is_finite(sum);
    listener.name(finite, "finite", of_input(i));
    listener.raise(Event::input_limited, negation(finite));
    u(i) = select(finite, sum, S(0));
    listener.name(u(i), "u", of_input(i));
  }
  return u;
}

// Filter form: u of this sample's y, which is kept for advance. Predictor form: without a y.
template <class S, class Listener>
Vector<S> control(const LinearModel<S>& model, LinearState<S>& state, const Vector<S>& y, Listener& listener) {
  if (!model.predictor_form) state.y = heard_outputs(model, state, y, listener);
  return act_on(model, state, state.y, listener);
}

// The same where everything is finite, which the condition tells: no selects, and one comparison for all. An output
// that no u shows is asked for by itself.
template <class S, class Listener>
auto control_expected(const LinearModel<S>& model, LinearState<S>& state, const Vector<S>& y, Vector<S>& u,
                      Listener& listener) {
  listener.section(model.D.cols() ? "u = C z + D y" : "u = C z");
  BoundsCheck<S> bounds;
  u.resize(model.C.rows());
  for (int i = 0; i < u.size(); ++i) {
    u(i) = add_product(add_product(S(0), model.C, i, state.z), model.D, i, y);
    listener.name(u(i), "law", of_input(i));
    bounds.add(S(u(i)), of_input(i, "u"), listener);
  }
  for (int j = 0; j < model.D.cols(); ++j) {
    bool shown = false;
    for (int i = 0; i < u.size(); ++i) shown = shown || !is_zero(S(model.D(i, j)));
    if (!shown) bounds.add(S(y(j)), of_output(j, "y"), listener);
  }
  if (!model.predictor_form) state.y = y;
  return bounds.is_within();
}

// z ← A z + B y with outputs that are finite; the condition says that z is.
template <class S, class Listener>
auto advance(const LinearModel<S>& model, LinearState<S>& state, const Vector<S>& y, BoundsCheck<S>& bounds,
             Listener& listener) {
  listener.section("z ← A z + B y", -1, sum_of_z);
  Vector<S> next(state.z.size());
  for (int i = 0; i < next.size(); ++i) {
    next(i) = add_product(add_product(S(0), model.A, i, state.z), model.B, i, y);
    listener.name(next(i), "next_z", of_entry(i));
    bounds.add(S(next(i)), of_entry(i, -1, "z"), listener);
  }
  state.z = next;
  return bounds.is_within();
}
template <class S, class Listener>
auto advance(const LinearModel<S>& model, LinearState<S>& state, const Vector<S>& y, Listener& listener) {
  BoundsCheck<S> bounds;
  return advance(model, state, y, bounds, listener);
}

// Both as one, where everything is finite, which the condition tells: it holds only where those of both would.
template <class S, class Listener>
auto sample_expected(const LinearModel<S>& model, LinearState<S>& state, const Vector<S>& y, Vector<S>& u,
                     Listener& listener) {
  listener.section(model.D.cols() ? "u = C z + D y" : "u = C z", -1,
                   ";  sum_to_u_k = Σ u_i, i ≤ k, is finite where each u_i is");
  BoundsCheck<S> bounds;
  u.resize(model.C.rows());
  for (int i = 0; i < u.size(); ++i) {
    u(i) = add_product(add_product(S(0), model.C, i, state.z), model.D, i, y);
    listener.name(u(i), "law", of_input(i));
    bounds.add(S(u(i)), of_input(i, "u"), listener);
  }
  for (int j = 0; j < y.size(); ++j) {
    bool shown = false;
    for (int i = 0; i < model.D.rows() && j < model.D.cols(); ++i) shown = shown || !is_zero(S(model.D(i, j)));
    for (int i = 0; i < model.B.rows(); ++i) shown = shown || !is_zero(S(model.B(i, j)));
    if (!shown) bounds.add(S(y(j)), of_output(j, "y"), listener);
  }
  if (!model.predictor_form) state.y = y;
  return advance(model, state, y, bounds, listener);
}

// x̂, the one that u is made of; in filter form of the y that control has heard.
template <class S, class Listener>
Vector<S> estimate(const LinearModel<S>& model, const LinearState<S>& state, Listener& listener) {
  listener.section(model.predictor_form ? "x̂ of z" : "x̂ of z and y");
  Vector<S> x(model.estimate.rows());
  for (int i = 0; i < x.size(); ++i) {
    x(i) = add_product(add_product(S(0), model.estimate, i, state.z), model.heard, i, state.y);
    listener.name(x(i), "x", of_state(i));
  }
  return x;
}

// z of a state that is set by hand; the condition says that it is finite.
template <class S, class Listener>
auto set_state(const LinearModel<S>& model, LinearState<S>& state, const Vector<S>& x, Listener& listener) {
  listener.section("z of x", -1, sum_of_z);
  BoundsCheck<S> bounds;
  Vector<S> next(state.z.size());
  for (int i = 0; i < next.size(); ++i) {
    next(i) = add_product(add_product(S(0), model.of_state, i, x), model.keep, i, state.z);
    listener.name(next(i), "next_z", of_entry(i));
    bounds.add(S(next(i)), of_entry(i, -1, "z"), listener);
  }
  state.z = next;
  return bounds.is_within();
}

}  // namespace lqg::step
