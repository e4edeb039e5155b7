// SPDX-License-Identifier: MIT
#include "controller/operating_point.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "controller/limit_of_target.hpp"
#include "design/sampled/added_states.hpp"

namespace lqg::controller {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd point_in_target(const VectorXd& values, bool is_double) {
  if (is_double) return values;
  return values.unaryExpr([](double value) { return static_cast<double>(static_cast<float>(value)); });
}

VectorXd empty_if_zero(const VectorXd& values) { return values.isZero(0) ? VectorXd() : values; }

// Of all states: those of the plant, disturbances, late outputs, inputs on their way.
VectorXd states_of_point(const Controller& controller) {
  const design::Plant& plant = controller.problem.plant;
  const design::OperatingPoint& point = *plant.operating_point;
  VectorXd x = VectorXd::Zero(controller.size.nx);
  x.head(point.x.size()) = point.x;
  Index at = controller.size.nx - controller.size.delayed;
  for (int i = 0; i < controller.size.delayed; ++i) x(at + i) = point.u(i % controller.size.nu);
  if (!controller.problem.estimator) return x;
  const std::vector<Index> periods = design::periods_of_outputs(plant);
  for (const Index late : periods) at -= late;
  for (std::size_t i = 0; i < periods.size(); ++i)
    for (Index k = 0; k < periods[i]; ++k) x(at++) = point.y(static_cast<Index>(i));
  return x;
}

template <class T>
T limit_from(T point, T limit, int inward) {
  const auto is_within = [&](T deviation) {
    const T sum = point + deviation;
    return inward < 0 ? sum <= limit : sum >= limit;
  };
  const T inside = inward < 0 ? -std::numeric_limits<T>::infinity() : std::numeric_limits<T>::infinity();
  T near = limit - point;
  if (point + near == limit) return near;
  while (!is_within(near)) near = std::nextafter(near, inside);
  T width = std::max(std::abs(limit), std::abs(point)) * std::numeric_limits<T>::epsilon() +
            std::numeric_limits<T>::denorm_min(),
    far = near;
  while (is_within(far)) far = inward < 0 ? near + width : near - width, width *= 2;
  for (;;) {
    const T middle = near + (far - near) / 2;
    if (middle == near || middle == far) return near;
    (is_within(middle) ? near : far) = middle;
  }
}

double difference(double a, double b, bool is_double) {
  return is_double ? a - b : static_cast<double>(static_cast<float>(a) - static_cast<float>(b));
}

// As the file states it, or the limit itself where there is no operating point.
const VectorXd& own(const Controller& controller, const VectorXd& limits, VectorXd design::OperatingPoint::* stated) {
  const auto& point = controller.problem.plant.operating_point;
  return point && ((*point).*stated).size() ? (*point).*stated : limits;
}

// Rounded inwards, and then made a deviation by `deviation(limit, point)`.
template <class Deviation>
VectorXd limits_of(const VectorXd& own, const VectorXd& point, int inward, bool is_double, Deviation deviation) {
  VectorXd result(own.size());
  for (Index i = 0; i < own.size(); ++i) {
    const double limit = limit_of_target(own(i), inward, is_double);
    result(i) = point.size() && point(i) != 0 && std::isfinite(limit) ? deviation(limit, point(i)) : limit;
  }
  return result;
}

}  // namespace

Point stated_point(const Controller& controller) {
  const auto& point = controller.problem.plant.operating_point;
  if (!point) return {};
  Point result;
  result.x = empty_if_zero(states_of_point(controller));
  result.u = empty_if_zero(point->u);
  result.y = empty_if_zero(point->y);
  VectorXd r(controller.size.nr);
  for (Index i = 0; i < r.size(); ++i) r(i) = point->y(controller.references[static_cast<std::size_t>(i)]);
  result.r = empty_if_zero(r);
  return result;
}

