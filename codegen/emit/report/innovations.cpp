// SPDX-License-Identifier: MIT
#include "emit/report/innovations.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using Values = std::vector<double>;

const ShownRun* run_with_noise(const std::vector<ShownRun>& runs) {
  for (const ShownRun& shown : runs)
    if (shown.scenario.noise && shown.run.innovation.cols() > 20) return &shown;
  return nullptr;
}

Values nis_of(const simulate::ScenarioRun& run) { return {run.nis.begin(), run.nis.end()}; }

double share_below(const Values& values, double limit) {
  const auto count = std::count_if(values.begin(), values.end(), [&](double value) { return value < limit; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

Chart nis_chart(const Controller& controller, const simulate::ScenarioRun& run) {
  Chart chart;
  chart.title = "NIS, νᵀ S⁻¹ ν";
  chart.id = "nis";
  chart.x.label = "t [s]";
  const Values times(run.times.begin(), run.times.end());
  chart.curves = {{"NIS", Mark::dots, 0, times, nis_of(run)}};
  const double low = chi_squared(controller.size.ny, 0.975), high = chi_squared(controller.size.ny, 0.025);
  chart.bands = {{"95 %", 0, {times.front(), times.back()}, {low, low}, {high, high}}};
  return chart;
}

// Where it is white, 95 % of the lags are within ±1.96/√N.
Chart whiteness_chart(const Controller& controller, const simulate::ScenarioRun& run) {
  constexpr std::size_t most_lags = 30;
  Chart chart;
  chart.title = "Correlation of the innovations with earlier ones";
  const auto& recovery = controller.solution.loop.recovery;
  if (recovery && recovery->q > 0) chart.title += ", which recovery makes";
  chart.id = "whiteness";
  chart.x.label = "lag [samples]";
  const auto samples = static_cast<std::size_t>(run.innovation.cols());
  const std::size_t lags = std::min(most_lags, samples / 4);
  constexpr Mark marks[] = {Mark::line, Mark::dashes, Mark::dash_dots, Mark::dotted};
  for (Eigen::Index i = 0; i < run.innovation.rows(); ++i) {
    const int number = static_cast<int>(i);
    Curve curve = {controller.problem.plant.outputs[static_cast<std::size_t>(i)].name, marks[i % 4], number, {}, {}};
    const Values row(run.innovation.row(i).begin(), run.innovation.row(i).end());
    curve.y = autocorrelation(row, lags);
    for (std::size_t lag = 0; lag < curve.y.size(); ++lag) curve.x.push_back(static_cast<double>(lag));
    chart.curves.push_back(std::move(curve));
  }
  const double bound = 1.96 / std::sqrt(static_cast<double>(samples)), last = static_cast<double>(lags);
  chart.bands = {{"95 % if white", 6, {0, last}, {-bound, -bound}, {bound, bound}}};
  return chart;
}

PageTable shares(const Controller& controller, const simulate::ScenarioRun& run) {
  PageTable table = {"What the innovations say, " + run.name, {}, {}};
  if (run.nis.size() > 0) {
    Values nis = nis_of(run);
    nis.erase(std::remove_if(nis.begin(), nis.end(), [](double value) { return !std::isfinite(value); }), nis.end());
    double sum = 0;
    for (const double value : nis) sum += value;
    const std::string expected = std::to_string(controller.size.ny);
    table.rows.push_back(
        {"mean of NIS; " + expected + " where the filter is right", decimal(sum / static_cast<double>(nis.size()))});
    table.rows.push_back(
        {"share of NIS below its 95 % bound", in_percent(share_below(nis, chi_squared(controller.size.ny, 0.05)))});
  }
  const auto& left_out = run.numbers.left_out;
  if (std::all_of(left_out.begin(), left_out.end(), [](unsigned long count) { return count == 0; }))
    table.rows.push_back({"outputs left out", "none"});
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (left_out[i])
      table.rows.push_back({controller.problem.plant.outputs[i].name + " left out",
                            in_percent(static_cast<double>(left_out[i]) / static_cast<double>(run.times.size()))});
  return table;
}

}  // namespace

std::vector<double> autocorrelation(const std::vector<double>& signal, std::size_t most) {
  Values finite;
  for (const double value : signal)
    if (std::isfinite(value)) finite.push_back(value);
  double mean = 0;
  for (const double value : finite) mean += value / static_cast<double>(finite.size());
  Values out;
  for (std::size_t lag = 0; lag <= most && lag < finite.size(); ++lag) {
    double sum = 0;
    for (std::size_t k = 0; k + lag < finite.size(); ++k) sum += (finite[k] - mean) * (finite[k + lag] - mean);
    out.push_back(sum);
  }
  const double variance = out.empty() ? 0 : out.front();
  for (double& value : out) value = variance > 0 ? value / variance : 0;
  return out;
}

double chi_squared(int degrees, double probability) {
  return degrees > 0 ? 2 * boost::math::gamma_q_inv(degrees / 2.0, probability) : 0;
}

void add_innovations(const Controller& controller, const std::vector<ShownRun>& runs, PageView& view) {
  const ShownRun* shown = run_with_noise(runs);
  if (!shown) return;
  if (shown->run.nis.size() > 0) view.charts.push_back(nis_chart(controller, shown->run));
  view.charts.push_back(whiteness_chart(controller, shown->run));
  view.tables.push_back(shares(controller, shown->run));
}

}  // namespace lqg::emit
