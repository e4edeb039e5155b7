// SPDX-License-Identifier: MIT
// Poles in the z plane, their table.
#include <algorithm>
#include <cmath>

#include "design/loop/compensator.hpp"
#include "design/sampled/added_states.hpp"
#include "design/numeric/poles.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/continuous_pole.hpp"

namespace lqg::emit {

namespace {

constexpr double half_turn = 3.14159265358979323846;

std::string damping_of(const std::complex<double>& pole, double sample_time) {
  const std::optional<ContinuousPole> found = continuous_pole(pole, sample_time);
  return found ? decimal(found->damping) : "";
}

std::string frequency_of(const std::complex<double>& pole, double sample_time) {
  const double angle = std::abs(std::arg(pole));
  return angle == 0 ? "" : with_unit(angle / (2 * half_turn * sample_time), "Hz");
}

std::string time_constant_of(const std::complex<double>& pole, double sample_time) {
  const double size = std::abs(pole);
  if (size < 1e-12) return "0 s";
  if (std::abs(size - 1) < 1e-12) return "∞";
  return with_unit(-sample_time / std::log(size), "s");
}

std::string continuous_of(const std::complex<double>& pole, double sample_time) {
  const std::optional<ContinuousPole> found = continuous_pole(pole, sample_time);
  if (!found) return "";
  return decimal(found->s.real()) + (found->s.imag() > 0 ? " ± " + decimal(found->s.imag()) + "i" : "");
}

// Poles that read the same are one row.
void add_pole(const std::string& owner, std::vector<std::string> cells, PageTable& table) {
  int times = 1;
  if (!table.rows.empty() && std::equal(cells.begin(), cells.end(), table.rows.back().begin() + 1)) {
    const std::string& before = table.rows.back().front();
    if (before == owner) times = 2;
    if (before.rfind(owner + ", ", 0) == 0) times = std::stoi(before.substr(owner.size() + 2)) + 1;
  }
  if (times > 1) table.rows.pop_back();
  cells.insert(cells.begin(), times > 1 ? owner + ", " + std::to_string(times) + " times" : owner);
  table.rows.push_back(std::move(cells));
}

PageTable pole_table(const std::vector<NamedPoles>& shown, double T) {
  PageTable table = {"", {"", "z", "|z|", "s = ln(z)/T, rad/s", "damping", "time constant", "frequency"}, {}};
  for (const auto& [owner, poles] : shown)
    for (const std::complex<double>& pole : poles) {
      if (pole.imag() < 0) continue;  // stands with its conjugate
      const std::vector<std::string> cells = {
          decimal(pole.real()) + (pole.imag() > 0 ? " ± " + decimal(pole.imag()) + "i" : ""),
          decimal(std::abs(pole)),
          continuous_of(pole, T),
          damping_of(pole, T),
          time_constant_of(pole, T),
          frequency_of(pole, T)};
      add_pole(owner, cells, table);
    }
  return table;
}

struct Look {
  Mark mark;
  int colour;
};

// Told apart by shape and colour.
Look look_of(const std::string& owner) {
  if (owner == "estimator") return {Mark::rings, 1};
  if (owner == "plant") return {Mark::pluses, 2};
  return {Mark::crosses, 0};
}

Curve curve_of_poles(const std::string& owner, const design::Poles& poles, double sample_time) {
  const Look look = look_of(owner);
  Curve curve = {owner, look.mark, look.colour, {}, {}};
  for (const std::complex<double>& pole : poles) {
    curve.x.push_back(pole.real());
    curve.y.push_back(pole.imag());
    const std::string damping = damping_of(pole, sample_time), f = frequency_of(pole, sample_time);
    curve.texts.push_back((damping.empty() ? "" : "damping " + damping + ", ") + time_constant_of(pole, sample_time) +
                          (f.empty() ? "" : ", " + f));
  }
  return curve;
}

// z = e^(sT) for s of one damping, with the angle of frequency from 0 to that of the half circle.
Curve line_of_damping(double damping, double side, double reach) {
  Curve curve = {"", Mark::line, 0, {}, {}, Role::grid};
  const double last = std::min(half_turn / std::sqrt(1 - damping * damping), reach);
  for (int k = 0; k <= 60; ++k) {
    const double w = last * k / 60;
    const double size = std::exp(-damping * w), angle = side * w * std::sqrt(1 - damping * damping);
    curve.x.push_back(size * std::cos(angle));
    curve.y.push_back(size * std::sin(angle));
  }
  return curve;
}

// z = e^(sT) for s of one natural frequency, |s| T = w.
Curve line_of_frequency(double w) {
  Curve curve = {"", Mark::line, 0, {}, {}, Role::grid};
  for (int k = 0; k <= 60; ++k) {
    const double of_s = half_turn / 2 + half_turn * k / 60;  // the left half plane, from top to bottom
    const double angle = w * std::sin(of_s);
    if (std::abs(angle) > half_turn) {  // beyond what samples show
      curve.x.push_back(NAN);
      curve.y.push_back(NAN);
      continue;
    }
    curve.x.push_back(std::exp(w * std::cos(of_s)) * std::cos(angle));
    curve.y.push_back(std::exp(w * std::cos(of_s)) * std::sin(angle));
  }
  return curve;
}

// 1, 2 or 5 times a power of ten: at most `most` of them up to this frequency.
std::vector<double> round_frequencies(double highest, int most) {
  const double power = std::pow(10, std::floor(std::log10(highest)));
  std::vector<double> out;
  for (const double of : {power, power / 10})
    for (const double step : {5.0, 2.0, 1.0})
      if (step * of <= highest && static_cast<int>(out.size()) < most) out.push_back(step * of);
  return out;
}

// Lines of damping 0.1 to 0.9 and of round frequencies within `reach` of z = 1, with words beside them.
void add_grid(double reach, double sample_time, Chart& chart) {
  for (int tenth = 1; tenth <= 9; tenth += 2)
    for (const double side : {1.0, -1.0}) chart.curves.push_back(line_of_damping(tenth / 10.0, side, 3 * reach));
  const double highest = std::min(reach, half_turn) / (2 * half_turn * sample_time);
  for (const double f : round_frequencies(highest, 4)) {
    const double w = 2 * half_turn * f * sample_time;
    chart.curves.push_back(line_of_frequency(w));
    chart.notes.push_back({std::cos(w), std::sin(w), with_unit(f, "Hz"), 0, 0});
  }
}

Chart z_plane(const std::vector<NamedPoles>& shown, double sample_time, const std::string& title,
              const std::string& id) {
  Chart chart;
  chart.title = title;
  chart.id = id;
  chart.is_square = true;
  chart.x.label = "Re z";
  chart.y.label = "Im z";
  chart.circles.push_back({0, 0, 1});
  for (const auto& [owner, poles] : shown) chart.curves.push_back(curve_of_poles(owner, poles, sample_time));
  return chart;
}

Chart whole_plane(const std::vector<NamedPoles>& shown, double sample_time) {
  Chart chart = z_plane(shown, sample_time, "Poles in the z plane", "poles");
  double reach = 1.1;
  for (const Curve& curve : chart.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) reach = std::max(reach, 1.1 * std::hypot(curve.x[i], curve.y[i]));
  chart.x_low = chart.y_low = -reach;
  chart.x_high = chart.y_high = reach;
  add_grid(half_turn, sample_time, chart);
  return chart;
}

// The poles that crowd at z = 1, if there are any: within a third of it, with the farthest of these at the edge.
std::optional<Chart> about_one(const std::vector<NamedPoles>& shown, double sample_time) {
  constexpr double crowd = 0.35;
  double reach = 0;
  for (const auto& [owner, poles] : shown)
    for (const std::complex<double>& pole : poles)
      if (std::abs(pole - 1.0) < crowd) reach = std::max(reach, std::abs(pole - 1.0));
  if (reach < 1e-9) return std::nullopt;
  Chart chart = z_plane(shown, sample_time, "Poles about z = 1", "poles-zoom");
  chart.x_low = 1 - 1.3 * reach, chart.x_high = 1 + 0.3 * reach;
  chart.y_low = -0.8 * reach, chart.y_high = 0.8 * reach;
  add_grid(reach, sample_time, chart);
  return chart;
}

design::Poles poles_of_plant(const Controller& controller) {
  const design::Digits digits(50);
  return design::sorted_poles(design::eigenvalues(
      design::without_disturbances(controller.problem, design::final_plant(controller.solution)).A));
}

}  // namespace

std::vector<NamedPoles> poles_of_controller(const Controller& controller) {
  const design::Solution& solution = controller.solution;
  if (solution.compensator) return {{"loop", solution.loop.poles}, {"compensator", solution.compensator->poles}};
  if (solution.regulator && solution.estimator &&
      !design::is_separated(controller.problem, design::final_plant(solution)))
    return {{"loop", solution.loop.poles}};
  std::vector<NamedPoles> shown;
  if (solution.regulator) shown.push_back({"regulator", solution.regulator->poles});
  if (solution.estimator) shown.push_back({"estimator", solution.estimator->poles});
  return shown;
}

PageSection pole_section(const Controller& controller) {
  const double sample_time = controller.problem.plant.sample_time;
  std::vector<NamedPoles> shown = poles_of_controller(controller);
  shown.push_back({"plant", poles_of_plant(controller)});
  PageView view;
  view.charts = {whole_plane(shown, sample_time)};
  if (std::optional<Chart> zoom = about_one(shown, sample_time)) view.charts.push_back(*std::move(zoom));
  for (Chart& chart : root_locus(controller)) view.charts.push_back(std::move(chart));
  view.tables = {pole_table(shown, sample_time)};
  return {"poles", "Poles", {view}};
}

}  // namespace lqg::emit
