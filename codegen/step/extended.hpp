// SPDX-License-Identifier: MIT
// The extended Kalman filter: the equations of the plant at the estimate, with their Jacobians.
//
// Formulas run over duals, so that one run gives a value and its slopes of each state: C of h, and A of the very step
// that takes x̂ from one sample to the next. P is then that of the linear filters.
#pragma once

#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "step/functions.hpp"
#include "step/kalman_plain.hpp"
#include "step/kalman_ud.hpp"

namespace lqg::step {

template <class S>
using FormulaDual = expression::Dual<typename OfFormula<S>::Scalar>;
template <class S>
using FormulaDuals = std::vector<FormulaDual<S>>;

// x, each with the slope 1 of itself.
template <class S>
FormulaDuals<S> variables(const Vector<S>& x) {
  FormulaDuals<S> out;
  const auto count = static_cast<int>(x.size());
  for (int i = 0; i < count; ++i)
    out.push_back(FormulaDual<S>::variable(typename OfFormula<S>::Scalar(x(i)), i, count));
  return out;
}

// Of variables x and inputs u, which have no slopes.
template <class S>
FormulaDual<S> value_of_formula(const Equations<S>& equations, const expression::Node& formula,
                                const FormulaDuals<S>& x, const Vector<S>& u) {
  using Scalar = typename OfFormula<S>::Scalar;
  const int nx = static_cast<int>(x.size());
  return expression::evaluate<FormulaDual<S>>(
      formula, [&](int i) -> FormulaDual<S> { return i < nx ? x[static_cast<std::size_t>(i)] : Scalar(u(i - nx)); },
      [&](const expression::Node& node) -> FormulaDual<S> { return Scalar(equations.constants.at(&node)); });
}

// The names of state i and of its slopes.
template <class S, class Listener>
void name_duals(const FormulaDuals<S>& duals, const char* name, const char* slope, Listener& listener) {
  for (int i = 0; i < static_cast<int>(duals.size()); ++i) {
    const FormulaDual<S>& dual = duals[static_cast<std::size_t>(i)];
    listener.name(S(OfFormula<S>::number(dual.value)), name, of_state(i));
    for (int j = 0; j < dual.slopes.size(); ++j)
      listener.hint(S(OfFormula<S>::number(dual.slope(j))), slope, of_entry(i, j));
  }
}

template <class S, class Listener>
FormulaDuals<S> rates(const Equations<S>& equations, const FormulaDuals<S>& x, const Vector<S>& u, const char* name,
                      const char* slope, Listener& listener) {
  FormulaDuals<S> out;
  for (const auto& formula : equations.f) out.push_back(value_of_formula(equations, *formula, x, u));
  name_duals<S>(out, name, slope, listener);
  return out;
}

// J D: the slopes of k, which have been taken by the state of a stage, by the variables of that state x.
template <class S>
S slope_by_variable(const FormulaDual<S>& k, const FormulaDuals<S>& x, Eigen::Index variable) {
  S sum(0);
  bool is_first = true;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const S of_rate(OfFormula<S>::number(k.slope(static_cast<Eigen::Index>(i))));
    const S of_stage(OfFormula<S>::number(x[i].slope(variable)));
    if (is_zero(of_rate) || is_zero(of_stage)) continue;
    sum = is_first ? S(of_rate * of_stage) : multiply_add(of_rate, of_stage, sum);
    is_first = false;
  }
  return sum;
}

// The rates at a stage x. The formulas run over slopes by the stage itself, of which most are 0, and one product with
// those of the stage follows: fewer operations than with those in each of them.
template <class S, class Listener>
FormulaDuals<S> rates_of_stage(const Equations<S>& equations, const FormulaDuals<S>& x, const Vector<S>& u,
                               const char* name, const char* slope, const char* product, Listener& listener) {
  using Scalar = typename OfFormula<S>::Scalar;
  const auto count = static_cast<Eigen::Index>(x.size());
  Vector<S> values(count);
  for (Eigen::Index i = 0; i < count; ++i) values(i) = S(OfFormula<S>::number(x[static_cast<std::size_t>(i)].value));
  FormulaDuals<S> out = rates(equations, variables(values), u, name, slope, listener);
  for (std::size_t i = 0; i < out.size(); ++i) {
    typename FormulaDual<S>::Slopes slopes(count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const S by_variable = slope_by_variable<S>(out[i], x, j);
      listener.hint(by_variable, product, of_entry(static_cast<int>(i), static_cast<int>(j)));
      slopes(j) = Scalar(by_variable);
    }
    out[i].slopes = std::move(slopes);
  }
  return out;
}

