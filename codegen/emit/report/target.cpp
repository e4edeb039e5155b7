// SPDX-License-Identifier: MIT
// What the controller costs, and what rounding to the target's numbers does.
#include "emit/report/sections.hpp"
#include "emit/text/equations.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

std::string listed(const std::vector<design::Signal>& signals) {
  std::string out;
  for (const design::Signal& signal : signals) out += (out.empty() ? "" : ", ") + name_with_unit(signal);
  return out;
}

std::string filter_in_words(const Controller& controller) {
  switch (controller.filter) {
    case step::Filter::none: return "";
    case step::Filter::plain: return "covariance carried on line";
    case step::Filter::ud: return "UD factors carried on line";
    default:
      return controller.filters.size() > 1 ? "a schedule of " + std::to_string(controller.filters.size()) + " gains"
                                           : "constant gain";
  }
}

// Rows without a value are left out.
PageTable two_columns(const std::string& caption, const std::vector<std::vector<std::string>>& rows) {
  PageTable table = {caption, {}, {}};
  for (const std::vector<std::string>& row : rows)
    if (!row[1].empty()) table.rows.push_back(row);
  return table;
}

PageTable what_it_is(const Controller& controller) {
  const design::Plant& plant = controller.problem.plant;
  return two_columns("What it is", {{"Sample time", with_unit(plant.sample_time, "s")},
                                    {"States", listed(plant.states)},
                                    {"Inputs", listed(plant.inputs)},
                                    {"Outputs", controller.has.filter ? listed(plant.outputs) : ""},
                                    {"Law", controller.has.regulator ? "u = " + equation_of_law(controller) : ""},
                                    {"Filter", filter_in_words(controller)},
                                    {"Form", !controller.has.filter    ? ""
                                             : controller.is_predictor ? "predictor"
                                                                       : "filter"},
                                    {"Digits of the design", std::to_string(controller.solution.numerics.digits)},
                                    {"Condition", decimal(controller.solution.numerics.condition)}});
}

PageTable equations_of_motion(const Controller& controller) {
  PageTable table = {
      "The plant's equations; curves over time are of these, those of the loop are of their "
      "linearisation",
      {},
      {}};
  for (const EquationLine& line : equation_lines(controller)) table.rows.push_back({line.left, line.right});
  return table;
}

PageTable what_it_costs(const Controller& controller) {
  const CodeCost& cost = controller.cost;
  return two_columns(
      "What it costs",
      {{"Code", std::string(controller.target.is_double ? "double, " : "float, ") +
                    (controller.target.is_fused ? "fused, " : "plain, ") + style_of(controller)},
       {"Multiply-adds a sample", std::to_string(cost.multiply_adds)},
       {"RAM", std::to_string(cost.ram) + " bytes"},
       {"Flash, at most, by arm-none-eabi-gcc 12.2 at -O2 for a Cortex-M4F", std::to_string(cost.flash) + " bytes"},
       {"Stack, likewise", std::to_string(cost.stack) + " bytes"}});
}

// "Cortex-M4F" of "cortex-m4f", "RV32F" of "rv32f".
std::string core_in_words(const std::string& port) {
  std::string name = upper(port);
  if (const std::string arm = "CORTEX-"; name.rfind(arm, 0) == 0) name.replace(0, arm.size(), "Cortex-");
  return name;
}

PageTable what_a_sample_takes(const Controller& controller) {
  PageTable table = {"Instructions of a sample in which all is as expected: an estimate, with GCC 12.2 at -O2", {}, {}};
  for (const auto& [core, instructions] : controller.cost.instructions)
    table.rows.push_back({core_in_words(core), "about " + std::to_string(instructions)});
  if (table.rows.empty()) table.rows.push_back({"Of loops there is none", "test/bench/run.sh counts them"});
  return table;
}

using Optional = std::optional<double>;

void add_row(PageTable& table, const std::string& what, const Optional& designed, const Optional& rounded,
             const std::string& unit) {
  if (!designed) return;
  table.rows.push_back({what, with_unit(*designed, unit), rounded ? with_unit(*rounded, unit) : ""});
}

Optional times(const Optional& value, double factor) { return value ? Optional(*value * factor) : std::nullopt; }

void add_margins_at_inputs(const design::Margins& exact, const design::Margins& held, double T, PageTable& table) {
  add_row(table, "Gain margin at the inputs", exact.gain_dB, held.gain_dB, "dB");
  add_row(table, "— the gain may rise by", exact.gain_up_dB, held.gain_up_dB, "dB");
  add_row(table, "— the gain may fall by", exact.gain_down_dB, held.gain_down_dB, "dB");
  add_row(table, "Phase margin at the inputs", exact.phase_deg, held.phase_deg, "°");
  add_row(table, "Delay margin at the inputs", exact.delay_samples, held.delay_samples, "samples");
  add_row(table, "— in seconds", times(exact.delay_samples, T), times(held.delay_samples, T), "s");
  add_row(table, "Crossover at the inputs", times(exact.crossover, 1 / T), times(held.crossover, 1 / T), "rad/s");
  add_row(table, "Disk margin at the inputs", exact.disk, held.disk, "");
}

// The loop as it is designed beside the loop with the target's numbers.
PageTable what_rounding_does(const Controller& controller) {
  const design::LoopSolution& loop = controller.solution.loop;
  const design::RoundedLoop none, &target = loop.rounded ? *loop.rounded : none;
  const std::string real = controller.target.is_double ? "double" : "float";
  PageTable table = {"What rounding does", {"", "as designed", "with the numbers in " + real}, {}};
  add_margins_at_inputs(loop.at_input, target.at_input, controller.problem.plant.sample_time, table);
  add_row(table, "Gain margin at the outputs", loop.at_output.gain_dB, target.at_output.gain_dB, "dB");
  add_row(table, "Phase margin at the outputs", loop.at_output.phase_deg, target.at_output.phase_deg, "°");
  add_row(table, "Disk margin at the outputs", loop.at_output.disk, target.at_output.disk, "");
  if (!loop.poles.empty() && !target.poles.empty())
    add_row(table, "Largest |z| of the loop's poles", std::abs(loop.poles.front()), std::abs(target.poles.front()), "");
  add_row(table, "Cost per sample", loop.cost_per_sample, target.cost_per_sample, "");
  add_row(table, "Cost per second", loop.cost_per_second, {}, "");
  return table;
}

PageTable root_mean_squares(const Controller& controller) {
  PageTable table = {"Root mean squares with the noises of the design, r = 0 and no limits", {}, {}};
  if (!controller.solution.loop.rms) return table;
  const design::Rms& rms = *controller.solution.loop.rms;
  const auto add = [&](const std::vector<design::Signal>& signals, const std::vector<double>& values,
                       const std::string& words) {
    for (std::size_t i = 0; i < values.size(); ++i)
      table.rows.push_back({signals[i].name + words, with_unit(values[i], signals[i].unit)});
  };
  add(state_signals(controller), rms.x, "");
  add(controller.problem.plant.inputs, rms.u, "");
  add(controller.problem.plant.outputs, rms.y, ", measured");
  return table;
}

}  // namespace

PageSection target_section(const Controller& controller) {
  PageView view;
  view.tables = {what_it_is(controller),          equations_of_motion(controller), what_it_costs(controller),
                 what_a_sample_takes(controller), what_rounding_does(controller),  root_mean_squares(controller)};
  return {"target", "On the target", {view}};
}

}  // namespace lqg::emit
