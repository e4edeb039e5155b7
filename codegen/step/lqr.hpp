// The control law.
#pragma once

#include "step/model.hpp"

namespace lqg::step {

// u = −K x, finite, within its limits.
template <class S, class Listener>
Vector<S> control(const Model<S>& model, const Vector<S>& x, Listener& listener) {
  listener.section(model.u_min.size() ? "u = −K x̂, within its limits" : "u = −K x̂");
  Vector<S> u(model.nu);
  for (int i = 0; i < model.nu; ++i) {
    S sum = S(0);
    for (int j = 0; j < model.nx; ++j) sum = multiply_subtract(S(model.K(i, j)), S(x(j)), sum);
    listener.name(sum, "law", i);
    auto finite = is_finite(sum);
    listener.name(finite, "finite", i);
    listener.raise(Event::input_limited, negation(finite));
    S value = select(finite, sum, S(0));
    listener.name(value, "demand", i);
    if (model.u_min.size()) {
      auto low = is_less(value, S(model.u_min(i)));
      auto high = is_less(S(model.u_max(i)), value);
      listener.raise(Event::input_limited, either(low, high));
      value = select(low, S(model.u_min(i)), select(high, S(model.u_max(i)), value));
      listener.name(value, "limited", i);
    }
    u(i) = value;
  }
  return u;
}

}  // namespace lqg::step
