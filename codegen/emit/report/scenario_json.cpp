// SPDX-License-Identifier: MIT
#include "emit/report/scenario_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "emit/report/scenario_tables.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Values>
Json list_of(const Values& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(number_or_null(value));
  return out;
}

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json out = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) out.push_back(list_of(Eigen::VectorXd(matrix.row(i))));
  return out;
}

Json signal_list(const std::vector<design::Signal>& signals) {
  Json out = Json::array();
  for (const design::Signal& signal : signals) out.push_back(name_with_unit(signal));
  return out;
}

Json events_of_samples(const std::vector<unsigned>& events) {
  Json out = Json::array();
  for (std::size_t k = 0; k < events.size(); ++k)
    if (events[k]) out.push_back({{"k", k}, {"events", event_names(events[k])}});
  return out;
}

Json answers(const Controller& controller, const std::vector<simulate::StepAnswer>& all) {
  Json out = Json::array();
  for (const simulate::StepAnswer& answer : all)
    out.push_back({{"output", controller.problem.plant.outputs[static_cast<std::size_t>(answer.output)].name},
                   {"at", answer.at},
                   {"from", answer.from},
                   {"to", answer.to},
                   {"rise_time", number_or_null(answer.rise_time.value_or(INFINITY))},
                   {"settling_time", number_or_null(answer.settling_time.value_or(INFINITY))},
                   {"overshoot", number_or_null(answer.overshoot)}});
  return out;
}

Json numbers_of_run(const Controller& controller, const simulate::ScenarioNumbers& numbers) {
  return {
      {"rms",
       {{"states", list_of(numbers.rms_x)}, {"inputs", list_of(numbers.rms_u)}, {"outputs", list_of(numbers.rms_y)}}},
      {"peak",
       {{"states", list_of(numbers.peak_x)},
        {"inputs", list_of(numbers.peak_u)},
        {"outputs", list_of(numbers.peak_y)}}},
      {"share_at_limits", list_of(numbers.share_at_limits)},
      {"steps", answers(controller, numbers.answers)},
      {"left_out", numbers.left_out},
      {"resets", numbers.resets},
      {"covariance_resets", numbers.covariance_resets},
      {"cost", number_or_null(numbers.cost)},
      {"diverged", numbers.has_diverged}};
}

void add_rows(Json& to, const char* name, const Eigen::MatrixXd& values) {
  if (values.size()) to[name] = rows_of(values);
}

Json run_json(const Controller& controller, const simulate::ScenarioRun& run, std::uint64_t seed) {
  Json out = {{"name", run.name}, {"seed", seed}, {"t", list_of(run.times)}};
  out["x"] = rows_of(run.x);
  out["estimate"] = rows_of(run.estimate.topRows(run.x.rows()));
  add_rows(out, "sigma", run.sigma);
  out["y"] = rows_of(run.y);
  out["outputs"] = rows_of(run.outputs);
  out["u"] = rows_of(run.u);
  out["r"] = rows_of(run.r);
  add_rows(out, "innovation", run.innovation);
  if (run.nis.size()) out["nis"] = list_of(run.nis), out["nees"] = list_of(run.nees);
  out["events"] = events_of_samples(run.events);
  out["numbers"] = numbers_of_run(controller, run.numbers);
  return out;
}

Json consistency_json(const simulate::Consistency& found) {
  return {{"mean", number_or_null(found.mean)},
          {"expected", found.expected},
          {"low", found.low},
          {"high", found.high},
          {"share_inside", number_or_null(found.share_inside)}};
}

Json monte_carlo_json(const Controller& controller, const simulate::MonteCarlo& result, bool wants_each_run) {
  Json out = {{"name", result.name},
              {"runs", result.numbers.size()},
              {"first", result.first},
              {"seed", result.seed},
              {"failed", simulate::share_failed(result)}};
  for (const double percent : {5.0, 50.0, 95.0})
    out["percentiles"][std::to_string(static_cast<int>(percent))] =
        numbers_of_run(controller, simulate::percentile_numbers(result, percent));
  if (const auto nees = simulate::nees_of(result)) out["nees"] = consistency_json(*nees);
  if (const auto nis = simulate::nis_of(result)) out["nis"] = consistency_json(*nis);
  if (!wants_each_run) return out;
  for (const simulate::ScenarioNumbers& numbers : result.numbers)
    out["samples"].push_back(numbers_of_run(controller, numbers));
  out["failures"] = result.failed;
  out["sums"] = {
      {"nees", result.nees_sums},        {"nees_counts", result.nees_counts},   {"nis", result.nis_sums},
      {"nis_counts", result.nis_counts}, {"nees_degrees", result.nees_degrees}, {"nis_degrees", result.nis_degrees}};
  return out;
}

Json replay_json(const simulate::ReplayRun& run) {
  Json out = {{"t", list_of(run.times)}, {"y", rows_of(run.y)}, {"u", rows_of(run.u)}};
  add_rows(out, "law", run.law);
  out["estimate"] = rows_of(run.estimate);
  add_rows(out, "sigma", run.sigma);
  out["innovation"] = rows_of(run.innovation);
  if (run.nis.size()) out["nis"] = list_of(run.nis);
  out["events"] = events_of_samples(run.events);
  out["left_out"] = run.left_out;
  out["resets"] = run.resets;
  out["covariance_resets"] = run.covariance_resets;
  return out;
}

}  // namespace

std::string simulations_json(const Controller& controller, const Simulations& simulations) {
  const design::Plant& plant = controller.problem.plant;
  Json out = {{"name", controller.problem.name},
              {"lqgen", version()},
              {"design_file", {{"name", controller.source.file}, {"sha256", controller.source.sha256}}},
              {"sample_time", plant.sample_time},
              {"states", signal_list(plant.states)},
              {"inputs", signal_list(plant.inputs)},
              {"outputs", signal_list(plant.outputs)}};
  out["references"] = Json::array();
  for (const design::Signal& signal : reference_signals(controller)) out["references"].push_back(signal.name);
  if (!simulations.runs.empty()) out["scenarios"] = Json::array();
  for (const simulate::ScenarioRun& run : simulations.runs)
    out["scenarios"].push_back(run_json(controller, run, simulations.seed));
  for (const simulate::MonteCarlo& result : simulations.monte_carlo)
    out["monte_carlo"].push_back(monte_carlo_json(controller, result, simulations.wants_each_run));
  if (simulations.replay) out["replay"] = replay_json(*simulations.replay);
  return out.dump() + "\n";
}

}  // namespace lqg::emit