// x + c k
template <class S>
FormulaDuals<S> moved(const FormulaDuals<S>& x, const S& c, const FormulaDuals<S>& k) {
  using Scalar = typename OfFormula<S>::Scalar;
  const Scalar factor(c);
  FormulaDuals<S> out;
  for (std::size_t i = 0; i < x.size(); ++i)
    out.push_back(
        expression::joined(Scalar(multiply_add(factor, k[i].value, x[i].value)), x[i], k[i],
                           [&](const Scalar& p, const Scalar& q) { return Scalar(multiply_add(factor, q, p)); }));
  return out;
}
template <class S, class Listener>
FormulaDuals<S> moved(const FormulaDuals<S>& x, const S& c, const FormulaDuals<S>& k, const char* name,
                      const char* slope, Listener& listener) {
  FormulaDuals<S> out = moved<S>(x, c, k);
  name_duals<S>(out, name, slope, listener);
  return out;
}

// The classical step of fourth order: x + T/6 (k1 + k4) + T/3 (k2 + k3)
template <class S, class Listener>
FormulaDuals<S> runge_kutta_step(const Equations<S>& equations, const FormulaDuals<S>& x, const Vector<S>& u,
                                 Listener& listener) {
  const FormulaDuals<S> k1 = rates(equations, x, u, "k1", "J1", listener);
  const FormulaDuals<S> x2 = moved<S>(x, equations.T_half, k1, "x2", "D2", listener);
  const FormulaDuals<S> k2 = rates_of_stage(equations, x2, u, "k2", "J2", "JD2", listener);
  const FormulaDuals<S> x3 = moved<S>(x, equations.T_half, k2, "x3", "D3", listener);
  const FormulaDuals<S> k3 = rates_of_stage(equations, x3, u, "k3", "J3", "JD3", listener);
  const FormulaDuals<S> x4 = moved<S>(x, equations.T, k3, "x4", "D4", listener);
  const FormulaDuals<S> k4 = rates_of_stage(equations, x4, u, "k4", "J4", "JD4", listener);
  FormulaDuals<S> outer, inner;
  for (std::size_t i = 0; i < x.size(); ++i) {
    outer.push_back(k1[i] + k4[i]);
    inner.push_back(k2[i] + k3[i]);
  }
  return moved<S>(moved<S>(x, equations.T_sixth, outer), equations.T_third, inner);
}

template <class S, class Listener>
FormulaDuals<S> next_state(const Equations<S>& equations, const FormulaDuals<S>& x, const Vector<S>& u,
                           Listener& listener) {
  switch (equations.integration) {
    case Integration::none: return rates(equations, x, u, "next", "A", listener);
    case Integration::euler: return moved<S>(x, equations.T, rates(equations, x, u, "rate", "J", listener));
    default: return runge_kutta_step(equations, x, u, listener);
  }
}

inline const char* equation_of_step(Integration integration) {
  switch (integration) {
    case Integration::none: return "x̂ ← f(x̂, u), and A, its Jacobian";
    case Integration::euler: return "x̂ ← x̂ + T f(x̂, u), and A, the Jacobian of this step";
    default: return "x̂ ← x̂ + T/6 (k1 + 2 k2 + 2 k3 + k4), Runge-Kutta, and A, the Jacobian of this step";
  }
}

// The Jacobian in row i of `to`, named so where it is no constant.
template <class S, class Listener>
void take_slopes(const FormulaDual<S>& value, Matrix<S>& to, int i, const char* name, Listener& listener) {
  for (int j = 0; j < to.cols(); ++j) {
    to(i, j) = S(OfFormula<S>::number(value.slope(j)));
    listener.name(to(i, j), name, of_entry(i, j));
  }
}

