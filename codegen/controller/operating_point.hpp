// SPDX-License-Identifier: MIT
// Where the caller's numbers are when those of the controller, which are deviations, are 0.
#pragma once

#include "controller/controller.hpp"
#include "design/finding.hpp"
#include "step/model.hpp"

namespace lqg::controller {

// Each part empty where all of it is 0. Added states are at 0, late outputs and inputs on their way where those of now
// are. In the target's numbers, and as the file states it, which is where the plant is.
Point point_of(const Controller& controller);
Point stated_point(const Controller& controller);

// The same controller of a plant that is at 0.
Controller without_point(Controller controller);

// Of the states, inputs or outputs of a point, of which the first ones are given; nothing happens where it is empty.
Eigen::VectorXd in_own_units(Eigen::VectorXd deviations, const Eigen::VectorXd& point);
Eigen::VectorXd as_deviations(Eigen::VectorXd own, const Eigen::VectorXd& point);

// What the target could not add to a number without leaving its range.
void check_point(const Controller& controller, design::Findings& findings);

// The difference limit − point, where its sum with the point is `limit` as the target rounds both; else the deviation
// farthest from the point whose sum does not leave it. `limit` is in the plant's own units, `inward` −1 for the largest
// value and +1 for the smallest. Infinite where the limit is.
double deviation_limit(double limit, double point, int inward, bool is_double);

// The limits of u, and the ranges of the outputs, in the target's numbers, as deviations: of an output as the target
// rounds y − point, so that no y within its range is beyond.
Eigen::VectorXd input_limits(const Controller& controller, int inward);
Eigen::VectorXd output_range(const Controller& controller, int inward);
// What u is, in the plant's own units, where such a limit holds it.
Eigen::VectorXd input_limits_reached(const Controller& controller, int inward);

// The same in the plant's own units, not rounded: as the file states them.
const Eigen::VectorXd& own_input_limits(const Controller& controller, int inward);
const Eigen::VectorXd& own_output_range(const Controller& controller, int inward);
design::SoftLimits own_state_limits(const Controller& controller);
design::SoftLimits own_output_limits(const Controller& controller);

template <class S>
step::OperatingPoint<S> convert_point(const Point& point) {
  const auto convert = [](const Eigen::VectorXd& from) {
    step::Vector<S> to(from.size());
    for (Eigen::Index i = 0; i < from.size(); ++i) to(i) = S(from(i));
    return to;
  };
  return {convert(point.x), convert(point.u), convert(point.y), convert(point.r)};
}

}  // namespace lqg::controller
