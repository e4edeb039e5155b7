// SPDX-License-Identifier: MIT
// What a formula asks of its scalar, for those that are numbers: float, double, and numbers of many digits.
//
// Every other scalar (dual numbers, the symbolic one) brings the same names in its own namespace. They are called
// without a namespace, so that each scalar's own is found.
#pragma once

#include <cmath>

namespace lqg::expression {

using std::abs;
using std::acos;
using std::asin;
using std::atan;
using std::atan2;
using std::cos;
using std::exp;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;
using std::tan;
using std::tanh;

template <class S>
bool is_less(const S& a, const S& b) {
  return a < b;
}
template <class S>
S select(bool condition, const S& yes, const S& no) {
  return condition ? yes : no;
}
// aᵇ
template <class S>
S power(const S& a, const S& b) {
  return pow(a, b);
}
// What says how `select` takes sides where a and b are equal: a.
template <class S>
S minimum(const S& a, const S& b) {
  return select(is_less(b, a), b, a);
}
template <class S>
S maximum(const S& a, const S& b) {
  return select(is_less(a, b), b, a);
}

}  // namespace lqg::expression
