// SPDX-License-Identifier: MIT
// What is shown of a design that has no scenarios.
#include <algorithm>
#include <cmath>

#include "design/rounding.hpp"
#include "simulate/scenario_run.hpp"

namespace lqg::simulate {

namespace {

using controller::Controller;
using design::Scenario;
using Eigen::Index;
using Eigen::VectorXd;

// 1, 2 or 5 times a power of ten, at most `value`.
double round_down(double value) {
  double power = std::pow(10, std::floor(std::log10(value)));
  if (power > value) power /= 10;
  return value >= 5 * power ? 5 * power : value >= 2 * power ? 2 * power : power;
}

// Until the slowest pole inside the circle has done 99 %; schedules and horizons are shown whole.
double sample_count(const Controller& controller) {
  constexpr double least = 40, most = 400;
  design::Poles poles = controller.solution.loop.poles;
  if (controller.solution.estimator && poles.empty()) poles = controller.solution.estimator->poles;
  double count = least;
  for (const std::complex<double>& pole : poles)
    if (std::abs(pole) < 1) count = std::max(count, std::log(0.01) / std::log(std::max(std::abs(pole), 1e-9)));
  return std::ceil(std::min(most, std::max(count, 1.25 * static_cast<double>(controller.last_sample))));
}

double reach_of(const design::Limits& limits, Index input) {
  if (!limits.u_min.size()) return design::forever;
  return std::min(std::abs(limits.u_min(input)), std::abs(limits.u_max(input)));
}

// Which the limits let through: of the largest share of its limit that an input takes, 1 without limits.
double share_of_limits(const Controller& controller, const std::vector<double>& peak_u) {
  double share = 0;
  if (controller.problem.limits)
    for (std::size_t i = 0; i < peak_u.size(); ++i) {
      const double reach = reach_of(*controller.problem.limits, static_cast<Index>(i));
      if (std::isfinite(reach) && reach > 0) share = std::max(share, peak_u[i] / reach);
    }
  return share;
}

// The largest value of an output that the weights accept, if they say one.
std::optional<double> accepted(const Controller& controller, int output) {
  const auto& regulator = controller.problem.regulator;
  if (!regulator || !regulator->bryson) return {};
  const design::Bryson& bryson = *regulator->bryson;
  if (bryson.outputs.size()) return bryson.outputs(output);
  const Eigen::MatrixXd& C = controller.problem.plant.C;
  double size = 0;
  for (Index j = 0; j < C.cols(); ++j) size += std::abs(C(output, j)) * bryson.states(j);
  if (size > 0) return size;
  return {};
}

// A step that the actuators can follow: half of what takes an input to its limit, in a plant that answers as one
// without limits does as long as none is reached.
double step_size(const Controller& controller, Scenario scenario) {
  constexpr double tried = 1e-3, wanted_share = 0.5;
  design::Course& course = scenario.reference.front();
  const double start = accepted(controller, course.signal).value_or(1);
  course.value = tried * start;
  const double share = share_of_limits(controller, run_scenario(controller, scenario).numbers.peak_u);
  return share > 0 ? round_down(std::min(start, course.value * wanted_share / share)) : round_down(start);
}

double load_size(const Controller& controller, Index input) {
  constexpr double share = 0.1;
  if (!controller.problem.limits) return 1;
  const double reach = reach_of(*controller.problem.limits, input);
  return std::isfinite(reach) && reach > 0 ? round_down(share * reach) : 1;
}

Scenario begun(const Controller& controller, const std::string& name, double periods) {
  Scenario scenario;
  scenario.name = name;
  scenario.duration = periods * controller.problem.plant.sample_time;
  return scenario;
}

Scenario step_of(const Controller& controller, int output) {
  constexpr double before = 0.1;  // of the time that is shown
  const double samples = sample_count(controller), T = controller.problem.plant.sample_time;
  const std::string& name = controller.problem.plant.outputs[static_cast<std::size_t>(output)].name;
  Scenario scenario = begun(controller, "step of " + name, samples * (1 + before));
  scenario.noise = false;
  design::Course course;
  course.signal = output;
  course.at = std::floor(samples * before) * T;
  scenario.reference = {course};
  scenario.reference.front().value = step_size(controller, scenario);
  return scenario;
}

Scenario load_on(const Controller& controller, int input) {
  const double samples = sample_count(controller), T = controller.problem.plant.sample_time;
  const std::string& name = controller.problem.plant.inputs[static_cast<std::size_t>(input)].name;
  Scenario scenario = begun(controller, "load on " + name, samples);
  scenario.noise = false;
  design::Course course;
  course.signal = input;
  course.value = load_size(controller, input);
  course.at = std::floor(samples * 0.1) * T;
  course.until = std::floor(samples * 0.5) * T;
  scenario.load = {course};
  return scenario;
}

// Its courses; a default scenario has one at most.
std::vector<design::Course*> courses_in(Scenario& scenario) {
  std::vector<design::Course*> courses;
  for (std::vector<design::Course>* list : {&scenario.reference, &scenario.load})
    for (design::Course& course : *list) courses.push_back(&course);
  return courses;
}

template <class Scenarios>
auto find_scenario(Scenarios& scenarios, const std::string& name) {
  return std::find_if(scenarios.begin(), scenarios.end(), [&](const Scenario& one) { return one.name == name; });
}

void take_times(Scenario& scenario, Scenario other) {
  const std::vector<design::Course*> own = courses_in(scenario), others = courses_in(other);
  if (own.size() != others.size()) return;
  scenario.duration = other.duration;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const int signal = own[i]->signal;  // of that name it may be another one there
    *own[i] = *others[i];
    own[i]->signal = signal;
  }
}

// Of two with the same name.
Scenario common_scenario(Scenario a, Scenario b) {
  Scenario& longer = a.duration >= b.duration ? a : b;
  const std::vector<design::Course*> in_a = courses_in(a), in_b = courses_in(b);
  for (std::size_t i = 0; i < std::min(in_a.size(), in_b.size()); ++i)
    in_a[i]->value = in_b[i]->value =
        std::abs(in_a[i]->value) <= std::abs(in_b[i]->value) ? in_a[i]->value : in_b[i]->value;
  return longer;
}

}  // namespace

std::vector<Scenario> scenarios_to_show(const Controller& controller, const std::vector<Scenario>& others) {
  std::vector<Scenario> shown = scenarios_to_show(controller);
  if (!controller.problem.scenarios.empty()) return shown;
  for (Scenario& scenario : shown)
    if (const auto other = find_scenario(others, scenario.name); other != others.end()) take_times(scenario, *other);
  return shown;
}

std::vector<Scenario> common_scenarios(const std::vector<std::vector<Scenario>>& of_designs) {
  std::vector<Scenario> common;
  for (const std::vector<Scenario>& scenarios : of_designs)
    for (const Scenario& scenario : scenarios) {
      const auto found = find_scenario(common, scenario.name);
      if (found == common.end())
        common.push_back(scenario);
      else
        *found = common_scenario(*found, scenario);
    }
  return common;
}

std::vector<Scenario> scenarios_to_show(const Controller& controller) {
  if (!controller.problem.scenarios.empty()) return controller.problem.scenarios;
  std::vector<Scenario> shown;
  for (const int output : controller.references) shown.push_back(step_of(controller, output));
  if (controller.has.regulator)
    for (int input = 0; input < controller.size.nu; ++input) shown.push_back(load_on(controller, input));
  if (controller.has.filter) shown.push_back(begun(controller, "noises", sample_count(controller)));
  return shown;
}

}  // namespace lqg::simulate
