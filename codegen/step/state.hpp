// SPDX-License-Identifier: MIT
// The parts that every filter shares: innovation and prediction of the state.
#pragma once

#include "step/servo.hpp"

namespace lqg::step {

// y_i − C_i x − D_i u; of linearised outputs y_i − C_i (x − where they were linearised)
template <class S>
S residual(const Model<S>& model, const State<S>& state, const S& y, int i) {
  S nu = y;
  if (model.linearised_at.size()) {
    for (int j = 0; j < model.nx; ++j)
      nu = multiply_subtract(S(model.C(i, j)), S(state.x(j) - model.linearised_at(j)), nu);
    return nu;
  }
  for (int j = 0; j < model.nx; ++j) nu = multiply_subtract(S(model.C(i, j)), S(state.x(j)), nu);
  for (int j = 0; j < model.D.cols(); ++j) nu = multiply_subtract(S(model.D(i, j)), S(state.u(j)), nu);
  return nu;
}

// How `residual` is written.
template <class S>
const char* equation_of_innovation(const Model<S>& model) {
  return model.linearised_at.size() ? "innovation = y − h − C (x̂ − the x̂ before all updates)"
         : model.D.cols()           ? "innovation = y − C x̂ − D u"
                                    : "innovation = y − C x̂";
}

// What is weighed of an output whose innovation is not as expected.
template <class S>
struct Weighing {
  Filter filter = Filter::none;
  S limit = S(0);   // |ν| below it is believable
  S square = S(0);  // gate²
  S widen = S(1), narrow = S(1);
};

template <class S>
Weighing<S> weighing_of(const Model<S>& model, int i) {
  return {model.filter, S(model.nu_limit(i)), S(model.gate * model.gate), S(model.gate_widen(i)),
          S(model.gate_narrow(i))};
}

// The widening, from 1 to the widest whatever it was: a NaN is 1.
template <class S, class Listener>
S kept_width(const S& width, const char* lower_end, Listener& listener) {
  const S widest = PowerOfTwo<S>::of(widest_gate_exponent);
  const S least = select(is_less(S(1), width), width, S(1));
  listener.name(least, lower_end);
  return select(is_less(least, widest), least, widest);
}

// Whether ν of the variance s is believable, and ν² ≤ gate² s widening. Then that narrows. It widens where the gate
// left the output out: then x̂ is wrong, not the sensor, if that goes on. With a constant gain it widens, too, while
// nothing usable comes: P, which is not carried, would grow.
template <class S, class Listener>
auto weigh_unexpected(const Weighing<S>& weighing, S& widening, const S& nu, const S& s, int i, Listener& listener) {
  listener.section("the widening, at least 1");
  const S width = kept_width(widening, "width_or_1", listener);
  listener.name(width, "width");
  listener.section("0 < S, |innovation| below its limit, innovation² ≤ gate² S widening");
  auto believable = is_less(absolute(nu), weighing.limit);
  listener.name(believable, "believable");
  auto usable = weighing.filter == Filter::plain ? listener.accept(both(believable, is_less(S(0), s)), believable, i)
                                                 : listener.accept(believable, i);
  auto beyond = is_less(S(S(weighing.square * s) * width), S(nu * nu));
  listener.name(beyond, "beyond");
  auto gated = both(usable, beyond);
  listener.name(gated, "gated");
  listener.gate(gated, i);
  auto used = both(usable, negation(beyond));
  listener.name(used, "used");
  listener.section("it widens or narrows");
  const S unheard = weighing.filter == Filter::steady ? weighing.widen : select(gated, weighing.widen, S(1));
  const S next = select(used, weighing.narrow, unheard) * width;
  listener.name(next, "next_width");
  widening = kept_width(next, "next_width_or_1", listener);
  return used;
}

// Whether output i is used, of its innovation ν. `variance` makes s, the variance of ν, which is `least` or more. Most
// are as expected: ν² < gate² least while the widening is 1, and believable. Nothing changes then, and one comparison
// tells, as |ν| < limit is ν² < limit² for a power of two. It tells that s is positive, too.
template <class S, class Variance, class Listener>
auto weigh(const Model<S>& model, State<S>& state, const S& nu, const S& least, Variance variance, int i,
           Listener& listener) {
  if (is_zero(model.gate)) {
    auto believable = is_believable(model.nu_limit, i, nu);
    return model.filter == Filter::plain ? listener.accept(both(believable, is_less(S(0), least)), believable, i)
                                         : listener.accept(believable, i);
  }
  const S square = listener.constant(S(model.gate * model.gate), Quantity::gate_squared), most = square * least;
  listener.hint(most, "gate_square");
  const S limit = listener.constant(S(model.nu_limit(i) * model.nu_limit(i)), Quantity::innovation_limit_squared, i);
  const S threshold = listener.constant(select(is_less(most, limit), most, limit), Quantity::threshold, i);
  listener.name(threshold, "threshold");
  auto expected = both(is_less(S(nu * nu), threshold), negation(is_less(S(1), S(state.widening(i)))));
  auto used = listener.weigh(expected, i, nu, variance, [&] {
    return weigh_unexpected(weighing_of(model, i), state.widening(i), nu, S(variance()), i, listener);
  });
  listener.name(used, "usable");
  return used;
}

// Whether output i is within what its sensor can say. A NaN is: it is found elsewhere.
template <class S>
auto is_in_range(const Model<S>& model, const S& y, int i) {
  return both(negation(is_less(y, S(model.y_min(i)))), negation(is_less(S(model.y_max(i)), y)));
}

// y, NaN where its sensor cannot say that.
template <class S, class Listener>
S in_range_or_nan(const Model<S>& model, const S& y, int i, Listener& listener) {
  if (!model.y_min.size()) return y;
  listener.section("what its sensor can say, or NaN", i);
  const S heard = select(is_in_range(model, y, i), y, not_a_number(y));
  listener.name(heard, "heard");
  return heard;
}
template <class S, class Listener>
Vector<S> in_range_or_nan(const Model<S>& model, Vector<S> y, Listener& listener) {
  for (int i = 0; i < y.size(); ++i) y(i) = in_range_or_nan(model, S(y(i)), i, listener);
  return y;
}

// x ← A x + B u + M innovation;  innovation ← 0; what the regulator has to remember of u and of this sample
template <class S, class Listener>
void predict_state(const Model<S>& model, State<S>& state, const Vector<S>& u, BoundsCheck<S>& bounds,
                   Listener& listener) {
  listener.section(model.M.cols() ? "x̂ ← A x̂ + B u + M (what the outputs told of w)"
                   : model.nu     ? "x̂ ← A x̂ + B u"
                                  : "x̂ ← A x̂",
                   -1, and_check(model.x_bound));
  Vector<S> next(model.nx);
  for (int i = 0; i < model.nx; ++i) {
    S sum = model.prediction_begun.size() ? S(model.prediction_begun(i)) : S(model.A(i, 0) * state.x(0));
    for (int j = 1; j < model.nx; ++j) sum = multiply_add(S(model.A(i, j)), S(state.x(j)), sum);
    for (int j = 0; j < model.nu; ++j) sum = multiply_add(S(model.B(i, j)), S(u(j)), sum);
    for (int j = 0; j < model.M.cols(); ++j) sum = multiply_add(S(model.M(i, j)), S(state.innovation(j)), sum);
    listener.name(sum, "next", of_state(i));
    next(i) = sum;
    bounds.add(sum, model.x_bound, of_state(i, "x"), listener);
  }
  state.x = next;
  for (int j = 0; j < model.M.cols(); ++j) state.innovation(j) = S(0);
  remember(model, state, u, bounds, listener);
}

}  // namespace lqg::step
