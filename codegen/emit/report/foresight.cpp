// SPDX-License-Identifier: MIT
// What limits that are foreseen are worth: one start with both laws, and the sum of many.
#include <cmath>

#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using controller::Worth;

// Below it nobody would notice, in J of one start in a hundred; and in starts that settle, one in so many.
constexpr double noticeable = 1.05;
constexpr int one_in = 50;

std::vector<double> row_of(const Eigen::MatrixXd& values, Eigen::Index row) {
  std::vector<double> out;
  for (Eigen::Index k = 0; k < values.cols(); ++k) out.push_back(values(row, k));
  return out;
}

std::vector<double> times_of(const Eigen::MatrixXd& values, double T) {
  std::vector<double> out;
  for (Eigen::Index k = 0; k < values.cols(); ++k) out.push_back(static_cast<double>(k) * T);
  return out;
}

Chart chart_of(const Controller& controller, const design::Signal& signal, const std::string& kind, Eigen::Index i,
               const Eigen::MatrixXd& clipped, const Eigen::MatrixXd& optimal, Mark mark) {
  const double T = controller.problem.plant.sample_time;
  Chart out;
  out.title = name_with_unit(signal);
  out.id = "foresight-" + kind + std::to_string(i);
  out.group = "foresight";
  out.x.label = "t [s]";
  out.curves = {{"clipped", mark, 1, times_of(clipped, T), row_of(clipped, i)},
                {"foreseen", mark, 0, times_of(optimal, T), row_of(optimal, i)}};
  return out;
}

void add_guides(double low, double high, const char* words, Chart& out) {
  for (const double at : {low, high})
    if (std::isfinite(at)) out.guides.push_back({Guide::Axis::y, at, words});
}

std::vector<Chart> charts_of(const Controller& controller, const Worth& worth) {
  const design::Plant& plant = controller.problem.plant;
  const design::Limits& limits = *controller.problem.limits;
  std::vector<Chart> out;
  const auto nu = static_cast<Eigen::Index>(plant.inputs.size()), nx = static_cast<Eigen::Index>(plant.states.size());
  for (Eigen::Index i = 0; i < nu; ++i) {
    out.push_back(chart_of(controller, plant.inputs[static_cast<std::size_t>(i)], "u", i, worth.shown.clipped_u,
                           worth.shown.optimal_u, Mark::steps));
    add_guides(limits.u_min(i), limits.u_max(i), "limit", out.back());
  }
  for (Eigen::Index i = 0; i < nx; ++i) {
    out.push_back(chart_of(controller, plant.states[static_cast<std::size_t>(i)], "x", i, worth.shown.clipped_x,
                           worth.shown.optimal_x, Mark::line));
    if (limits.states.range.size())
      add_guides(limits.states.range(i, 0), limits.states.range(i, 1), "soft limit", out.back());
  }
  return out;
}

std::string of_starts(int some, int all) { return std::to_string(some) + " of " + std::to_string(all); }

PageTable table_of(const Worth& worth) {
  PageTable table = {"", {"", "clipped", "foreseen"}, {}};
  table.rows = {{"Starts that settle", of_starts(worth.clipped_settle, worth.starts),
                 of_starts(worth.optimal_settle, worth.starts)}};
  if (worth.both_settle > 0) {
    table.rows.push_back({"Cost, median of the ratio", decimal(worth.median_ratio), "1"});
    table.rows.push_back({"Cost, 99th percentile of the ratio", decimal(worth.high_ratio), "1"});
  }
  if (worth.clipped_excess > 0 || worth.optimal_excess > 0)
    table.rows.push_back({"Largest excess over a soft limit, of its range, mean of these starts",
                          in_percent(worth.clipped_excess), in_percent(worth.optimal_excess)});
  return table;
}

}  // namespace

std::string worth_in_words(const Controller& controller) {
  const Worth& worth = *controller.worth;
  const bool settles = one_in * (worth.optimal_settle - worth.clipped_settle) > worth.starts;
  const bool saves = worth.high_ratio > noticeable;
  if (!settles && !saves)
    return "Foreseeing the limits is worth nothing here: the clipped law settles from " +
           of_starts(worth.clipped_settle, worth.starts) + " starts, with foresight from " +
           std::to_string(worth.optimal_settle) + ", and costs " + decimal(worth.high_ratio) +
           " times the optimum in one of a hundred. Take horizon = 0.";
  std::string out = "Foreseeing the limits ";
  if (settles)
    out += "settles the loop from " + of_starts(worth.optimal_settle, worth.starts) + " starts; clipped, from " +
           std::to_string(worth.clipped_settle) + (saves ? ". It " : ".");
  if (saves)
    out += "saves cost: clipped, it is " + decimal(worth.median_ratio) + " times the optimum in the median, " +
           decimal(worth.high_ratio) + " times in one of a hundred starts.";
  return out;
}

PageSection foresight_section(const Controller& controller) {
  PageSection section = {"foresight", "What foresight is worth", {}};
  if (!controller.worth) return section;
  const Worth& worth = *controller.worth;
  PageView view;
  view.text = worth_in_words(controller) +
              " Measured with the exact state and without noise, from starts where the law " +
              "alone goes beyond a limit, up to 4 times.";
  view.charts = charts_of(controller, worth);
  view.caption = worth.clipped_settle < worth.optimal_settle ? "A start that the clipped law does not survive."
                                                             : "One of the tenth of starts that cost it most.";
  view.tables = {table_of(worth)};
  section.views = {view};
  return section;
}

}  // namespace lqg::emit
