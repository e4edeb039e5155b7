// SPDX-License-Identifier: MIT
#include "design/operating_point.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace lqg::design {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string entry(const std::string& list, Index i) {
  return "plant.operating_point." + list + "[" + std::to_string(i) + "]";
}

// Low and high are empty, or of each entry of the point.
void check_within(const VectorXd& point, const VectorXd& low, const VectorXd& high, const std::string& list,
                  const std::string& limits, Findings& findings) {
  for (Index i = 0; i < low.size(); ++i)
    if (point(i) < low(i) || point(i) > high(i))
      add_error(findings, entry(list, i),
                "expected a number within " + limits + ", " + decimal(low(i)) + " to " + decimal(high(i)) + ", found " +
                    decimal(point(i)));
}

void check_dropout(const Plant& plant, Findings& findings) {
  for (Index i = 0; i < plant.dropout.size(); ++i)
    if (plant.dropout(i) > 0 && plant.operating_point->y(i) != 0)
      add_error(findings, "plant.dropout",
                "expected 0 for " + plant.outputs[static_cast<std::size_t>(i)].name +
                    ", which is not 0 at the operating point: where C x drops out the sensor says 0, which is no "
                    "deviation from that point that a linear filter knows; let the output be NaN instead");
}

void less(VectorXd& own, const VectorXd& point) {
  if (own.size()) own -= point.head(own.size());
}

void less(SoftLimits& limits, const VectorXd& point) {
  if (limits.range.size()) limits.range.colwise() -= point;
}

// A reference begins at the operating point: a step or a ramp goes from there to its value, a sine is about it, and a
// column is what the reference is.
Course change_of_reference(Course course, double point) {
  if (course.times.empty()) {
    if (course.sine <= 0) course.value -= point;
    return course;
  }
  for (double& each : course.column) each = course.value * each - point;
  course.value = 1;
  return course;
}

void less(Scenario& scenario, const OperatingPoint& point) {
  less(scenario.x0, point.x);
  for (Course& course : scenario.reference) course = change_of_reference(course, point.y(course.signal));
  for (Course& course : scenario.input) course = change_of_reference(course, point.u(course.signal));
}

}  // namespace

void express_as_deviations(Problem& problem, Findings& findings) {
  if (!problem.plant.operating_point) return;
  OperatingPoint& point = *problem.plant.operating_point;
  check_dropout(problem.plant, findings);
  if (problem.limits) {
    point.u_min = problem.limits->u_min, point.u_max = problem.limits->u_max;
    check_within(point.u, point.u_min, point.u_max, "inputs", "limits.u_min and limits.u_max", findings);
    less(problem.limits->u_min, point.u), less(problem.limits->u_max, point.u);
    point.states_range = problem.limits->states.range, point.outputs_range = problem.limits->outputs.range;
    less(problem.limits->states, point.x), less(problem.limits->outputs, point.y);
  }
  if (problem.estimator) {
    point.output_min = problem.estimator->output_min, point.output_max = problem.estimator->output_max;
    check_within(point.y, point.output_min, point.output_max, "outputs", "kalman.output_min and kalman.output_max",
                 findings);
    less(problem.estimator->output_min, point.y), less(problem.estimator->output_max, point.y);
    if (problem.estimator->extended) problem.estimator->extended->own_x0 = problem.estimator->x0;
    less(problem.estimator->x0, point.x);
  }
  for (Scenario& scenario : problem.scenarios) less(scenario, point);
}

}  // namespace lqg::design
