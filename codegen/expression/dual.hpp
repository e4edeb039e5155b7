// SPDX-License-Identifier: MIT
// A number with its slopes: a function that is run over duals gives its value and its Jacobian.
//
// f(a + ε) = f(a) + f'(a) ε: each operation's slopes by the chain rule. A constant has no slopes (an empty vector), so
// that it costs nothing. Where f has a kink (abs at 0, min and max of equal values) the slope is that of the side that
// `select` takes.
#pragma once

#include <Eigen/Core>

#include "expression/scalar.hpp"

namespace lqg::expression {

template <class S>
struct Dual {
  using Slopes = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  S value;
  Slopes slopes;  // of each variable, or empty: all 0

  Dual(const S& number = S(0)) : value(number) {}
  Dual(const S& number, Slopes of_variables) : value(number), slopes(std::move(of_variables)) {}
  // Variable `index` of `count`.
  static Dual variable(const S& number, int index, int count) {
    Slopes unit = Slopes::Constant(count, S(0));
    unit(index) = S(1);
    return {number, std::move(unit)};
  }
  S slope(Eigen::Index i) const { return slopes.size() ? S(slopes(i)) : S(0); }
};

// value with the slopes `by` a' of its operand.
template <class S>
Dual<S> chained(const S& value, const Dual<S>& a, const S& by) {
  typename Dual<S>::Slopes slopes(a.slopes.size());
  for (Eigen::Index i = 0; i < slopes.size(); ++i) slopes(i) = S(by * a.slopes(i));
  return {value, std::move(slopes)};
}

// value with the slopes make(a', b').
template <class S, class Make>
Dual<S> joined(const S& value, const Dual<S>& a, const Dual<S>& b, const Make& make) {
  typename Dual<S>::Slopes slopes(std::max(a.slopes.size(), b.slopes.size()));
  for (Eigen::Index i = 0; i < slopes.size(); ++i) slopes(i) = make(a.slope(i), b.slope(i));
  return {value, std::move(slopes)};
}

template <class S>
Dual<S> operator+(const Dual<S>& a, const Dual<S>& b) {
  if (!b.slopes.size()) return {S(a.value + b.value), a.slopes};
  if (!a.slopes.size()) return {S(a.value + b.value), b.slopes};
  return joined(S(a.value + b.value), a, b, [](const S& p, const S& q) { return S(p + q); });
}
template <class S>
Dual<S> operator-(const Dual<S>& a) {
  return chained(S(S(0) - a.value), a, S(-1));
}
template <class S>
Dual<S> operator-(const Dual<S>& a, const Dual<S>& b) {
  if (!b.slopes.size()) return {S(a.value - b.value), a.slopes};
  return joined(S(a.value - b.value), a, b, [](const S& p, const S& q) { return S(p - q); });
}
template <class S>
Dual<S> operator*(const Dual<S>& a, const Dual<S>& b) {
  const S value = a.value * b.value;
  if (!b.slopes.size()) return chained(value, a, b.value);
  if (!a.slopes.size()) return chained(value, b, a.value);
  return joined(value, a, b, [&](const S& p, const S& q) { return S(S(p * b.value) + S(a.value * q)); });
}
// (a/b)' = (a' − (a/b) b')/b
template <class S>
Dual<S> operator/(const Dual<S>& a, const Dual<S>& b) {
  const S value = a.value / b.value;
  const S reciprocal = S(1) / b.value;
  if (!b.slopes.size()) return chained(value, a, reciprocal);
  if (!a.slopes.size()) return chained(value, b, S(S(S(0) - value) * reciprocal));
  return joined(value, a, b, [&](const S& p, const S& q) { return S(S(p - S(value * q)) * reciprocal); });
}

template <class S>
Dual<S> sqrt(const Dual<S>& a) {
  const S root = sqrt(a.value);
  return chained(root, a, S(S(0.5) / root));
}
template <class S>
Dual<S> sin(const Dual<S>& a) {
  return chained(S(sin(a.value)), a, S(cos(a.value)));
}
template <class S>
Dual<S> cos(const Dual<S>& a) {
  return chained(S(cos(a.value)), a, S(S(0) - sin(a.value)));
}
template <class S>
Dual<S> tan(const Dual<S>& a) {
  const S t = tan(a.value);
  return chained(t, a, S(S(1) + S(t * t)));
}
template <class S>
Dual<S> asin(const Dual<S>& a) {
  return chained(S(asin(a.value)), a, S(S(1) / S(sqrt(S(S(1) - S(a.value * a.value))))));
}
template <class S>
Dual<S> acos(const Dual<S>& a) {
  return chained(S(acos(a.value)), a, S(S(-1) / S(sqrt(S(S(1) - S(a.value * a.value))))));
}
template <class S>
Dual<S> atan(const Dual<S>& a) {
  return chained(S(atan(a.value)), a, S(S(1) / S(S(1) + S(a.value * a.value))));
}
template <class S>
Dual<S> exp(const Dual<S>& a) {
  const S e = exp(a.value);
  return chained(e, a, e);
}
template <class S>
Dual<S> log(const Dual<S>& a) {
  return chained(S(log(a.value)), a, S(S(1) / a.value));
}
template <class S>
Dual<S> tanh(const Dual<S>& a) {
  const S t = tanh(a.value);
  return chained(t, a, S(S(1) - S(t * t)));
}
// d atan2(y, x) = (x dy − y dx)/(x² + y²)
template <class S>
Dual<S> atan2(const Dual<S>& y, const Dual<S>& x) {
  const S reciprocal = S(1) / S(S(x.value * x.value) + S(y.value * y.value));
  const S by_y = x.value * reciprocal, by_x = y.value * reciprocal;
  return joined(S(atan2(y.value, x.value)), y, x, [&](const S& p, const S& q) { return S(S(by_y * p) - S(by_x * q)); });
}
// aᵇ = e^(b ln a); (aᵇ)' = b aᵇ⁻¹ a' + ln a aᵇ b'
template <class S>
Dual<S> power(const Dual<S>& a, const Dual<S>& b) {
  const S value = power(a.value, b.value);
  const S by_a = S(b.value * value) / a.value;
  if (!b.slopes.size()) return chained(value, a, by_a);
  const S by_b = S(log(a.value)) * value;
  return joined(value, a, b, [&](const S& p, const S& q) { return S(S(by_a * p) + S(by_b * q)); });
}

// The one or the other, with its slopes.
template <class Condition, class S>
Dual<S> either_side(const Condition& condition, const Dual<S>& yes, const Dual<S>& no) {
  return joined(S(select(condition, yes.value, no.value)), yes, no,
                [&](const S& p, const S& q) { return S(select(condition, p, q)); });
}
template <class S>
Dual<S> abs(const Dual<S>& a) {
  const auto is_negative = is_less(a.value, S(0));
  return chained(S(abs(a.value)), a, S(select(is_negative, S(-1), S(1))));
}
template <class S>
Dual<S> minimum(const Dual<S>& a, const Dual<S>& b) {
  return either_side(is_less(b.value, a.value), b, a);
}
template <class S>
Dual<S> maximum(const Dual<S>& a, const Dual<S>& b) {
  return either_side(is_less(a.value, b.value), b, a);
}

}  // namespace lqg::expression
