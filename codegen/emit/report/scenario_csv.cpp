// SPDX-License-Identifier: MIT
#include "emit/report/scenario_tables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using simulate::MonteCarlo;
using simulate::ReplayRun;
using simulate::ScenarioNumbers;
using simulate::ScenarioRun;
using simulate::StepAnswer;

// The shortest that reads back; empty where it is NaN.
std::string field(double value) {
  if (std::isnan(value)) return "";
  char text[40];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

// Columns of one table, all of the same length.
class CsvTable {
 public:
  void add(const std::string& name, std::vector<std::string> values) {
    names_.push_back(name);
    columns_.push_back(std::move(values));
  }
  void add(const std::string& name, const Eigen::VectorXd& values) {
    std::vector<std::string> fields;
    for (const double value : values) fields.push_back(field(value));
    add(name, std::move(fields));
  }
  // Nothing of an empty matrix.
  void add(const std::string& prefix, const std::vector<design::Signal>& signals, const Eigen::MatrixXd& rows) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      add(prefix + signals[static_cast<std::size_t>(i)].name, Eigen::VectorXd(rows.row(i)));
  }
  std::string text() const {
    std::string out;
    const auto add_line = [&](auto cell) {
      for (std::size_t j = 0; j < names_.size(); ++j) out += (j ? "," : "") + cell(j);
      out += "\n";
    };
    add_line([&](std::size_t j) { return names_[j]; });
    for (std::size_t i = 0; i < columns_.front().size(); ++i) add_line([&](std::size_t j) { return columns_[j][i]; });
    return out;
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> columns_;
};

std::vector<std::string> joined_events(const std::vector<unsigned>& events) {
  std::vector<std::string> out;
  for (const unsigned sample : events) {
    std::string names;
    for (const std::string& name : event_names(sample)) names += (names.empty() ? "" : "|") + name;
    out.push_back(names);
  }
  return out;
}

}  // namespace

std::vector<NamedNumber> named_numbers(const Controller& controller, const ScenarioNumbers& numbers) {
  const design::Plant& plant = controller.problem.plant;
  std::vector<NamedNumber> out;
  const auto add = [&](const char* what, const std::vector<design::Signal>& signals, const auto& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      out.push_back({what + signals[i].name, static_cast<double>(values[i])});
  };
  constexpr double never = std::numeric_limits<double>::infinity();
  for (const StepAnswer& answer : numbers.answers) {
    const std::string which = plant.outputs[static_cast<std::size_t>(answer.output)].name + "@" + field(answer.at);
    out.push_back({"rise_time_" + which, answer.rise_time.value_or(never)});
    out.push_back({"settling_time_" + which, answer.settling_time.value_or(never)});
    out.push_back({"overshoot_" + which, answer.overshoot});
  }
  add("rms_x_", plant.states, numbers.rms_x), add("peak_x_", plant.states, numbers.peak_x);
  add("rms_u_", plant.inputs, numbers.rms_u), add("peak_u_", plant.inputs, numbers.peak_u);
  add("rms_y_", plant.outputs, numbers.rms_y), add("peak_y_", plant.outputs, numbers.peak_y);
  add("share_at_limits_", plant.inputs, numbers.share_at_limits);
  add("left_out_", plant.outputs, numbers.left_out);
  out.push_back({"resets", static_cast<double>(numbers.resets)});
  out.push_back({"covariance_resets", static_cast<double>(numbers.covariance_resets)});
  out.push_back({"cost", numbers.cost});
  return out;
}

std::string event_name(step::Event event) {
  switch (event) {
    case step::Event::output_rejected: return "output_rejected";
    case step::Event::innovation_not_positive: return "innovation_not_positive";
    case step::Event::input_limited: return "input_limited";
    case step::Event::state_reset: return "state_reset";
    case step::Event::reference_not_finite: return "reference_not_finite";
    case step::Event::output_gated: return "output_gated";
    case step::Event::covariance_reset: return "covariance_reset";
    case step::Event::not_optimal: return "not_optimal";
    case step::Event::first_rejected: break;
  }
  const int output = static_cast<int>(event) - static_cast<int>(step::Event::first_rejected);
  return "output_rejected_" + std::to_string(output);
}

std::vector<std::string> event_names(unsigned events) {
  std::vector<std::string> out;
  for (int bit = 0; events >> bit != 0; ++bit)
    if (events >> bit & 1u) out.push_back(event_name(static_cast<step::Event>(bit)));
  return out;
}

std::string csv(const Controller& controller, const ScenarioRun& run) {
  const design::Plant& plant = controller.problem.plant;
  CsvTable table;
  table.add("t", run.times);
  table.add("r_", reference_signals(controller), run.r);
  table.add("y_", plant.outputs, run.y);
  table.add("u_", plant.inputs, run.u);
  table.add("x_", plant.states, run.x);
  if (controller.has.filter) table.add("estimate_", plant.states, run.estimate.topRows(run.x.rows()));
  table.add("sigma_", plant.states, run.sigma);
  table.add("innovation_", plant.outputs, run.innovation);
  if (run.nis.size()) table.add("nis", run.nis), table.add("nees", run.nees);
  table.add("events", joined_events(run.events));
  return table.text();
}

std::string csv(const Controller& controller, const ReplayRun& run) {
  const design::Plant& plant = controller.problem.plant;
  CsvTable table;
  table.add("t", run.times);
  table.add("y_", plant.outputs, run.y);
  table.add("u_", plant.inputs, run.u);
  table.add("law_", plant.inputs, run.law);
  table.add("estimate_", plant.states, run.estimate);
  table.add("sigma_", plant.states, run.sigma);
  table.add("innovation_", plant.outputs, run.innovation);
  if (run.nis.size()) table.add("nis", run.nis);
  table.add("events", joined_events(run.events));
  return table.text();
}

std::string csv(const Controller& controller, const MonteCarlo& result) {
  std::string out;
  for (std::size_t i = 0; i < result.numbers.size(); ++i) {
    const std::vector<NamedNumber> numbers = named_numbers(controller, result.numbers[i]);
    if (i == 0) {
      out += "run,failed";
      for (const NamedNumber& number : numbers) out += "," + number.name;
      out += "\n";
    }
    out += std::to_string(static_cast<std::size_t>(result.first) + i) + (result.failed[i] ? ",1" : ",0");
    for (const NamedNumber& number : numbers) out += "," + field(number.value);
    out += "\n";
  }
  return out;
}

std::string in_file_name(const std::string& scenario) {
  std::string out;
  for (const char c : scenario) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_plain)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "scenario" : out.substr(0, 60);
}

}  // namespace lqg::emit
