// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "emit/report/scenario_tables.hpp"
#include "emit/report/simulation_page.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using simulate::Consistency;
using simulate::MonteCarlo;

// Means over the runs beside the band that 95 % of them are in where the filter is right.
Chart consistency_chart(const Controller& controller, const std::string& title, const std::string& id,
                        const Consistency& found, const std::vector<double>& means) {
  Chart chart;
  chart.title = title;
  chart.id = id;
  chart.group = id;
  chart.x.label = "t [s]";
  Curve curve = {"mean of the runs", Mark::line, 0, {}, means};
  for (std::size_t k = 0; k < means.size(); ++k)
    curve.x.push_back(static_cast<double>(k) * controller.problem.plant.sample_time);
  chart.bands = {{"95 %", 0, {curve.x.front(), curve.x.back()}, {found.low, found.low}, {found.high, found.high}}};
  chart.guides = {{Guide::Axis::y, found.expected, "of a filter that is right"}};
  chart.curves = {std::move(curve)};
  return chart;
}

// Which share of the runs does not exceed a value.
Chart distribution(const std::string& name, std::vector<double> values) {
  Chart chart;
  chart.title = name;
  chart.id = "distribution-" + in_file_name(name);
  chart.x.label = name;
  chart.y.label = "share of the runs";
  std::sort(values.begin(), values.end());
  Curve curve = {"runs", Mark::steps, 0, {}, {}};
  for (std::size_t i = 0; i < values.size() && std::isfinite(values[i]); ++i) {
    curve.x.push_back(values[i]);
    curve.y.push_back(static_cast<double>(i + 1) / static_cast<double>(values.size()));
  }
  chart.curves = {std::move(curve)};
  return chart;
}

bool is_worth_a_chart(const std::string& name, const std::vector<double>& values) {
  const auto begins = [&](const char* word) { return name.rfind(word, 0) == 0; };
  if (!begins("settling_time_") && !begins("overshoot_") && !begins("peak_") && !begins("share_at_limits_"))
    return false;
  return *std::min_element(values.begin(), values.end()) < *std::max_element(values.begin(), values.end());
}

std::vector<Chart> distributions(const Controller& controller, const MonteCarlo& result) {
  std::vector<std::vector<double>> columns;
  std::vector<std::string> names;
  for (const simulate::ScenarioNumbers& numbers : result.numbers) {
    const std::vector<NamedNumber> all = named_numbers(controller, numbers);
    if (all.size() > names.size()) {
      names.clear();
      for (const NamedNumber& number : all) names.push_back(number.name);
      columns.assign(names.size(), {});
    }
  }
  for (const simulate::ScenarioNumbers& numbers : result.numbers)
    for (const NamedNumber& number : named_numbers(controller, numbers))
      columns[static_cast<std::size_t>(std::find(names.begin(), names.end(), number.name) - names.begin())].push_back(
          number.value);
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (is_worth_a_chart(names[i], columns[i])) charts.push_back(distribution(names[i], columns[i]));
  return charts;
}

PageTable percentile_table(const Controller& controller, const MonteCarlo& result) {
  PageTable table = {"Percentiles over the runs", {"number", "5", "50", "95"}, {}};
  std::vector<std::vector<NamedNumber>> columns;
  for (const double percent : {5.0, 50.0, 95.0})
    columns.push_back(named_numbers(controller, simulate::percentile_numbers(result, percent)));
  for (std::size_t i = 0; i < columns[0].size(); ++i)
    table.rows.push_back(
        {columns[0][i].name, decimal(columns[0][i].value), decimal(columns[1][i].value), decimal(columns[2][i].value)});
  return table;
}

void add_consistency(const std::string& name, const std::optional<Consistency>& found, PageTable& table) {
  if (!found) return;
  table.rows.push_back(
      {name + ", mean; " + decimal(found->expected) + " if the filter is right", decimal(found->mean)});
  table.rows.push_back({name + ", share of the samples within its 95 % band", in_percent(found->share_inside)});
}

}  // namespace

PageView monte_carlo_view(const Controller& controller, const MonteCarlo& result) {
  PageView view;
  view.name = result.name;
  view.text = std::to_string(result.numbers.size()) + " runs, of which " + in_percent(share_failed(result)) +
              " failed: the loop was lost, or a requirement was missed.";
  const auto nees = simulate::nees_of(result), nis = simulate::nis_of(result);
  const std::string id = in_file_name(result.name);
  if (nees)
    view.charts.push_back(consistency_chart(controller, "NEES, eᵀ P⁻¹ e", "nees-" + id, *nees,
                                            simulate::means_of(result.nees_sums, result.nees_counts)));
  if (nis)
    view.charts.push_back(consistency_chart(controller, "NIS, νᵀ S⁻¹ ν", "nis-" + id, *nis,
                                            simulate::means_of(result.nis_sums, result.nis_counts)));
  for (Chart& chart : distributions(controller, result)) view.charts.push_back(std::move(chart));
  PageTable does_it_know = {"Does the filter know its error?", {}, {}};
  add_consistency("NEES", nees, does_it_know);
  add_consistency("NIS", nis, does_it_know);
  view.tables = {percentile_table(controller, result)};
  if (!does_it_know.rows.empty()) view.tables.push_back(std::move(does_it_know));
  return view;
}

}  // namespace lqg::emit
