// The parts that every filter shares: innovation and prediction of the state.
#pragma once

#include "step/servo.hpp"

namespace lqg::step {

// y_i − C_i x − D_i u
template <class S>
S residual(const Model<S>& model, const State<S>& state, const S& y, int i) {
  S nu = y;
  for (int j = 0; j < model.nx; ++j) nu = multiply_subtract(S(model.C(i, j)), S(state.x(j)), nu);
  for (int j = 0; j < model.D.cols(); ++j) nu = multiply_subtract(S(model.D(i, j)), S(state.u(j)), nu);
  return nu;
}

// How wide the gate is in the next sample. It opens for an output that is left out again and again: then x̂ is wrong, not
// the sensor. With a constant gain it opens, too, while nothing usable comes: P, which is not carried, would grow. Whatever
// was in it, it is from 1 to the widest.
template <class S, class Condition, class Listener>
void move_gate(const Model<S>& model, State<S>& state, const Condition& passed, const Condition& gated, int i,
               Listener& listener) {
  const S unheard = model.filter == Filter::steady ? S(model.gate_widen(i)) : select(gated, S(model.gate_widen(i)), S(1));
  const S factor = select(passed, S(model.gate_narrow(i)), unheard);
  const S next = factor * state.widening(i), widest = PowerOfTwo<S>::of(widest_gate_exponent);
  listener.name(next, "width");
  const S least = select(is_less(S(1), next), next, S(1));
  listener.name(least, "wide");
  state.widening(i) = select(is_less(least, widest), least, widest);
  listener.name(state.widening(i), "widening");
}

// Of a usable output: whether ν² ≤ gate² s w too, w how wide the gate is. ν is 0 for one that is not usable.
template <class S, class Condition, class Listener>
Condition pass_gate(const Model<S>& model, State<S>& state, const S& nu, const S& variance, const Condition& usable, int i,
                    Listener& listener) {
  if (is_zero(model.gate)) return usable;
  const S square = nu * nu;
  auto beyond = is_less(S(S(S(model.gate * model.gate) * variance) * state.widening(i)), square);
  auto gated = both(usable, beyond);
  listener.name(gated, "gated");
  listener.gate(gated, i);
  auto passed = both(usable, negation(beyond));
  listener.name(passed, "passed");
  move_gate(model, state, passed, gated, i, listener);
  return passed;
}

// x ← A x + B u + M innovation;  innovation ← 0; what the regulator has to remember of u and of this sample
template <class S, class Listener>
void predict_state(const Model<S>& model, State<S>& state, const Vector<S>& u, BoundsCheck<S>& bounds, Listener& listener) {
  listener.section(model.M.cols() ? "x̂ ← A x̂ + B u + M (what the outputs told of w)"
                   : model.nu     ? "x̂ ← A x̂ + B u"
                                  : "x̂ ← A x̂");
  Vector<S> next(model.nx);
  for (int i = 0; i < model.nx; ++i) {
    S sum = model.A(i, 0) * state.x(0);
    for (int j = 1; j < model.nx; ++j) sum = multiply_add(S(model.A(i, j)), S(state.x(j)), sum);
    for (int j = 0; j < model.nu; ++j) sum = multiply_add(S(model.B(i, j)), S(u(j)), sum);
    for (int j = 0; j < model.M.cols(); ++j) sum = multiply_add(S(model.M(i, j)), S(state.innovation(j)), sum);
    listener.name(sum, "next", i);
    next(i) = sum;
    bounds.add(sum, model.x_bound, i, listener);
  }
  state.x = next;
  for (int j = 0; j < model.M.cols(); ++j) state.innovation(j) = S(0);
  remember(model, state, u, bounds, listener);
}

}  // namespace lqg::step
