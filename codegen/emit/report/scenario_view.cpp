// SPDX-License-Identifier: MIT
#include "emit/report/scenario_view.hpp"

#include <algorithm>
#include <cmath>

#include "controller/operating_point.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"
#include "simulate/courses.hpp"

namespace lqg::emit {

namespace {

using Eigen::Index;
using Values = std::vector<double>;

Values values_of(const Eigen::MatrixXd& matrix, Index row) {
  Values out;
  for (Index k = 0; k < matrix.cols(); ++k) out.push_back(matrix(row, k));
  return out;
}

// A name as an id; two names never have one id.
std::string slug(const std::string& name) {
  static const char* const digits = "0123456789abcdef";
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_plain)
      out += c;
    else if (c == ' ')
      out += '-';
    else
      (out += '_') += {digits[byte >> 4], digits[byte & 15]};
  }
  return out;
}

bool nothing_happens(const Chart& chart) {
  for (const Curve& curve : chart.curves)
    for (const double y : curve.y)
      if (y != 0) return false;
  return chart.events.empty();
}

// Of an output that was not used: only the gate did not believe it.
bool is_gated(const simulate::ScenarioRun& run, Index sample, int output) {
  return run.has(sample, step::Event::output_gated) && !run.has(sample, step::rejection_of(output));
}

class ScenarioCharts {
 public:
  ScenarioCharts(const Controller& controller, const ShownRun& shown)
      : controller_(controller), scenario_(shown.scenario), run_(shown.run), prefix_("run-" + slug(shown.run.name)),
        times_(shown.run.times.begin(), shown.run.times.end()),
        fine_times_(shown.run.fine_times.begin(), shown.run.fine_times.end()) {}

  std::vector<Chart> all() const {
    std::vector<Chart> charts;
    const design::Plant& plant = controller_.problem.plant;
    for (std::size_t i = 0; i < plant.outputs.size() && controller_.has.filter; ++i) charts.push_back(output(i));
    for (std::size_t i = 0; i < plant.inputs.size() && run_.u.rows() > 0; ++i) charts.push_back(input(i));
    for (std::size_t i = 0; i < plant.states.size(); ++i) charts.push_back(state(i));
    add_disturbances(charts);
    const auto end = std::remove_if(charts.begin(), charts.end(), nothing_happens);
    if (end != charts.begin()) charts.erase(end, charts.end());
    return charts;
  }

 private:
  Chart chart(const design::Signal& signal, const std::string& kind, std::size_t i) const {
    Chart out;
    out.title = name_with_unit(signal);
    out.id = prefix_ + "-" + kind + std::to_string(i);
    out.group = prefix_;
    out.x.label = "t [s]";
    for (Index k = 0; k < run_.times.size(); ++k) {
      if (run_.has(k, step::Event::state_reset)) out.events.push_back({run_.times(k), "reset"});
      if (run_.has(k, step::Event::covariance_reset)) out.events.push_back({run_.times(k), "reset of the covariance"});
      if (run_.has(k, step::Event::not_optimal)) out.events.push_back({run_.times(k), "limits that cannot be kept"});
    }
    return out;
  }

  // Between the samples, too, where the run has that.
  Curve true_curve(const std::string& label, const Eigen::MatrixXd& fine, const Eigen::MatrixXd& sampled,
                   Index row) const {
    const bool is_fine = fine.cols() > 0;
    return {label, Mark::line, 0, is_fine ? fine_times_ : times_, values_of(is_fine ? fine : sampled, row)};
  }

  Chart output(std::size_t i) const {
    const auto row = static_cast<Index>(i);
    Chart out = chart(controller_.problem.plant.outputs[i], "y", i);
    if (scenario_.noise || !scenario_.sensor.empty() || !scenario_.outlier.empty())
      out.curves.push_back({"measured", Mark::dots, 2, times_, values_of(run_.y, row)});
    out.curves.push_back(true_curve("true", run_.fine_outputs, run_.outputs, row));
    for (std::size_t j = 0; j < controller_.references.size(); ++j)
      if (controller_.references[j] == static_cast<int>(i) && run_.r.rows() > static_cast<Index>(j))
        out.curves.push_back({"reference", Mark::steps, 6, times_, values_of(run_.r, static_cast<Index>(j))});
    for (Index k = 0; k < run_.times.size(); ++k)
      if (run_.left_out(row, k))
        out.events.push_back({run_.times(k), is_gated(run_, k, static_cast<int>(i)) ? "gated" : "left out"});
    add_sensor_limits(i, out);
    if (controller_.has.foresight) add_soft_limits(controller::own_output_limits(controller_), row, out);
    // An outlier does not make the rest small.
    if (!scenario_.outlier.empty()) look_at_truth(out);
    return out;
  }

  void add_sensor_limits(std::size_t i, Chart& out) const {
    const auto add = [&](double at) {
      if (std::isfinite(at)) out.guides.push_back({Guide::Axis::y, at, "limit of the sensor"});
    };
    if (const auto& estimator = controller_.problem.estimator; estimator && estimator->output_min.size() > 0) {
      add(controller::own_output_range(controller_, +1)(static_cast<Index>(i)));
      add(controller::own_output_range(controller_, -1)(static_cast<Index>(i)));
    }
    for (const design::Sensor& sensor : scenario_.sensor)
      if (sensor.output == static_cast<int>(i)) add(sensor.min), add(sensor.max);
  }