// An extended filter is in the plant's own units.
Point point_of(const Controller& controller) {
  if (is_extended(controller)) return {};
  Point point = stated_point(controller);
  for (VectorXd* part : {&point.x, &point.u, &point.y, &point.r})
    *part = empty_if_zero(point_in_target(*part, controller.target.is_double));
  if (!controller.has.filter) point.y.resize(0);
  return point;
}

Controller without_point(Controller controller) {
  controller.point = {};
  controller.problem.plant.operating_point.reset();
  return controller;
}

VectorXd in_own_units(VectorXd deviations, const VectorXd& point) {
  if (point.size()) deviations += point.head(deviations.size());
  return deviations;
}

VectorXd as_deviations(VectorXd own, const VectorXd& point) {
  if (point.size()) own -= point.head(own.size());
  return own;
}

void check_point(const Controller& controller, design::Findings& findings) {
  const auto& point = controller.problem.plant.operating_point;
  if (!point) return;
  const double most = controller.target.is_double ? 0x1p960 : 0x1p100;  // less than half the last bit of the largest
  for (const auto& [list, values] : {std::pair("states", &point->x), {"inputs", &point->u}, {"outputs", &point->y}})
    for (Index i = 0; i < values->size(); ++i)
      if (!(std::abs((*values)(i)) < most))
        design::add_error(findings, std::string("plant.operating_point.") + list + "[" + std::to_string(i) + "]",
                          "expected a number below " + design::decimal(most) + ", found " +
                              design::decimal((*values)(i)) + ": choose a larger unit");
}

double deviation_limit(double limit, double point, int inward, bool is_double) {
  if (std::isinf(limit)) return limit;
  if (is_double) return limit_from(point, limit, inward);
  return static_cast<double>(limit_from(static_cast<float>(point), static_cast<float>(limit), inward));
}

VectorXd input_limits(const Controller& controller, int inward) {
  const bool is_double = controller.target.is_double;
  return limits_of(own_input_limits(controller, inward), controller.point.u, inward, is_double,
                   [&](double limit, double point) { return deviation_limit(limit, point, inward, is_double); });
}

VectorXd input_limits_reached(const Controller& controller, int inward) {
  const bool is_double = controller.target.is_double;
  VectorXd limits = input_limits(controller, inward);
  const VectorXd& point = controller.point.u;
  for (Index i = 0; i < limits.size() && point.size(); ++i)
    limits(i) = is_double ? point(i) + limits(i)
                          : static_cast<double>(static_cast<float>(point(i)) + static_cast<float>(limits(i)));
  return limits;
}

VectorXd output_range(const Controller& controller, int inward) {
  const bool is_double = controller.target.is_double;
  return limits_of(own_output_range(controller, inward), controller.point.y, inward, is_double,
                   [&](double limit, double point) { return difference(limit, point, is_double); });
}

const VectorXd& own_input_limits(const Controller& controller, int inward) {
  const design::Limits& limits = *controller.problem.limits;
  return inward > 0 ? own(controller, limits.u_min, &design::OperatingPoint::u_min)
                    : own(controller, limits.u_max, &design::OperatingPoint::u_max);
}

const VectorXd& own_output_range(const Controller& controller, int inward) {
  const design::Estimator& estimator = *controller.problem.estimator;
  return inward > 0 ? own(controller, estimator.output_min, &design::OperatingPoint::output_min)
                    : own(controller, estimator.output_max, &design::OperatingPoint::output_max);
}

design::SoftLimits own_state_limits(const Controller& controller) {
  design::SoftLimits limits = controller.problem.limits->states;
  if (const auto& point = controller.problem.plant.operating_point) limits.range = point->states_range;
  return limits;
}

design::SoftLimits own_output_limits(const Controller& controller) {
  design::SoftLimits limits = controller.problem.limits->outputs;
  if (const auto& point = controller.problem.plant.operating_point) limits.range = point->outputs_range;
  return limits;
}

}  // namespace lqg::controller
