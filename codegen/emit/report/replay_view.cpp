// SPDX-License-Identifier: MIT
#include <cmath>

#include "emit/report/innovations.hpp"
#include "emit/report/simulation_page.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using Eigen::Index;
using Values = std::vector<double>;

class ReplayCharts {
 public:
  ReplayCharts(const Controller& controller, const simulate::ReplayRun& run)
      : plant_(controller.problem.plant), controller_(controller), run_(run),
        times_(run.times.begin(), run.times.end()) {}

  std::vector<Chart> all() const {
    std::vector<Chart> charts;
    for (std::size_t i = 0; i < plant_.states.size(); ++i) charts.push_back(state(i));
    for (std::size_t i = 0; i < plant_.outputs.size(); ++i) charts.push_back(output(i));
    for (std::size_t i = 0; i < plant_.outputs.size(); ++i) charts.push_back(innovation(i));
    if (run_.nis.size()) charts.push_back(nis());
    for (std::size_t i = 0; i < plant_.inputs.size(); ++i) charts.push_back(input(i));
    return charts;
  }

 private:
  Chart chart(const std::string& title, const std::string& kind, std::size_t i) const {
    Chart out;
    out.title = title;
    out.id = "log-" + kind + std::to_string(i);
    out.group = "log";
    out.x.label = "t [s]";
    for (std::size_t k = 0; k < run_.events.size(); ++k)
      if (run_.events[k] >> static_cast<unsigned>(step::Event::state_reset) & 1u)
        out.events.push_back({times_[k], "reset"});
    return out;
  }
  static Values row(const Eigen::MatrixXd& values, std::size_t i) {
    const auto found = values.row(static_cast<Index>(i));
    return {found.begin(), found.end()};
  }

  Chart state(std::size_t i) const {
    Chart out = chart(name_with_unit(plant_.states[i]), "x", i);
    out.curves = {{"estimate", Mark::line, 1, times_, row(run_.estimate, i)}};
    if (run_.sigma.size() == 0) return out;
    Band band = {"±3σ", 1, times_, row(run_.estimate, i), row(run_.estimate, i)};
    for (std::size_t k = 0; k < times_.size(); ++k) {
      const double reach = 3 * run_.sigma(static_cast<Index>(i), static_cast<Index>(k));
      band.low[k] -= reach, band.high[k] += reach;
    }
    out.bands = {std::move(band)};
    return out;
  }
  Chart output(std::size_t i) const {
    Chart out = chart(name_with_unit(plant_.outputs[i]), "y", i);
    out.curves = {{"measured", Mark::dots, 2, times_, row(run_.y, i)}};
    for (std::size_t k = 0; k < times_.size(); ++k)
      if (!std::isfinite(out.curves[0].y[k])) out.events.push_back({times_[k], "missing"});
    return out;
  }
  Chart innovation(std::size_t i) const {
    Chart out = chart("Innovation of " + name_with_unit(plant_.outputs[i]), "innovation", i);
    out.curves = {{"y − C x̂ − D u", Mark::dots, 0, times_, row(run_.innovation, i)}};
    return out;
  }
  Chart nis() const {
    Chart out = chart("NIS, νᵀ S⁻¹ ν", "nis", 0);
    out.curves = {{"NIS", Mark::dots, 0, times_, {run_.nis.begin(), run_.nis.end()}}};
    const double low = chi_squared(controller_.size.ny, 0.975), high = chi_squared(controller_.size.ny, 0.025);
    if (!times_.empty())
      out.bands = {{"95 % if the filter is right", 0, {times_.front(), times_.back()}, {low, low}, {high, high}}};
    return out;
  }
  Chart input(std::size_t i) const {
    Chart out = chart(name_with_unit(plant_.inputs[i]), "u", i);
    out.curves = {{"applied", Mark::steps, 3, times_, row(run_.u, i)}};
    if (run_.law.size()) out.curves.push_back({"what this law gives", Mark::dashes, 1, times_, row(run_.law, i)});
    return out;
  }

  const design::Plant& plant_;
  const Controller& controller_;
  const simulate::ReplayRun& run_;
  Values times_;
};

}  // namespace

PageView replay_view(const Controller& controller, const simulate::ReplayRun& run) {
  PageView view;
  view.charts = ReplayCharts(controller, run).all();
  PageTable table = {"What the filter made of it", {}, {}};
  double sum = 0;
  for (const double value : run.nis) sum += value;
  if (run.nis.size())
    table.rows.push_back({"mean of NIS; " + std::to_string(controller.size.ny) + " if the filter is right",
                          decimal(sum / static_cast<double>(run.nis.size()))});
  for (std::size_t i = 0; i < run.left_out.size(); ++i)
    table.rows.push_back({controller.problem.plant.outputs[i].name + " left out",
                          std::to_string(run.left_out[i]) + " of " + std::to_string(run.times.size()) + " samples"});
  table.rows.push_back({"resets of the state", std::to_string(run.resets)});
  table.rows.push_back({"resets of the covariance", std::to_string(run.covariance_resets)});
  view.tables = {std::move(table)};
  return view;
}

}  // namespace lqg::emit
