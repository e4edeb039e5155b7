// SPDX-License-Identifier: MIT
#include "emit/report/report_charts.hpp"

#include <algorithm>
#include <cmath>

#include "design/loop/open_loop.hpp"
#include "design/numeric/response.hpp"
#include "design/rounding.hpp"
#include "emit/text/wording.hpp"
#include "simulate/simulation.hpp"

namespace lqg::emit {

namespace {

Curve pole_curve(const char* label, int colour, const design::Poles& poles) {
  Curve curve = {label, Mark::crosses, colour, {}, {}};
  for (const std::complex<double>& pole : poles) {
    curve.x.push_back(pole.real());
    curve.y.push_back(pole.imag());
  }
  return curve;
}

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
  SignalCharts(const Controller& controller, const simulate::Trajectory& run) : controller_(controller), run_(run) {
    for (int k = 0; k < samples(); ++k) time_.push_back(k * controller.problem.plant.sample_time);
  }

  // Each state, with its estimate; then each output, each input.
  std::vector<Chart> all(bool with_outputs) const {
    std::vector<Chart> charts;
    const auto& plant = controller_.problem.plant;
    for (std::size_t i = 0; i < plant.states.size(); ++i) charts.push_back(state(static_cast<int>(i), plant.states[i]));
    for (std::size_t i = 0; i < plant.outputs.size() && with_outputs && controller_.has.filter; ++i)
      charts.push_back(chart(plant.outputs[i], {{"", Mark::dots, 2, time_, row(run_.y, static_cast<int>(i))}}));
    for (std::size_t i = 0; i < plant.inputs.size() && controller_.has.regulator; ++i)
      charts.push_back(chart(plant.inputs[i], {{"", Mark::steps, 3, time_, row(run_.u, static_cast<int>(i))}}));
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

  std::vector<double> row(const Eigen::MatrixXd& values, int i) const {
    std::vector<double> out;
    for (std::size_t k = 0; k < time_.size(); ++k) out.push_back(values(i, static_cast<Eigen::Index>(k)));
    return out;
  }

  Chart chart(const design::Signal& signal, std::vector<Curve> curves) const {
    Chart out;
    out.title = name_with_unit(signal);
    out.x_label = "t [s]";
    out.curves = std::move(curves);
    return out;
  }

  Chart state(int i, const design::Signal& signal) const {
    std::vector<Curve> curves = {{controller_.has.filter ? "state" : "", Mark::line, 0, time_, row(run_.x, i)}};
    if (controller_.has.filter) curves.push_back({"estimate", Mark::dashes, 1, time_, row(run_.estimate, i)});
    return chart(signal, std::move(curves));
  }

  const Controller& controller_;
  const simulate::Trajectory& run_;
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

}  // namespace

std::vector<NamedPoles> poles_to_show(const Controller& controller) {
  const design::Solution& solution = controller.solution;
  if (solution.regulator && solution.estimator &&
      !design::is_separated(controller.problem, design::final_plant(solution)))
    return {{"loop", &solution.loop.poles}};
  std::vector<NamedPoles> shown;
  if (solution.regulator) shown.push_back({"regulator", &solution.regulator->poles});
  if (solution.estimator) shown.push_back({"estimator", &solution.estimator->poles});
  return shown;
}

Chart pole_chart(const Controller& controller) {
  Chart chart;
  chart.title = "Poles in the z plane";
  chart.is_square = true;
  chart.circles.push_back({0, 0, 1});
  int colour = 0;
  for (const auto& [owner, poles] : poles_to_show(controller))
    chart.curves.push_back(pole_curve(owner, colour++, *poles));
  double reach = 1.1;
  for (const Curve& curve : chart.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) reach = std::max(reach, 1.1 * std::hypot(curve.x[i], curve.y[i]));
  chart.x_low = chart.y_low = -reach;
  chart.x_high = chart.y_high = reach;
  return chart;
}

std::vector<Chart> nyquist_charts(const Controller& controller) {
  constexpr int points = 2000;
  constexpr double reach = 3;
  const std::optional<double>& disk = controller.solution.loop.at_input.disk;
  if (!disk || controller.size.nu != 1) return {};
  const design::Digits digits(50);
  const design::OpenLoop loop =
      design::open_at_inputs(design::measured_plant(controller.problem, design::final_plant(controller.solution)),
                             design::compensator(controller.problem, controller.solution));
  const design::Response response(loop.A, loop.B, loop.C);
  Chart chart;
  chart.title = "The loop opened at " + controller.problem.plant.inputs.front().name + ", L(e^jωT)";
  chart.is_square = true;
  chart.x_low = chart.y_low = -reach;
  chart.x_high = chart.y_high = reach;
  // |S − T| < 2/d keeps L out of the circle through −(2 + d)/(2 − d) and −(2 − d)/(2 + d).
  const double far = (2 + *disk) / (2 - *disk), near = 1 / far;
  if (*disk < 2) chart.circles.push_back({-(far + near) / 2, 0, (far - near) / 2});
  Curve curve = {"", Mark::line, 0, {}, {}}, critical = {"", Mark::crosses, 1, {-1}, {0}};
  const double pi = std::acos(-1.0);
  for (int side = -1; side <= 1; side += 2)
    for (int k = 1; k <= points; ++k) {  // frequencies spread evenly in their logarithm, over five decades
      const double angle = pi * std::pow(10, -5.0 * (side < 0 ? points - k : k - 1) / (points - 1));
      const design::ComplexMatrix value = response.roughly_at(design::Real(side * angle));
      curve.x.push_back(design::to_double(value.re(0, 0)));
      curve.y.push_back(design::to_double(value.im(0, 0)));
    }
  chart.curves = {curve, critical};
  return {chart};
}

Kick kick_charts(const Controller& controller) {
  if (!controller.has.regulator) return {};
  const Eigen::VectorXd u = small_input(controller);
  simulate::SimulationOptions options;
  options.samples = sample_count(controller);
  options.noise = false;
  options.x0 = after(plant_at(controller, 0), u);
  const simulate::Trajectory run = simulate::simulate(controller, options);
  Kick kick;
  for (int i = 0; i < u.size(); ++i) {
    const design::Signal& input = controller.problem.plant.inputs[static_cast<std::size_t>(i)];
    kick.words += (i ? ", " : "") + input.name + " = " + decimal(u(i)) + (input.unit.empty() ? "" : " " + input.unit);
  }
  kick.charts = SignalCharts(controller, run).all(false);
  return kick;
}

std::vector<Chart> noisy_charts(const Controller& controller) {
  if (!controller.has.filter && !controller.size.nr) return {};
  simulate::SimulationOptions options;
  options.samples = sample_count(controller);
  options.r = Eigen::VectorXd::Ones(controller.size.nr);
  const simulate::Trajectory run = simulate::simulate(controller, options);
  return SignalCharts(controller, run).all(true);
}

}  // namespace lqg::emit
