// SPDX-License-Identifier: MIT
// The memory of a control law: integrals of r − y, kept true to the input that was applied.
#pragma once

#include "step/bounds_check.hpp"
#include "step/lqr.hpp"

namespace lqg::step {

// r − y of an output if it is integrated, y a deviation from the operating point, for predict; 0, which leaves its ξ
// alone, where the output was not used or r − y is not believable.
template <class S, class Condition, class Listener>
void observe_alone(const Model<S>& model, State<S>& state, const S& y, const Condition& used, int output,
                   Listener& listener) {
  for (std::size_t i = 0; i < model.integral.size(); ++i) {
    if (model.integral[i] != output) continue;
    listener.section("r − y, which predict adds to ξ; 0 if the output is not used, or it is not believable", output);
    S error = deviation_of(model.point.r, model.wanted[i], S(state.r(model.wanted[i]))) - y;
    listener.name(error, "raw_error");
    error = select(both(used, is_believable(model.error_limit, static_cast<int>(i), error)), error, S(0));
    listener.name(error, "error");
    state.error(static_cast<Eigen::Index>(i)) = error;
  }
}

template <class S, class Condition, class Listener>
void observe(const Model<S>& model, State<S>& state, const Vector<S>& y, const std::vector<Condition>& used,
             Listener& listener) {
  for (const int output : model.integral)
    observe_alone(model, state, S(y(output)), used[static_cast<std::size_t>(output)], output, listener);
}

// ξ + H (u − v)
template <class S>
S corrected(const Matrix<S>& H, const Vector<S>& xi, const Vector<S>& u, const Vector<S>& v, int i) {
  S sum = xi(i);
  for (int j = 0; j < H.cols(); ++j) sum = multiply_add(S(H(i, j)), S(u(j) - v(j)), sum);
  return sum;
}

// Adds ξ and the input that is kept.
template <class S, class Listener>
void check_memory(const Model<S>& model, const State<S>& state, BoundsCheck<S>& bounds, Listener& listener) {
  for (int i = 0; i < state.xi.size(); ++i) bounds.add(S(state.xi(i)), model.xi_bound, of_integral(i, "xi"), listener);
  for (int i = 0; i < model.nu && continues(model); ++i) bounds.add(S(state.u(i)), of_input(i, "u"), listener);
}

// ξ ← ξ + H (u − what the law asked for) + T (r − y) with the u that was applied; that u is kept where it is needed.
template <class S, class Listener>
void remember(const Model<S>& model, State<S>& state, const Vector<S>& u, BoundsCheck<S>& bounds, Listener& listener) {
  if (!model.integral.empty()) listener.section("ξ ← ξ + H (u − what the law asked for) + T (r − y)");
  const int nxi = static_cast<int>(model.integral.size());
  for (int i = 0; i < nxi; ++i) {
    state.xi(i) = multiply_add(model.T, S(state.error(i)), corrected(model.H, state.xi, u, state.demand, i));
    listener.name(state.xi(i), "next_xi", of_integral(i));
    state.error(i) = S(0);
  }
  if (nxi) state.demand = u;
  if (state.u.size()) state.u = u;
  check_memory(model, state, bounds, listener);
}

// A regulator alone: u of the state x that is given, and what it has to remember, for an actuator that applies u.
// The condition says that the memory is within its bounds.
template <class S, class Listener>
auto act(const Model<S>& model, State<S>& state, Vector<S>& u, Listener& listener) {
  u = control(model, state, listener);
  Vector<S> y(model.integral.empty() ? 0 : model.C.rows());
  listener.section(model.D.cols() ? "y = C x + D u of the integrated outputs" : "y = C x of the integrated outputs");
  for (const int i : model.integral) {
    S sum = S(0);
    for (int j = 0; j < model.nx; ++j) sum = multiply_add(S(model.C(i, j)), S(state.x(j)), sum);
    for (int j = 0; j < model.D.cols(); ++j) sum = multiply_add(S(model.D(i, j)), S(u(j)), sum);
    y(i) = sum;
    listener.name(y(i), "y", of_output(i));
  }
  const auto always = is_less(S(0), S(1));
  observe(model, state, y, std::vector<decltype(is_less(S(), S()))>(static_cast<std::size_t>(y.size()), always),
          listener);
  BoundsCheck<S> bounds;
  remember(model, state, u, bounds, listener);
  return bounds.is_within();
}

// The input was set to u by hand: it is the last one and those on their way, and ξ becomes such that the law continues
// there. The condition says that all of this is within its bounds.
template <class S, class Listener>
auto set_input(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  const int nxi = static_cast<int>(model.integral.size());
  BoundsCheck<S> bounds;
  if (model.delayed) listener.section("the inputs on their way", -1, and_check(model.x_bound));
  for (int i = 0; i < model.delayed; ++i) {
    const int at = model.nx - model.delayed + i;
    state.x(at) = u(i % model.nu);
    if (!model.x_bound.empty()) bounds.add(S(state.x(at)), model.x_bound, of_state(at, "x"), listener);
  }
  if (state.u.size()) state.u = u;
  if (nxi) {
    const Vector<S> r = reference(model, state, listener);
    listener.section("ξ ← ξ + H_input (u − what the law asks for): it asks for u next");
    Vector<S> v(model.nu), xi(nxi);
    for (int i = 0; i < model.nu; ++i) {
      v(i) = law(model, state, r, i);
      listener.name(v(i), "law", of_input(i));
    }
    for (int i = 0; i < nxi; ++i) {
      xi(i) = corrected(model.H_input, state.xi, u, v, i);
      listener.name(xi(i), "next_xi", of_integral(i));
      bounds.add(S(xi(i)), model.xi_bound, of_integral(i, "xi"), listener);
    }
    state.xi = xi;
    state.demand = u;
  }
  for (int i = 0; i < model.nu; ++i) bounds.add(S(u(i)), of_input(i, "u"), listener);
  return bounds.is_within();
}

}  // namespace lqg::step
