// SPDX-License-Identifier: MIT
#include "commands/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "design/checks/requirements.hpp"
#include "emit/report/scenario_tables.hpp"
#include "emit/report/simulation_page.hpp"
#include "input/csv.hpp"
#include "input/keys.hpp"
#include "input/text.hpp"
#include "simulate/scenario_requirements.hpp"

namespace lqg::commands {
namespace {

using controller::Controller;
using design::Scenario;

// Those of the names, or all.
std::optional<std::vector<Scenario>> chosen(const Controller& controller, const std::vector<std::string>& names,
                                            std::string& why) {
  const std::vector<Scenario> all = simulate::scenarios_to_show(controller);
  if (names.empty()) return all;
  std::vector<std::string> known;
  for (const Scenario& scenario : all) known.push_back(scenario.name);
  std::vector<Scenario> out;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found != known.end()) {
      out.push_back(all[static_cast<std::size_t>(found - known.begin())]);
      continue;
    }
    std::string list;
    for (const std::string& other : known) list += (list.empty() ? "" : ", ") + input::in_quotes(other);
    const std::string near = input::nearest_word(known, name);
    why = "--scenario: expected one of " + list + ", found " + input::in_quotes(name) +
          (near.empty() ? "" : "; did you mean " + input::in_quotes(near) + "?");
    return std::nullopt;
  }
  return out;
}

// The columns of a log: those of outputs and inputs have to be there, under their own name or with y_, u_ before it,
// as in what this command writes.
class LogReader {
 public:
  LogReader(const Controller& controller, const std::string& path, std::string& why)
      : controller_(controller), path_(path), why_(why) {}

  std::optional<simulate::Log> read() {
    const design::Plant& plant = controller_.problem.plant;
    simulate::Log log;
    std::vector<design::Signal> references;
    for (const int output : controller_.references)
      references.push_back(plant.outputs[static_cast<std::size_t>(output)]);
    if (!rows("y_", plant.outputs, true, log.y) || !rows("u_", plant.inputs, true, log.u) ||
        !rows("r_", references, false, log.r) || !times(log))
      return std::nullopt;
    if (!check_inputs(log)) return std::nullopt;
    return log;
  }

 private:
  bool read_column(const std::string& name, std::vector<double>& values) {
    const auto read = input::read_columns(path_, {name}, {name});
    if (const std::string* wrong = std::get_if<std::string>(&read)) {
      why_ = *wrong;
      return false;
    }
    values = std::get<input::Columns>(read).values.front();
    return true;
  }

  bool rows(const std::string& prefix, const std::vector<design::Signal>& signals, bool is_needed,
            Eigen::MatrixXd& to) {
    for (std::size_t i = 0; i < signals.size(); ++i) {
      std::vector<double> values;
      if (!read_column(prefix + signals[i].name, values)) return false;
      if (values.empty() && is_needed && !read_column(signals[i].name, values)) return false;
      if (values.empty() && is_needed) {
        why_ = path_ + ": expected a column " + input::in_quotes(signals[i].name) + " or " +
               input::in_quotes(prefix + signals[i].name) + " with numbers, found none";
        return false;
      }
      if (to.rows() == 0 && !values.empty())
        to = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(signals.size()), static_cast<Eigen::Index>(values.size()));
      for (std::size_t k = 0; k < values.size(); ++k)
        to(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = values[k];
    }
    return true;
  }

  bool times(simulate::Log& log) {
    std::vector<double> t;
    if (!read_column("t", t)) return false;
    const double T = controller_.problem.plant.sample_time;
    log.times.resize(log.y.cols());
    for (Eigen::Index k = 0; k < log.times.size(); ++k) {
      const double before = k ? log.times(k - 1) : 0;
      log.times(k) = t.empty() ? static_cast<double>(k) * T : t[static_cast<std::size_t>(k)];
      if (k == 0 || std::abs(log.times(k) - before - T) <= 0.5 * T) continue;
      why_ = path_ + ": expected a sample every " + input::printable(design::decimal(T)) +
             " s (plant.sample_time), found t = " + design::decimal(log.times(k)) + " after " +
             design::decimal(before) + "; a missing sample is a line with empty outputs";
      return false;
    }
    return true;
  }

