// SPDX-License-Identifier: MIT
// The functions of a formula for numbers of the target: those of lqg/functions.h, which has the same bits everywhere.
#pragma once

#include <cmath>
#include <type_traits>

#include "lqg/functions.h"
#include "step/scalar.hpp"

namespace lqg::step {

// A float or double whose products and sums round by themselves. In formulas it stands for that number, whose own
// functions would be those of the host's library.
template <class T>
struct Plain {
  T value;
  Plain(T v = 0) : value(v) {}
};
template <class T>
Plain<T> operator+(const Plain<T>& a, const Plain<T>& b) {
  return a.value + b.value;
}
template <class T>
Plain<T> operator-(const Plain<T>& a, const Plain<T>& b) {
  return a.value - b.value;
}
template <class T>
Plain<T> operator-(const Plain<T>& a) {
  return -a.value;
}
template <class T>
Plain<T> operator*(const Plain<T>& a, const Plain<T>& b) {
  return a.value * b.value;
}
template <class T>
Plain<T> operator/(const Plain<T>& a, const Plain<T>& b) {
  return a.value / b.value;
}
template <class T>
bool is_less(const Plain<T>& a, const Plain<T>& b) {
  return a.value < b.value;
}
template <class T>
Plain<T> select(bool condition, const Plain<T>& yes, const Plain<T>& no) {
  return condition ? yes : no;
}
template <class T>
Fused<T> operator-(const Fused<T>& a) {
  return -a.value;
}
template <class T>
Fused<T> select(bool condition, const Fused<T>& yes, const Fused<T>& no) {
  return condition ? yes : no;
}

// In [−π, π), of numbers of many digits.
template <class S>
S wrapped(const S& a) {
  const S half_turn = acos(S(-1)), turn = half_turn + half_turn;
  return a - S(turn * floor(S((a + half_turn) / turn)));
}

// lqg/functions.h by the type of its numbers.
template <class T>
struct Library;
template <>
struct Library<float> {
  static float sqrt(float a) { return lqg_sqrtf(a); }
  static float sin(float a) { return lqg_sinf(a); }
  static float cos(float a) { return lqg_cosf(a); }
  static float tan(float a) { return lqg_tanf(a); }
  static float asin(float a) { return lqg_asinf(a); }
  static float acos(float a) { return lqg_acosf(a); }
  static float atan(float a) { return lqg_atanf(a); }
  static float exp(float a) { return lqg_expf(a); }
  static float log(float a) { return lqg_logf(a); }
  static float tanh(float a) { return lqg_tanhf(a); }
  static float atan2(float y, float x) { return lqg_atan2f(y, x); }
  static float wrapped(float a) { return lqg_wrapf(a); }
};
template <>
struct Library<double> {
  static double sqrt(double a) { return lqg_sqrt(a); }
  static double sin(double a) { return lqg_sin(a); }
  static double cos(double a) { return lqg_cos(a); }
  static double tan(double a) { return lqg_tan(a); }
  static double asin(double a) { return lqg_asin(a); }
  static double acos(double a) { return lqg_acos(a); }
  static double atan(double a) { return lqg_atan(a); }
  static double exp(double a) { return lqg_exp(a); }
  static double log(double a) { return lqg_log(a); }
  static double tanh(double a) { return lqg_tanh(a); }
  static double atan2(double y, double x) { return lqg_atan2(y, x); }
  static double wrapped(double a) { return lqg_wrap(a); }
};

// The numbers that compute by it.
template <template <class> class Number>
constexpr bool is_of_library = false;
template <>
inline constexpr bool is_of_library<Plain> = true;
template <>
inline constexpr bool is_of_library<Fused> = true;
template <template <class> class Number>
using IfOfLibrary = std::enable_if_t<is_of_library<Number>, int>;

template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> sqrt(const Number<T>& a) {
  return Library<T>::sqrt(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> sin(const Number<T>& a) {
  return Library<T>::sin(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> cos(const Number<T>& a) {
  return Library<T>::cos(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> tan(const Number<T>& a) {
  return Library<T>::tan(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> asin(const Number<T>& a) {
  return Library<T>::asin(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> acos(const Number<T>& a) {
  return Library<T>::acos(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> atan(const Number<T>& a) {
  return Library<T>::atan(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> exp(const Number<T>& a) {
  return Library<T>::exp(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> log(const Number<T>& a) {
  return Library<T>::log(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> tanh(const Number<T>& a) {
  return Library<T>::tanh(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> wrapped(const Number<T>& a) {
  return Library<T>::wrapped(a.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> atan2(const Number<T>& y, const Number<T>& x) {
  return Library<T>::atan2(y.value, x.value);
}
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> abs(const Number<T>& a) {
  return std::abs(a.value);
}
// aᵇ = e^(b ln a)
template <template <class> class Number, class T, IfOfLibrary<Number> = 0>
Number<T> power(const Number<T>& a, const Number<T>& b) {
  return exp(b * log(a));
}

// The scalar that formulas are evaluated over in place of S.
template <class S>
struct OfFormula {
  using Scalar = S;
  static const S& number(const S& value) { return value; }
};
template <class T>
struct OfNumber {
  using Scalar = Plain<T>;
  static T number(const Plain<T>& value) { return value.value; }
};
template <>
struct OfFormula<float> : OfNumber<float> {};
template <>
struct OfFormula<double> : OfNumber<double> {};

}  // namespace lqg::step