  static void look_at_truth(Chart& out) {
    Chart truth = out;
    truth.curves.erase(std::remove_if(truth.curves.begin(), truth.curves.end(),
                                      [](const Curve& curve) { return curve.label == "measured"; }),
                       truth.curves.end());
    const Window window = window_of(truth);
    const double room = (window.y_high - window.y_low) / 2;
    out.y_low = window.y_low - room, out.y_high = window.y_high + room;
  }

  Chart input(std::size_t i) const {
    const auto row = static_cast<Index>(i);
    Chart out = chart(controller_.problem.plant.inputs[i], "u", i);
    out.curves = {{"u", Mark::steps, 3, times_, values_of(run_.u, row)}};
    const auto& limits = controller_.problem.limits;
    if (!limits || limits->u_min.size() == 0) return out;
    const double low = controller::own_input_limits(controller_, +1)(row),
                 high = controller::own_input_limits(controller_, -1)(row);
    if (std::isfinite(low) && std::isfinite(high) && !times_.empty())
      out.bands.push_back({"within limits", 3, {times_.front(), times_.back()}, {low, low}, {high, high}});
    for (const double at : {low, high})
      if (std::isfinite(at)) out.guides.push_back({Guide::Axis::y, at, "limit"});
    add_samples_at_limits(row, low, high, out);
    return out;
  }

  static void add_soft_limits(const design::SoftLimits& limits, Index row, Chart& out) {
    for (Index side = 0; side < 2 && row < limits.range.rows(); ++side)
      if (std::isfinite(limits.range(row, side)))
        out.guides.push_back({Guide::Axis::y, limits.range(row, side), "soft limit"});
  }

  void add_samples_at_limits(Index row, double low, double high, Chart& out) const {
    Curve at_limit = {"at a limit", Mark::rings, 1, {}, {}};
    const double slack = 1e-6 * (high - low);  // u has the target's digits
    for (Index k = 0; k < run_.u.cols(); ++k)
      if (run_.has(k, step::Event::input_limited) && (run_.u(row, k) >= high - slack || run_.u(row, k) <= low + slack))
        at_limit.x.push_back(run_.times(k)), at_limit.y.push_back(run_.u(row, k));
    if (!at_limit.x.empty()) out.curves.push_back(std::move(at_limit));
  }

  Chart state(std::size_t i) const {
    const auto row = static_cast<Index>(i);
    Chart out = chart(controller_.problem.plant.states[i], "x", i);
    out.curves = {true_curve(controller_.has.filter ? "true" : "x", run_.fine_x, run_.x, row)};
    if (controller_.has.foresight) add_soft_limits(controller::own_state_limits(controller_), row, out);
    if (!controller_.has.filter) return out;
    out.curves.push_back({"estimate", Mark::dashes, 1, times_, values_of(run_.estimate, row)});
    if (run_.sigma.rows() <= row) return out;
    Band band = {"±3σ", 1, times_, {}, {}};
    for (Index k = 0; k < run_.sigma.cols(); ++k) {
      band.low.push_back(run_.estimate(row, k) - 3 * run_.sigma(row, k));
      band.high.push_back(run_.estimate(row, k) + 3 * run_.sigma(row, k));
    }
    out.bands.push_back(std::move(band));
    return out;
  }

  // The loads of these inputs, and what the filter says of them.
  void add_disturbances(std::vector<Chart>& charts) const {
    if (!controller_.problem.estimator || controller_.problem.estimator->disturbance.empty()) return;
    const std::vector<design::Signal> states = state_signals(controller_);
    const Eigen::MatrixXd loads = simulate::courses_of(controller_, scenario_).load.leftCols(run_.times.size());
    std::size_t i = controller_.problem.plant.states.size();
    for (const design::InputDisturbance& disturbance : controller_.problem.estimator->disturbance) {
      Chart out = chart(states[i], "x", i);
      out.curves = {{"load", Mark::steps, 0, times_, values_of(loads, disturbance.input)},
                    {"estimate", Mark::dashes, 1, times_, values_of(run_.estimate, static_cast<Index>(i))}};
      charts.push_back(std::move(out));
      ++i;
    }
  }

  const Controller& controller_;
  const design::Scenario& scenario_;
  const simulate::ScenarioRun& run_;
  std::string prefix_;
  Values times_, fine_times_;
};

}  // namespace

std::vector<ShownRun> runs_to_show(const Controller& controller) {
  std::vector<ShownRun> out;
  for (design::Scenario& scenario : simulate::scenarios_to_show(controller)) {
    simulate::ScenarioRun run = simulate::run_scenario(controller, scenario);
    out.push_back({std::move(scenario), std::move(run)});
  }
  return out;
}

PageView scenario_view(const Controller& controller, const ShownRun& shown) {
  PageView view;
  view.name = shown.run.name;
  view.charts = ScenarioCharts(controller, shown).all();
  if (shown.run.numbers.has_diverged) view.text = "A state left all bounds: the rest is not shown.";
  view.caption = shown.scenario.noise ? "With the noises of the design." : "Without noise.";
  view.tables = number_tables(controller, shown.run);
  return view;
}

}  // namespace lqg::emit
