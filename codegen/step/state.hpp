// The parts that every filter shares: innovation, prediction of the state, the check that all is finite.
#pragma once

#include "step/model.hpp"

namespace lqg::step {

// The sum of all parts of a state is finite if and only if each is, short of an overflow that no honest state comes near.
// Each part is added as it is found, and each sum has a name, so that none has to wait for the last.
template <class S>
struct Total {
  S sum = S(0);
  template <class Listener>
  void add(const S& part, Listener& listener) {
    sum = sum + part;
    listener.name(sum, "sum");
  }
};

// y_i − C_i x − D_i u
template <class S>
S residual(const Model<S>& model, const State<S>& state, const S& y, int i) {
  S nu = y;
  for (int j = 0; j < model.nx; ++j) nu = multiply_subtract(S(model.C(i, j)), S(state.x(j)), nu);
  for (int j = 0; j < model.D.cols(); ++j) nu = multiply_subtract(S(model.D(i, j)), S(state.u(j)), nu);
  return nu;
}

// x ← A x + B u + M innovation;  innovation ← 0
template <class S, class Listener>
void predict_state(const Model<S>& model, State<S>& state, const Vector<S>& u, Total<S>& total, Listener& listener) {
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
    total.add(sum, listener);
  }
  state.x = next;
  if (model.D.cols()) state.u = u;
  for (int j = 0; j < model.M.cols(); ++j) state.innovation(j) = S(0);
}

}  // namespace lqg::step