  // What was applied is known.
  bool check_inputs(const simulate::Log& log) {
    for (Eigen::Index k = 0; k < log.u.cols(); ++k)
      if (!log.u.col(k).allFinite()) {
        why_ = path_ + ": expected finite inputs, found none in sample " + std::to_string(k) +
               ": write what was applied, 0 before the start";
        return false;
      }
    return true;
  }

  const Controller& controller_;
  const std::string& path_;
  std::string& why_;
};

unsigned processors() { return std::max(1u, std::thread::hardware_concurrency()); }

}  // namespace

std::optional<emit::Simulations> run_simulations(const Controller& controller, const SimulateArguments& arguments,
                                                 const SimulateProgress& progress, std::string& why) {
  emit::Simulations out;
  out.seed = arguments.seed;
  out.wants_each_run = arguments.first > 0 || arguments.wants_json;
  if (!arguments.log.empty()) {
    why = simulate::no_replay(controller);
    if (!why.empty()) return std::nullopt;
    const auto log = LogReader(controller, arguments.log, why).read();
    if (!log) return std::nullopt;
    out.replay = simulate::replay(controller, *log);
    return out;
  }
  const auto scenarios = chosen(controller, arguments.scenarios, why);
  if (!scenarios) return std::nullopt;
  out.scenarios = *scenarios;
  for (const Scenario& scenario : *scenarios) {
    if (arguments.runs == 0) {
      progress(scenario.name, 0);
      out.runs.push_back(simulate::run_scenario(controller, scenario, arguments.seed));
      continue;
    }
    simulate::MonteCarloOptions options;
    options.first = arguments.first, options.runs = arguments.runs, options.seed = arguments.seed;
    options.threads = processors();
    options.progress = [&](int done) { progress(scenario.name, static_cast<double>(done) / arguments.runs); };
    out.monte_carlo.push_back(simulate::monte_carlo(controller, scenario, options));
  }
  return out;
}

design::Findings missed_requirements(const Controller& controller, const emit::Simulations& simulations) {
  design::Findings findings;
  design::check_requirements(controller.problem, controller.solution, findings);
  const design::Requirements& require = controller.problem.requirements;
  for (const simulate::ScenarioRun& run : simulations.runs)
    for (const Scenario& scenario : controller.problem.scenarios)
      if (scenario.name == run.name && simulate::is_required_in(require, scenario))
        simulate::check_run(controller, run, findings);
  return findings;
}

std::vector<emit::File> simulation_files(const Controller& controller, const emit::Simulations& simulations) {
  std::vector<emit::File> files;
  std::set<std::string> names;
  const auto add = [&](const std::string& scenario, const std::string& ending, std::string text) {
    const std::string base = controller.problem.name + "_" + scenario + ending;
    std::string name = base + ".csv";  // two scenarios may differ only in signs that no file's name has
    for (int i = 2; !names.insert(name).second; ++i) name = base + "_" + std::to_string(i) + ".csv";
    files.push_back({name, std::move(text)});
  };
  for (const simulate::ScenarioRun& run : simulations.runs)
    add(emit::in_file_name(run.name), "", emit::csv(controller, run));
  for (const simulate::MonteCarlo& result : simulations.monte_carlo)
    add(emit::in_file_name(result.name), "_runs", emit::csv(controller, result));
  if (simulations.replay) add("replay", "", emit::csv(controller, *simulations.replay));
  files.push_back(
      {controller.problem.name + "_simulation.html", emit::page_html(emit::simulation_data(controller, simulations))});
  return files;
}

std::string simulation_lines(const Controller& controller, const emit::Simulations& simulations) {
  std::string out;
  const auto add = [&](const std::string& lines) { out += (out.empty() ? "" : "\n") + lines; };
  for (const simulate::ScenarioRun& run : simulations.runs) add(emit::lines(controller, run));
  for (const simulate::MonteCarlo& result : simulations.monte_carlo) add(emit::lines(controller, result));
  if (simulations.replay) add(emit::lines(controller, *simulations.replay));
  return out;
}

}  // namespace lqg::commands
