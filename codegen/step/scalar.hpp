// SPDX-License-Identifier: MIT
// What an algorithm of one sample asks of its scalar, and the scalars that compute with numbers.
//
// Each multiply-add is written as one, so that the same text rounds once (fused) or twice (plain) as the target does:
//     multiply_add(a, b, c) = a b + c        multiply_subtract(a, b, c) = c − a b
// A decision is a condition that `select` turns into a value, never a branch.
#pragma once

#include <cmath>
#include <limits>

namespace lqg::step {

// Numbers that round every multiply and every add: float, double, and scalars of many digits.
template <class S>
S multiply_add(const S& a, const S& b, const S& c) {
  const S product = a * b;
  return product + c;
}
template <class S>
S multiply_subtract(const S& a, const S& b, const S& c) {
  const S product = a * b;
  return c - product;
}
template <class S>
bool is_finite(const S& a) {
  return a - a == 0;
}
// a finite and b positive, in one comparison: a − a is 0, or NaN, which is not less than anything.
template <class S>
bool is_usable(const S& a, const S& b) {
  return a - a < b;
}
template <class S>
bool is_zero(const S& a) {
  return a == 0;
}
template <class S>
S absolute(const S& a) {
  return a < 0 ? S(-a) : a;
}
template <class S>
bool is_less(const S& a, const S& b) {
  return a < b;
}
template <class S>
S select(bool condition, const S& yes, const S& no) {
  return condition ? yes : no;
}
// 2^exponent
template <class S>
struct PowerOfTwo {
  static S of(int exponent) { return S(std::ldexp(1.0, exponent)); }
};
// Of the kind of the argument.
template <class S>
S not_a_number(const S&) {
  return S(std::numeric_limits<double>::quiet_NaN());
}
inline bool either(bool a, bool b) { return a || b; }
inline bool both(bool a, bool b) { return a && b; }
inline bool negation(bool a) { return !a; }

// A float or double whose multiply-adds round once, as those of a target with hardware for it do.
template <class T>
struct Fused {
  T value;
  Fused(T v = 0) : value(v) {}
};
template <class T>
Fused<T> operator+(Fused<T> a, Fused<T> b) {
  return a.value + b.value;
}
template <class T>
Fused<T> operator-(Fused<T> a, Fused<T> b) {
  return a.value - b.value;
}
template <class T>
Fused<T> operator*(Fused<T> a, Fused<T> b) {
  return a.value * b.value;
}
template <class T>
Fused<T> operator/(Fused<T> a, Fused<T> b) {
  return a.value / b.value;
}
template <class T>
Fused<T> multiply_add(const Fused<T>& a, const Fused<T>& b, const Fused<T>& c) {
  return std::fma(a.value, b.value, c.value);
}
template <class T>
Fused<T> multiply_subtract(const Fused<T>& a, const Fused<T>& b, const Fused<T>& c) {
  return std::fma(-a.value, b.value, c.value);
}
template <class T>
bool is_finite(const Fused<T>& a) {
  return is_finite(a.value);
}
template <class T>
bool is_usable(const Fused<T>& a, const Fused<T>& b) {
  return is_usable(a.value, b.value);
}
template <class T>
struct PowerOfTwo<Fused<T>> {
  static Fused<T> of(int exponent) { return std::ldexp(T(1), exponent); }
};
template <class T>
bool is_zero(const Fused<T>& a) {
  return a.value == 0;
}
template <class T>
Fused<T> absolute(const Fused<T>& a) {
  return std::abs(a.value);
}
template <class T>
bool is_less(const Fused<T>& a, const Fused<T>& b) {
  return a.value < b.value;
}

}  // namespace lqg::step
