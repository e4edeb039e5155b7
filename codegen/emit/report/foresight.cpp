// SPDX-License-Identifier: MIT
// What limits that are foreseen are worth: one start with both laws, and the sum of many.
#include <cmath>

#include "controller/operating_point.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using controller::Worth;

// Below it nobody would notice, in J of one start in a hundred; and in starts that settle, one in so many.
constexpr double noticeable = 1.05;
constexpr int one_in = 50;

// A quantity over the samples of the run that is shown: one row of each matrix.
struct Quantity {
  design::Signal signal;
  std::string id;  // of its chart
  Mark mark;
  Eigen::RowVectorXd clipped, optimal;
};

std::vector<double> list_of(const Eigen::RowVectorXd& values) { return {values.begin(), values.end()}; }

std::vector<double> times_of(const Eigen::RowVectorXd& values, double T) {
  std::vector<double> out;
  for (Eigen::Index k = 0; k < values.size(); ++k) out.push_back(static_cast<double>(k) * T);
  return out;
}

Chart chart_of(const Quantity& shown, double T) {
  Chart out;
  out.title = name_with_unit(shown.signal);
  out.id = "foresight-" + shown.id;
  out.group = "foresight";
  out.x.label = "t [s]";
  out.curves = {{"clipped", shown.mark, 1, times_of(shown.clipped, T), list_of(shown.clipped)},
                {"foreseen", shown.mark, 0, times_of(shown.optimal, T), list_of(shown.optimal)}};
  return out;
}

void add_guides(double low, double high, const char* words, Chart& out) {
  for (const double at : {low, high})
    if (std::isfinite(at)) out.guides.push_back({Guide::Axis::y, at, words});
}

// Of deviations of signal i.
Quantity in_own_units(Quantity of, const Eigen::VectorXd& point, Eigen::Index i) {
  if (point.size() == 0) return of;
  of.clipped.array() += point(i), of.optimal.array() += point(i);
  return of;
}

design::Limits own_limits(const Controller& controller) {
  design::Limits limits = *controller.problem.limits;
  limits.u_min = controller::own_input_limits(controller, +1),
  limits.u_max = controller::own_input_limits(controller, -1);
  limits.states = controller::own_state_limits(controller), limits.outputs = controller::own_output_limits(controller);
  return limits;
}

// From one sample to the next, a second; of the first from `before`.
Eigen::RowVectorXd rate_of(const Eigen::RowVectorXd& values, double before, double T) {
  Eigen::RowVectorXd out = values;
  for (Eigen::Index k = values.size() - 1; k > 0; --k) out(k) = (values(k) - values(k - 1)) / T;
  out(0) = (values(0) - before) / T;
  return out;
}

Quantity rate_of(const Quantity& of, bool is_from_rest, double T) {
  const std::string unit = of.signal.unit.empty() ? "" : of.signal.unit + "/s";
  const auto first = [&](const Eigen::RowVectorXd& values) { return is_from_rest ? 0 : values(0); };
  return {{"rate of " + of.signal.name, unit},
          of.id + "-rate",
          Mark::steps,
          rate_of(of.clipped, first(of.clipped), T),
          rate_of(of.optimal, first(of.optimal), T)};
}

bool is_limited(const design::SoftLimits& limits, Eigen::Index i) {
  return limits.range.size() && (std::isfinite(limits.range(i, 0)) || std::isfinite(limits.range(i, 1)));
}

// The run as charts: every input and state, the outputs that are limited, and all rates that are.
class RunCharts {
 public:
  explicit RunCharts(const Controller& controller)
      : plant_(controller.problem.plant), point_(controller::stated_point(controller)), limits_(own_limits(controller)),
        run_(controller.worth->shown) {
    add_inputs();
    add_states();
    add_outputs(in_double(controller.solution.plant.C), in_double(controller.solution.plant.D));
  }

  std::vector<Chart> charts;

 private:
  void add(const Quantity& shown, double low, double high, const char* words) {
    charts.push_back(chart_of(shown, plant_.sample_time));
    add_guides(low, high, words, charts.back());
  }
  void add_soft(const Quantity& shown, const design::SoftLimits& limits, Eigen::Index i) {
    const bool is_there = is_limited(limits, i);
    add(shown, is_there ? limits.range(i, 0) : -design::forever, is_there ? limits.range(i, 1) : design::forever,
        "soft limit");
  }

  void add_inputs() {
    for (Eigen::Index i = 0; i < run_.clipped_u.rows(); ++i) {
      const Quantity u = {plant_.inputs[static_cast<std::size_t>(i)], "u" + std::to_string(i), Mark::steps,
                          run_.clipped_u.row(i), run_.optimal_u.row(i)};
      add(in_own_units(u, point_.u, i), limits_.u_min(i), limits_.u_max(i), "limit");
      if (limits_.u_rate.size() && std::isfinite(limits_.u_rate(i)))
        add(rate_of(u, true, plant_.sample_time), -limits_.u_rate(i), limits_.u_rate(i), "limit");
    }
  }

  void add_states() {
    for (std::size_t i = 0; i < plant_.states.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Quantity x = {plant_.states[i], "x" + std::to_string(i), Mark::line, run_.clipped_x.row(row),
                          run_.optimal_x.row(row)};
      add_soft(in_own_units(x, point_.x, row), limits_.states, row);
    }
  }

  void add_outputs(const Eigen::MatrixXd& C, const Eigen::MatrixXd& D) {
    for (std::size_t i = 0; i < plant_.outputs.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto y = [&](const Eigen::MatrixXd& x, const Eigen::MatrixXd& u) {
        return Eigen::RowVectorXd(C.row(row) * x + D.row(row) * u);
      };
      const Quantity output = {plant_.outputs[i], "y" + std::to_string(i), Mark::line,
                               y(run_.clipped_x, run_.clipped_u), y(run_.optimal_x, run_.optimal_u)};
      if (is_limited(limits_.outputs, row)) add_soft(in_own_units(output, point_.y, row), limits_.outputs, row);
      if (is_limited(limits_.output_rates, row))
        add_soft(rate_of(output, false, plant_.sample_time), limits_.output_rates, row);
    }
  }

  const design::Plant& plant_;
  const controller::Point point_;
  const design::Limits limits_;
  const controller::WorthOfRun& run_;
};

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
  view.charts = RunCharts(controller).charts;
  view.caption =
      std::string(worth.clipped_settle < worth.optimal_settle ? "A start that the clipped law does not survive. "
                                                              : "One of the tenth of starts that cost it most. ") +
      "Both have the bits of what is emitted: with this horizon, and with horizon = 0.";
  view.tables = {table_of(worth)};
  section.views = {view};
  return section;
}

}  // namespace lqg::emit
