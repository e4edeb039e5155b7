// SPDX-License-Identifier: MIT
// Between the caller's numbers, which are in the plant's own units, and those of a model: deviations from its operating
// point. An entry of the point that is 0 takes no operation.
#pragma once

#include "step/model.hpp"

namespace lqg::step {

constexpr const char* deviations_from_point = "deviations from the operating point";

template <class S>
bool is_at_zero(const Vector<S>& point, int i) {
  return point.size() == 0 || is_zero(S(point(i)));
}

// own − point
template <class S>
S deviation_of(const Vector<S>& point, int i, const S& own) {
  return is_at_zero(point, i) ? own : S(own - S(point(i)));
}

// point + deviation
template <class S>
S in_own_units(const Vector<S>& point, int i, const S& deviation) {
  return is_at_zero(point, i) ? deviation : S(S(point(i)) + deviation);
}

// Of all of x, u or y; `place` tells which of them an entry is, "y" what they are.
template <class S, class Listener>
Vector<S> deviations_of(const Vector<S>& point, Vector<S> own, Place (*place)(int, const char*), const char* of,
                        Listener& listener) {
  if (point.size()) listener.section(deviations_from_point);
  for (int i = 0; i < own.size(); ++i) {
    if (is_at_zero(point, i)) continue;
    own(i) = deviation_of(point, i, S(own(i)));
    listener.name(own(i), "deviation", place(i, of));
  }
  return own;
}
template <class S, class Listener>
Vector<S> all_in_own_units(const Vector<S>& point, Vector<S> deviations, Place (*place)(int, const char*),
                           const char* of, Listener& listener) {
  if (point.size()) listener.section("in the plant's own units");
  for (int i = 0; i < deviations.size(); ++i) {
    if (is_at_zero(point, i)) continue;
    deviations(i) = in_own_units(point, i, S(deviations(i)));
    listener.name(deviations(i), "own", place(i, of));
  }
  return deviations;
}

template <class S, class Listener>
Vector<S> state_deviations(const OperatingPoint<S>& point, const Vector<S>& x, Listener& listener) {
  return deviations_of(point.x, x, of_state, "x", listener);
}
template <class S, class Listener>
Vector<S> input_deviations(const OperatingPoint<S>& point, const Vector<S>& u, Listener& listener) {
  return deviations_of(point.u, u, of_input, "u", listener);
}
template <class S, class Listener>
Vector<S> output_deviations(const OperatingPoint<S>& point, const Vector<S>& y, Listener& listener) {
  return deviations_of(point.y, y, of_output, "y", listener);
}
// Of output i alone.
template <class S, class Listener>
S output_deviation(const OperatingPoint<S>& point, const S& y, int i, Listener& listener) {
  if (is_at_zero(point.y, i)) return y;
  listener.section(deviations_from_point);
  const S deviation = deviation_of(point.y, i, y);
  listener.name(deviation, "deviation", of_output(i, "y"));
  return deviation;
}
template <class S, class Listener>
Vector<S> own_state(const OperatingPoint<S>& point, const Vector<S>& x, Listener& listener) {
  return all_in_own_units(point.x, x, of_state, "x", listener);
}
template <class S, class Listener>
Vector<S> own_input(const OperatingPoint<S>& point, const Vector<S>& u, Listener& listener) {
  return all_in_own_units(point.u, u, of_input, "u", listener);
}

}  // namespace lqg::step
