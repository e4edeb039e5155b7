// SPDX-License-Identifier: MIT
// The control law.
#pragma once

#include <type_traits>

#include "step/mpc.hpp"
#include "step/operating_point.hpp"

namespace lqg::step {

// r as a deviation from the operating point, 0 where it is not finite.
template <class S, class Listener>
Vector<S> reference(const Model<S>& model, const State<S>& state, Listener& listener) {
  if (model.nr) listener.section("the references r, 0 for one that is not finite");
  Vector<S> r(model.nr);
  for (int j = 0; j < model.nr; ++j) {
    const S given = deviation_of(model.point.r, j, S(state.r(j)));
    if (!is_at_zero(model.point.r, j)) listener.name(given, "deviation", of_reference(j, "r"));
    auto finite = is_finite(given);
    listener.hint(finite, "finite_r", of_reference(j));
    listener.raise(Event::reference_not_finite, negation(finite));
    r(j) = select(finite, given, S(0));
    listener.name(r(j), "reference", of_reference(j));
  }
  return r;
}

// −K [x̂; ξ; u[k−1]] + Nbar r, on top of u[k−1] where the law gives its change.
template <class S>
S law(const Model<S>& model, const State<S>& state, const Vector<S>& r, int i) {
  const int nxi = static_cast<int>(model.integral.size());
  S sum = model.law_begun.size() ? S(model.law_begun(i)) : model.gives_change ? S(state.u(i)) : S(0);
  for (int j = 0; j < model.nx; ++j) sum = multiply_subtract(S(model.K(i, j)), S(state.x(j)), sum);
  for (int j = 0; j < nxi; ++j) sum = multiply_subtract(S(model.K(i, model.nx + j)), S(state.xi(j)), sum);
  for (int j = 0; j < model.nu && model.gives_change; ++j)
    sum = multiply_subtract(S(model.K(i, model.nx + nxi + j)), S(state.u(j)), sum);
  for (int j = 0; j < model.Nbar.cols(); ++j) sum = multiply_add(S(model.Nbar(i, j)), S(r(j)), sum);
  return sum;
}

// The nearest number to `value` within [low, high], of input i.
template <class S, class Listener>
S within(const S& low, const S& value, const S& high, const char* below, const char* above, int i, Listener& listener) {
  auto is_low = is_less(value, low);
  auto is_high = is_less(high, value);
  listener.hint(is_low, below, of_input(i));
  listener.hint(is_high, above, of_input(i));
  listener.raise(Event::input_limited, either(is_low, is_high));
  return select(is_low, low, select(is_high, high, value));
}

template <class S>
std::string equation_of_law(const Model<S>& model) {
  if (model.equations)
    return std::string("u = (u + K x of the operating point) − K x̂") +
           (model.u_min.size() || model.u_step.size() ? ", within its limits" : "");
  return std::string(model.gives_change       ? "u = u[k−1] − K [x̂"
                     : model.integral.empty() ? "u = −K x̂"
                                              : "u = −K [x̂") +
         (model.integral.empty() ? "" : "; ξ") + (model.gives_change ? "; u[k−1]" : "") +
         (model.gives_change || !model.integral.empty() ? "]" : "") + (model.Nbar.cols() ? " + Nbar r" : "") +
         (model.u_min.size() || model.u_step.size() ? ", within its limits" : "");
}

// u by the law, finite, within its limits: no further from the last one than u_step, and above all in [u_min, u_max].
template <class S, class Listener>
Vector<S> clipped_law(const Model<S>& model, State<S>& state, const Vector<S>& r, Listener& listener) {
  listener.section(equation_of_law(model));
  Vector<S> u(model.nu);
  for (int i = 0; i < model.nu; ++i) {
    S sum = law(model, state, r, i);
    listener.name(sum, "law", of_input(i));
    auto finite = model.has_finite_law ? is_less(S(0), S(1)) : is_finite(sum);
    listener.name(finite, "finite", of_input(i));
    listener.raise(Event::input_limited, negation(finite));
    S value = select(finite, sum, S(0));
    listener.name(value, "demand", of_input(i));
    if (state.demand.size()) state.demand(i) = value;
    if (model.u_step.size()) {
      const S last = state.u(i), highest = last + model.u_step(i), lowest = last - model.u_step(i);
      listener.hint(lowest, "lowest", of_input(i));
      listener.hint(highest, "highest", of_input(i));
      value = within(lowest, value, highest, "below_lowest", "above_highest", i, listener);
      listener.name(value, "reached", of_input(i));
    }
    if (model.u_min.size()) {
      value = within(S(model.u_min(i)), value, S(model.u_max(i)), "below", "above", i, listener);
      listener.name(value, "limited", of_input(i));
    }
    u(i) = value;
  }
  return u;
}

// [x̂; u[k−1] where the law gives its change; r]: what limits are foreseen of.
template <class S>
Vector<S> foreseen_state(const Model<S>& model, const State<S>& state, const Vector<S>& r) {
  const Eigen::Index last = model.gives_change ? model.nu : 0;
  Vector<S> s(model.nx + last + r.size());
  s << state.x, state.u.head(last), r;
  return s;
}

// The u of least cost that keeps the limits that are foreseen, of the law's u.
template <class S, class Listener>
Vector<S> limited_law(const Model<S>& model, const State<S>& state, const Vector<S>& r, const Vector<S>& law,
                      Listener& listener) {
  const Vector<S> last = model.foreseen.u_step.size() ? Vector<S>(state.u) : Vector<S>();
  const LimitedInput<S> found = limited_input(model.foreseen, last, foreseen_state(model, state, r), law);
  listener.raise(Event::not_optimal, !found.is_optimal);
  listener.raise(Event::input_limited, found.is_limited);
  return found.u;
}

// The law with its limits. Those that are foreseen are for numbers: a symbol cannot say how often it loops.
template <class S, class Listener>
Vector<S> control(const Model<S>& model, State<S>& state, Listener& listener) {
  const Vector<S> r = reference(model, state, listener);
  Vector<S> u = clipped_law(model, state, r, listener);
  if constexpr (std::is_same_v<decltype(is_less(S(), S())), bool>)
    if (model.foreseen.G.rows() > 0) u = limited_law(model, state, r, u, listener);
  if (has_feedthrough(model)) state.u = u;
  return u;
}

// A law without a memory.
template <class S, class Listener>
Vector<S> control(const Model<S>& model, const Vector<S>& x, Listener& listener) {
  State<S> state;
  state.x = x;
  return control(model, state, listener);
}

}  // namespace lqg::step
