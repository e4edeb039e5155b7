// SPDX-License-Identifier: MIT
#include "simulate/courses.hpp"

#include <algorithm>
#include <cmath>

#include "design/numeric/digits.hpp"
#include "design/rounding.hpp"

namespace lqg::simulate {

namespace {

using design::Course;
using Eigen::Index;

// sin(2π frequency t) by many digits: the host's own is not the same everywhere.
double sine(double frequency, double t) {
  const design::Digits digits(40);
  const design::Real turns = design::Real(frequency) * t;
  const design::Real angle = 2 * acos(design::Real(-1)) * (turns - floor(turns));
  return design::to_double(sin(angle));
}

// What holds at `since` seconds after its start; the entry of a column that is not later.
double entry_at(const Course& course, double since) {
  const auto later = std::upper_bound(course.times.begin(), course.times.end(), since);
  return later == course.times.begin() ? 0 : course.column[static_cast<std::size_t>(later - course.times.begin() - 1)];
}

double value_at(const Course& course, double since) {
  if (!course.times.empty()) return course.value * entry_at(course, since);
  if (course.sine > 0) return course.value * sine(course.sine, since);
  if (course.ramp > 0) return course.value * std::min(1.0, since / course.ramp);
  return course.value;
}

void add_course(const Course& course, Index row, double sample_time, Eigen::MatrixXd& to) {
  const int samples = static_cast<int>(to.cols());
  const int end = first_sample(course.until, sample_time, samples);
  const double slack = 1e-9 * sample_time;  // a time of a file is not exactly a multiple of the sample time
  for (int k = first_sample(course.at, sample_time, samples); k < end; ++k)
    to(row, k) += value_at(course, std::max(0.0, k * sample_time - course.at) + slack);
}

Eigen::MatrixXd sum_of(const std::vector<Course>& courses, Index rows, double sample_time, int samples) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows, samples);
  for (const Course& course : courses) add_course(course, course.signal, sample_time, sum);
  return sum;
}

}  // namespace

int first_sample(double time, double sample_time, int samples) {
  const double sample = std::ceil(time / sample_time - 1e-9);
  return sample < samples ? static_cast<int>(sample) : samples;
}

int samples_of(const controller::Controller& controller, const design::Scenario& scenario) {
  return std::max(1, static_cast<int>(std::lround(scenario.duration / controller.problem.plant.sample_time)));
}

Courses courses_of(const controller::Controller& controller, const design::Scenario& scenario) {
  const double T = controller.problem.plant.sample_time;
  const int samples = samples_of(controller, scenario);
  Courses result;
  result.reference = Eigen::MatrixXd::Zero(controller.size.nr, samples);
  for (const Course& course : scenario.reference) {
    const auto found = std::find(controller.references.begin(), controller.references.end(), course.signal);
    if (found != controller.references.end())
      add_course(course, found - controller.references.begin(), T, result.reference);
  }
  const Index nu = controller.problem.plant.B.cols(), nx = controller.problem.plant.A.rows();
  result.load = sum_of(scenario.load, nu, T, samples);
  result.state_load = sum_of(scenario.state_load, nx, T, samples);
  result.input = sum_of(scenario.input, nu, T, samples);
  return result;
}

}  // namespace lqg::simulate
