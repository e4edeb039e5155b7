// SPDX-License-Identifier: MIT
#include <algorithm>

#include "emit/report/scenario_tables.hpp"
#include "emit/text/html.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

// Lines of cells under each other.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (widths.size() <= j) widths.push_back(0);
      widths[j] = std::max(widths[j], letters(row[j]));
    }
  std::string out;
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t j = 0; j < row.size(); ++j)
      line += " " + row[j] + (j + 1 < row.size() ? std::string(widths[j] - letters(row[j]) + 1, ' ') : "");
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string seconds(const std::optional<double>& time) { return time ? decimal(*time) + " s" : "not reached"; }

std::string with_unit_of(double value, const design::Signal& signal) {
  return decimal(value) + (signal.unit.empty() ? "" : " " + signal.unit);
}

void add_signal_rows(std::vector<std::vector<std::string>>& rows, const std::vector<design::Signal>& signals,
                     const std::vector<double>& rms, const std::vector<double>& peak,
                     const std::vector<double>& share) {
  for (std::size_t i = 0; i < rms.size(); ++i) {
    rows.push_back({signals[i].name, with_unit_of(rms[i], signals[i]), with_unit_of(peak[i], signals[i])});
    if (i < share.size()) rows.back().push_back(in_percent(share[i]));
  }
}

std::string counts_line(const Controller& controller, const std::vector<unsigned long>& left_out, unsigned long resets,
                        unsigned long covariance_resets) {
  std::string line;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    line += (line.empty() ? "  left out: " : ", ") + controller.problem.plant.outputs[i].name + " in " +
            std::to_string(left_out[i]) + " samples";
  line += (line.empty() ? "  " : "; ") + std::string("resets: ") + std::to_string(resets) + " of the state, " +
          std::to_string(covariance_resets) + " of P";
  return line + "\n";
}

std::string consistency_line(const char* name, const std::optional<simulate::Consistency>& found) {
  if (!found) return "";
  return std::string("  ") + name + ": mean " + decimal(found->mean) + ", expected " + decimal(found->expected) + "; " +
         in_percent(found->share_inside) + " of the samples within [" + decimal(found->low) + ", " +
         decimal(found->high) + "] (95 %)\n";
}

}  // namespace

std::string lines(const Controller& controller, const simulate::ScenarioRun& run) {
  const design::Plant& plant = controller.problem.plant;
  const simulate::ScenarioNumbers& numbers = run.numbers;
  std::string out = run.name + "\n";
  if (numbers.has_diverged) {
    const double time = static_cast<double>(run.times.size()) * plant.sample_time;
    out += "  The loop is lost after " + decimal(time) + " s.\n";
  }
  std::vector<std::vector<std::string>> rows;
  for (const simulate::StepAnswer& answer : numbers.answers) {
    if (rows.empty()) rows.push_back({"step", "", "rise", "settling", "overshoot"});
    const design::Signal& signal = plant.outputs[static_cast<std::size_t>(answer.output)];
    rows.push_back({signal.name + " at " + decimal(answer.at) + " s",
                    decimal(answer.from) + " → " + with_unit_of(answer.to, signal), seconds(answer.rise_time),
                    seconds(answer.settling_time), in_percent(answer.overshoot)});
  }
  out += aligned(rows);
  rows = {{"signal", "rms", "peak", "at limits"}};
  add_signal_rows(rows, plant.states, numbers.rms_x, numbers.peak_x, {});
  add_signal_rows(rows, plant.inputs, numbers.rms_u, numbers.peak_u, numbers.share_at_limits);
  return out + aligned(rows) + counts_line(controller, numbers.left_out, numbers.resets, numbers.covariance_resets);
}

std::string lines(const Controller& controller, const simulate::MonteCarlo& result) {
  std::string out = result.name + ", " + std::to_string(result.numbers.size()) +
                    " runs: " + in_percent(simulate::share_failed(result)) + " failed\n";
  const auto low = named_numbers(controller, simulate::percentile_numbers(result, 5));
  const auto middle = named_numbers(controller, simulate::percentile_numbers(result, 50));
  const auto high = named_numbers(controller, simulate::percentile_numbers(result, 95));
  std::vector<std::vector<std::string>> rows = {{"percentile", "5", "50", "95"}};
  for (std::size_t i = 0; i < low.size(); ++i)
    rows.push_back({low[i].name, decimal(low[i].value), decimal(middle[i].value), decimal(high[i].value)});
  return out + aligned(rows) + consistency_line("NEES", simulate::nees_of(result)) +
         consistency_line("NIS", simulate::nis_of(result));
}

std::string lines(const Controller& controller, const simulate::ReplayRun& run) {
  std::string out = "replay of " + std::to_string(run.times.size()) + " samples\n";
  if (run.nis.size()) {
    double sum = 0;
    for (const double value : run.nis) sum += value;
    out += "  NIS: mean " + decimal(run.nis.size() ? sum / static_cast<double>(run.nis.size()) : 0) + ", expected " +
           std::to_string(run.y.rows()) + "\n";
  }
  return out + counts_line(controller, run.left_out, run.resets, run.covariance_resets);
}

}  // namespace lqg::emit
