// SPDX-License-Identifier: MIT
#include "simulate/scenario_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "controller/operating_point.hpp"

namespace lqg::simulate {

namespace {

using controller::Controller;
using design::Course;
using design::Scenario;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr double settled_within = 0.02, rise_from = 0.1, rise_to = 0.9;  // of a step

std::vector<double> rms_of(const MatrixXd& values) {
  std::vector<double> out;
  for (Index i = 0; i < values.rows(); ++i) {
    double sum = 0;
    for (Index k = 0; k < values.cols(); ++k) sum += values(i, k) * values(i, k);
    out.push_back(values.cols() ? std::sqrt(sum / static_cast<double>(values.cols())) : 0);
  }
  return out;
}

std::vector<double> peak_of(const MatrixXd& values) {
  std::vector<double> out;
  for (Index i = 0; i < values.rows(); ++i) out.push_back(values.cols() ? values.row(i).cwiseAbs().maxCoeff() : 0);
  return out;
}

// At u_min or u_max, or as far from the u before as u_rate lets it.
std::vector<double> share_at_limits(const Controller& controller, const MatrixXd& u) {
  std::vector<double> out(static_cast<std::size_t>(u.rows()), 0);
  if (!controller.problem.limits || u.cols() == 0) return out;
  const design::Limits& limits = *controller.problem.limits;
  const Eigen::VectorXd start = controller::in_own_units(Eigen::VectorXd::Zero(u.rows()), controller.point.u);
  const double epsilon = controller.target.is_double ? 0x1p-52 : 0x1p-23;
  const bool is_limited = limits.u_min.size() > 0;
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(u.rows(), design::forever);
  const Eigen::VectorXd low = is_limited ? controller::input_limits_reached(controller, +1) : Eigen::VectorXd(-none);
  const Eigen::VectorXd high = is_limited ? controller::input_limits_reached(controller, -1) : none;
  for (Index i = 0; i < u.rows(); ++i) {
    const double step =
        limits.u_rate.size() ? limits.u_rate(i) * controller.problem.plant.sample_time : design::forever;
    Index count = 0;
    for (Index k = 0; k < u.cols(); ++k) {
      const double change = std::abs(u(i, k) - (k ? u(i, k - 1) : start(i)));
      const double rounding = controller.point.u.size() > 0 ? 2 * epsilon * std::abs(u(i, k)) : 0;
      count += u(i, k) <= low(i) || u(i, k) >= high(i) || change >= step * (1 - 1e-6) - rounding;
    }
    out[static_cast<std::size_t>(i)] = static_cast<double>(count) / static_cast<double>(u.cols());
  }
  return out;
}

// Samples in which something else happens than a step of this output's reference: until then its answer is looked at.
std::set<int> events_of(const Scenario& scenario, int output, double T, int samples) {
  std::set<int> events = {samples};
  const auto add = [&](double time) { events.insert(first_sample(time, T, samples)); };
  for (const std::vector<Course>* courses : {&scenario.load, &scenario.state_load})
    for (const Course& course : *courses) add(course.at), add(course.until);
  for (const Course& course : scenario.reference)
    if (course.signal == output || course.ramp > 0 || course.sine > 0 || !course.times.empty())
      add(course.at), add(course.until);
  for (const design::DropOut& gap : scenario.dropout) add(gap.from), add(gap.until);
  for (const design::Outlier& outlier : scenario.outlier) add(outlier.at);
  return events;
}

bool is_step(const Course& course) { return course.ramp <= 0 && course.sine <= 0 && course.times.empty(); }

// The output over time, between the samples too where it is known.
struct Curve {
  std::vector<double> t, y;  // y from the moment of the step on, 0 at its start and 1 at its end
};

Curve normalised(const ScenarioRun& run, int output, double from, double to, int begin, int end) {
  Curve curve;
  const bool is_fine = run.fine_times.size() > 0;
  const Index each = is_fine ? run.fine_times.size() / run.times.size() : 1;
  const Eigen::VectorXd& times = is_fine ? run.fine_times : run.times;
  const MatrixXd& outputs = is_fine ? run.fine_outputs : run.outputs;
  for (Index k = begin * each; k < end * each; ++k) {
    curve.t.push_back(times(k) - times(begin * each));
    curve.y.push_back((outputs(output, k) - from) / (to - from));
  }
  return curve;
}

StepAnswer answer_of(const Curve& curve) {
  StepAnswer answer;
  std::optional<double> left, arrived;
  for (std::size_t k = 0; k < curve.t.size(); ++k) {
    const double y = curve.y[k];
    if (!left && y >= rise_from) left = curve.t[k];
    if (!arrived && y >= rise_to) arrived = curve.t[k];
    answer.overshoot = std::max(answer.overshoot, y - 1);
    if (!(std::abs(y - 1) <= settled_within))
      answer.settling_time.reset();
    else if (!answer.settling_time)
      answer.settling_time = curve.t[k];
  }
  if (left && arrived) answer.rise_time = *arrived - *left;
  return answer;
}

std::vector<StepAnswer> answers_of(const PreparedScenario& prepared, const ScenarioRun& run) {
  std::vector<StepAnswer> out;
  const std::vector<int>& references = prepared.controller.references;
  const double T = prepared.truth.T;
  const int samples = static_cast<int>(run.times.size());
  std::set<std::pair<int, int>> seen;  // output, sample: several courses may step at once
  for (const Course& course : prepared.scenario.reference) {
    if (!is_step(course)) continue;
    const auto row = std::find(references.begin(), references.end(), course.signal) - references.begin();
    for (const double time : {course.at, course.until}) {
      const int begin = first_sample(time, T, samples);
      if (begin >= samples || !seen.insert({course.signal, begin}).second) continue;
      const Eigen::VectorXd& start = prepared.controller.point.r;
      const double from = begin ? run.r(row, begin - 1) : start.size() ? start(row) : 0, to = run.r(row, begin);
      if (from == to) continue;
      const int end = *events_of(prepared.scenario, course.signal, T, samples).upper_bound(begin);
      StepAnswer answer = answer_of(normalised(run, course.signal, from, to, begin, end));
      answer.output = course.signal;
      answer.at = run.times(begin), answer.from = from, answer.to = to;
      out.push_back(answer);
    }
  }
  std::sort(out.begin(), out.end(), [](const StepAnswer& a, const StepAnswer& b) {
    return std::pair(a.at, a.output) < std::pair(b.at, b.output);
  });
  return out;
}

// Of so many samples.
MatrixXd from_point(const MatrixXd& own, const Eigen::VectorXd& point) {
  if (point.size() == 0) return own;
  return own.colwise() - point.head(own.rows());
}

}  // namespace

void count_numbers(const PreparedScenario& prepared, ScenarioRun& run) {
  ScenarioNumbers& numbers = run.numbers;
  const controller::Point point = controller::stated_point(prepared.controller);
  const MatrixXd x = from_point(run.x, point.x), u = from_point(run.u, point.u), y = from_point(run.outputs, point.y);
  numbers.rms_x = rms_of(x), numbers.peak_x = peak_of(x);
  numbers.rms_u = rms_of(u), numbers.peak_u = peak_of(u);
  numbers.rms_y = rms_of(y), numbers.peak_y = peak_of(y);
  numbers.share_at_limits = share_at_limits(prepared.controller, run.u);
  numbers.answers = answers_of(prepared, run);
  for (Index i = 0; i < run.left_out.rows(); ++i)
    numbers.left_out.push_back(static_cast<unsigned long>(run.left_out.row(i).count()));
}

}  // namespace lqg::simulate
