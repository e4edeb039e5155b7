// SPDX-License-Identifier: MIT
// The numbers that decide of a run of a scenario.
#include "emit/report/scenario_view.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using Signals = std::vector<design::Signal>;

std::string in_seconds(const std::optional<double>& time) { return time ? with_unit(*time, "s") : "not reached"; }

PageTable answers_to_steps(const Controller& controller, const simulate::ScenarioNumbers& numbers) {
  PageTable table = {"Answers to steps", {"output", "step", "rise time", "settling time", "overshoot"}, {}};
  for (const simulate::StepAnswer& answer : numbers.answers) {
    const design::Signal& output = controller.problem.plant.outputs[static_cast<std::size_t>(answer.output)];
    table.rows.push_back({output.name, decimal(answer.from) + " to " + with_unit(answer.to, output.unit),
                          in_seconds(answer.rise_time), in_seconds(answer.settling_time),
                          in_percent(answer.overshoot)});
  }
  return table;
}

// Of those that were not 0 all the time.
void add_sizes(const Signals& signals, const std::vector<double>& rms, const std::vector<double>& peak,
               const std::string& kind, PageTable& table) {
  for (std::size_t i = 0; i < rms.size() && i < signals.size(); ++i)
    if (peak[i] != 0)
      table.rows.push_back(
          {signals[i].name + ", " + kind, with_unit(rms[i], signals[i].unit), with_unit(peak[i], signals[i].unit)});
}

PageTable sizes_of_signals(const Controller& controller, const simulate::ScenarioNumbers& numbers) {
  const design::Plant& plant = controller.problem.plant;
  PageTable table = {"Sizes", {"signal", "rms", "peak"}, {}};
  add_sizes(plant.outputs, numbers.rms_y, numbers.peak_y, "output", table);
  add_sizes(plant.inputs, numbers.rms_u, numbers.peak_u, "input", table);
  add_sizes(plant.states, numbers.rms_x, numbers.peak_x, "state", table);
  return table;
}

PageTable incidents(const Controller& controller, const simulate::ScenarioRun& run) {
  const simulate::ScenarioNumbers& numbers = run.numbers;
  const design::Plant& plant = controller.problem.plant;
  PageTable table = {"Incidents", {}, {}};
  if (controller.problem.limits)
    for (std::size_t i = 0; i < numbers.share_at_limits.size(); ++i)
      table.rows.push_back({plant.inputs[i].name + " at a limit", in_percent(numbers.share_at_limits[i])});
  for (std::size_t i = 0; i < numbers.left_out.size(); ++i)
    if (numbers.left_out[i])
      table.rows.push_back({plant.outputs[i].name + " left out", std::to_string(numbers.left_out[i]) + " of " +
                                                                     std::to_string(run.times.size()) + " samples"});
  if (numbers.resets) table.rows.push_back({"resets of the state", std::to_string(numbers.resets)});
  if (numbers.covariance_resets)
    table.rows.push_back({"resets of the covariance", std::to_string(numbers.covariance_resets)});
  if (numbers.cost > 0) table.rows.push_back({"cost", decimal(numbers.cost)});
  return table;
}

}  // namespace

std::vector<PageTable> number_tables(const Controller& controller, const simulate::ScenarioRun& run) {
  return {answers_to_steps(controller, run.numbers), incidents(controller, run),
          sizes_of_signals(controller, run.numbers)};
}

}  // namespace lqg::emit