// x̂ and P to the next sample.
template <class S, class Listener>
auto predict_extended(const Model<S>& model, State<S>& state, const Vector<S>& u, Listener& listener) {
  BoundsCheck<S> bounds;
  listener.section(equation_of_step(model.equations->integration), -1, and_check(model.x_bound));
  const FormulaDuals<S> next = next_state(*model.equations, variables(state.x), u, listener);
  Model<S> linear = model;
  linear.A_free.resize(model.nx, model.nx);
  for (int i = 0; i < model.nx; ++i) {
    const FormulaDual<S>& part = next[static_cast<std::size_t>(i)];
    take_slopes<S>(part, linear.A_free, i, "A", listener);
    state.x(i) = S(OfFormula<S>::number(part.value));
    listener.name(state.x(i), "next", of_state(i));
    bounds.add(S(state.x(i)), model.x_bound, of_state(i, "x"), listener);
  }
  remember(model, state, u, bounds, listener);
  if (model.filter == Filter::ud)
    predict_ud_covariance(linear, state, bounds, listener);
  else
    predict_plain_covariance(linear, state, bounds, listener);
  return bounds.is_within();
}

// y − h(x̂, u), and the Jacobian of h, of the outputs as they are. A row that is not finite leaves its output out: its
// innovation is NaN, and its slopes are 0.
template <class S>
struct OutputsAtEstimate {
  Vector<S> innovation;
  Matrix<S> C;
};

template <class S, class Listener>
void take_output(const Model<S>& model, const State<S>& state, const FormulaDuals<S>& x, const S& y, int i,
                 OutputsAtEstimate<S>& out, Listener& listener) {
  const Equations<S>& equations = *model.equations;
  const bool wraps = equations.wraps[static_cast<std::size_t>(i)];
  listener.section(wraps ? "y − h(x̂, u) in [−π, π), and C, the Jacobian of h; NaN where that is not finite"
                         : "y − h(x̂, u), and C, the Jacobian of h; NaN where that is not finite",
                   i);
  const FormulaDual<S> h = value_of_formula(equations, *equations.h[static_cast<std::size_t>(i)], x, state.u);
  const S expected(OfFormula<S>::number(h.value));
  listener.name(expected, "expected");
  take_slopes<S>(h, out.C, i, "C", listener);
  S sum = out.C(i, 0);
  for (int j = 1; j < model.nx; ++j) sum = sum + S(out.C(i, j));
  auto has_slopes = is_finite(sum);
  listener.hint(has_slopes, "has_slopes");
  S difference = y - expected;
  if (wraps) difference = S(OfFormula<S>::number(wrapped(typename OfFormula<S>::Scalar(difference))));
  out.innovation(i) = select(has_slopes, difference, not_a_number(difference));
  listener.name(out.innovation(i), "difference");
  for (int j = 0; j < model.nx; ++j) {
    out.C(i, j) = select(has_slopes, S(out.C(i, j)), S(0));
    listener.hint(out.C(i, j), "slope", of_entry(i, j));
  }
}

template <class S, class Listener>
OutputsAtEstimate<S> outputs_at_estimate(const Model<S>& model, const State<S>& state, const Vector<S>& y,
                                         Listener& listener) {
  OutputsAtEstimate<S> out = {Vector<S>(model.ny), Matrix<S>(model.ny, model.nx)};
  const FormulaDuals<S> x = variables(state.x);
  for (int i = 0; i < model.ny; ++i) take_output(model, state, x, S(y(i)), i, out, listener);
  return out;
}

// The model whose C is E times the Jacobian of h at x̂.
template <class S, class Listener>
Model<S> linearised(const Model<S>& model, const State<S>& state, const Matrix<S>& C, Listener& listener) {
  Model<S> linear = model;
  linear.linearised_at = state.x;
  linear.C = C;
  for (int i = 0; i < model.ny; ++i)
    for (int k = 0; k < i; ++k) {
      if (is_zero(S(model.E(i, k)))) continue;
      listener.section("C ← E C, of the outputs with uncorrelated noise", i);
      for (int j = 0; j < model.nx; ++j) {
        linear.C(i, j) = multiply_add(S(model.E(i, k)), S(C(k, j)), S(linear.C(i, j)));
        listener.hint(linear.C(i, j), "mixed_C", of_entry(i, j));
      }
    }
  return linear;
}

}  // namespace lqg::step
