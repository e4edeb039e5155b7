// SPDX-License-Identifier: MIT
// The controller at work: after a disturbance, and with its noises.
#include <algorithm>
#include <cmath>

#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"
#include "simulate/simulation.hpp"

namespace lqg::emit {

namespace {

// Until the slowest pole inside the circle has done 99 %; schedules and horizons are shown whole.
int sample_count(const Controller& controller) {
  constexpr double least = 40, most = 400;
  design::Poles poles = controller.solution.loop.poles;
  if (controller.solution.estimator && poles.empty()) poles = controller.solution.estimator->poles;
  double count = least;
  for (const std::complex<double>& pole : poles)
    if (std::abs(pole) < 1) count = std::max(count, std::log(0.01) / std::log(std::max(std::abs(pole), 1e-9)));
  return static_cast<int>(std::min(most, std::max(count, 1.25 * static_cast<double>(controller.last_sample))));
}

class SignalCharts {
 public:
  SignalCharts(const Controller& controller, const simulate::Trajectory& run, std::string prefix)
      : controller_(controller), run_(run), prefix_(std::move(prefix)) {
    for (int k = 0; k < samples(); ++k) time_.push_back(k * controller.problem.plant.sample_time);
  }

  // Each output, each input, each state with its estimate.
  std::vector<Chart> all(bool with_outputs) const {
    std::vector<Chart> charts;
    const auto& plant = controller_.problem.plant;
    for (std::size_t i = 0; i < plant.outputs.size() && with_outputs && controller_.has.filter; ++i)
      charts.push_back(chart(plant.outputs[i], "y", i, {{"", Mark::dots, 2, time_, row(run_.y, i)}}));
    for (std::size_t i = 0; i < plant.inputs.size() && controller_.has.regulator; ++i)
      charts.push_back(input(i));
    for (std::size_t i = 0; i < plant.states.size(); ++i) charts.push_back(state(i, plant.states[i]));
    return charts;
  }

 private:
  // A plant that nobody holds is shown until it has left.
  int samples() const {
    constexpr double far_away = 1e18;
    int k = 0;
    while (k < run_.estimate.cols() && run_.x.col(k).cwiseAbs().maxCoeff() < far_away) ++k;
    return k;
  }

  std::vector<double> row(const Eigen::MatrixXd& values, std::size_t i) const {
    std::vector<double> out;
    for (std::size_t k = 0; k < time_.size(); ++k)
      out.push_back(values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
    return out;
  }

  Chart chart(const design::Signal& signal, const char* kind, std::size_t i, std::vector<Curve> curves) const {
    Chart out;
    out.title = name_with_unit(signal);
    out.id = prefix_ + "-" + kind + std::to_string(i);
    out.group = prefix_;
    out.x.label = "t [s]";
    out.curves = std::move(curves);
    return out;
  }

  Chart input(std::size_t i) const {
    Chart out = chart(controller_.problem.plant.inputs[i], "u", i, {{"", Mark::steps, 3, time_, row(run_.u, i)}});
    add_limits(controller_, i, out);
    return out;
  }

  static void add_limits(const Controller& controller, std::size_t i, Chart& chart) {
    const auto& limits = controller.problem.limits;
    if (!limits || !limits->u_min.size()) return;
    for (const double at : {limits->u_min(static_cast<Eigen::Index>(i)), limits->u_max(static_cast<Eigen::Index>(i))})
      if (std::isfinite(at)) chart.guides.push_back({Guide::Axis::y, at, "limit"});
  }

  Chart state(std::size_t i, const design::Signal& signal) const {
    std::vector<Curve> curves = {{controller_.has.filter ? "state" : "", Mark::line, 0, time_, row(run_.x, i)}};
    if (controller_.has.filter) curves.push_back({"estimate", Mark::dashes, 1, time_, row(run_.estimate, i)});
    return chart(signal, "x", i, std::move(curves));
  }

  const Controller& controller_;
  const simulate::Trajectory& run_;
  std::string prefix_;
  std::vector<double> time_;
};

// A tenth of what the limits allow, or 1.
Eigen::VectorXd small_input(const Controller& controller) {
  Eigen::VectorXd u = Eigen::VectorXd::Ones(controller.size.nu);
  if (!controller.problem.limits || !controller.problem.limits->u_min.size()) return u;
  const design::Limits& limits = *controller.problem.limits;
  for (int i = 0; i < controller.size.nu; ++i) {
    const double reach = std::max(std::abs(limits.u_min(i)), std::abs(limits.u_max(i)));
    if (std::isfinite(reach)) u(i) = reach / 10;
  }
  return u;
}

Eigen::VectorXd after(const design::SampledPlant& plant, const Eigen::VectorXd& u) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.A.rows());
  for (int i = 0; i < x.size(); ++i)
    for (int j = 0; j < u.size(); ++j) x(i) += design::to_double(plant.B(i, j)) * u(j);
  return x;
}

std::string in_words(const Controller& controller, const Eigen::VectorXd& u) {
  std::string words;
  for (int i = 0; i < u.size(); ++i) {
    const design::Signal& input = controller.problem.plant.inputs[static_cast<std::size_t>(i)];
    words += (i ? ", " : "") + input.name + " = " + with_unit(u(i), input.unit);
  }
  return words;
}

PageView after_a_kick(const Controller& controller) {
  const Eigen::VectorXd u = small_input(controller);
  simulate::SimulationOptions options;
  options.samples = sample_count(controller);
  options.noise = false;
  options.x0 = after(plant_at(controller, 0), u);
  const simulate::Trajectory run = simulate::simulate(controller, options);
  PageView view;
  view.name = "After a kick";
  view.charts = SignalCharts(controller, run, "kick").all(false);
  view.caption = "From the state that " + in_words(controller, u) + " for one sample leaves; without noise.";
  return view;
}

PageView with_noise(const Controller& controller) {
  simulate::SimulationOptions options;
  options.samples = sample_count(controller);
  options.r = Eigen::VectorXd::Ones(controller.size.nr);
  const simulate::Trajectory run = simulate::simulate(controller, options);
  PageView view;
  view.name = "With noise";
  view.charts = SignalCharts(controller, run, "noise").all(true);
  view.caption = std::string("With the noises of the design") + (controller.size.nr ? " and r = 1." : ".");
  return view;
}

}  // namespace

PageSection at_work(const Controller& controller) {
  PageSection section = {"at-work", "At work", {}};
  if (controller.has.regulator) section.views.push_back(after_a_kick(controller));
  if (controller.has.filter || controller.size.nr) section.views.push_back(with_noise(controller));
  return section;
}

}  // namespace lqg::emit
