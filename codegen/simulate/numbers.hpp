// SPDX-License-Identifier: MIT
// Between the numbers of the host and those of a run.
#pragma once

#include <vector>

#include "controller/controller.hpp"
#include "controller/rounding.hpp"
#include "step/model.hpp"

namespace lqg::simulate {

inline double as_double(double value) { return value; }
inline double as_double(float value) { return static_cast<double>(value); }
inline double as_double(const design::Real& value) { return design::to_double(value); }
template <class T>
double as_double(step::Fused<T> value) {
  return static_cast<double>(value.value);
}

template <class S>
Eigen::VectorXd as_doubles(const step::Vector<S>& values) {
  Eigen::VectorXd out(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) out(i) = as_double(values(i));
  return out;
}

template <class S>
step::Vector<S> numbers_of(const Eigen::VectorXd& values) {
  step::Vector<S> out(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) out(i) = S(values(i));
  return out;
}

// The nearest numbers of the target.
inline Eigen::VectorXd in_target(const controller::Target& target, Eigen::VectorXd values) {
  if (!target.is_double)
    for (double& value : values) value = static_cast<double>(static_cast<float>(value));
  return values;
}

// act(S()) with the scalar of the target: its numbers, and its way to multiply and add.
template <class Act>
auto with_scalar_of(const controller::Target& target, Act act) {
  if (target.is_double) return target.is_fused ? act(step::Fused<double>()) : act(double());
  return target.is_fused ? act(step::Fused<float>()) : act(float());
}

// Many digits to S by way of the target's numbers, as the emitted constants are.
template <class S>
auto constants_of(const controller::Target& target) {
  return [is_double = target.is_double](const design::Real& value) {
    return S(controller::rounded_to_target(value, is_double));
  };
}

}  // namespace lqg::simulate
