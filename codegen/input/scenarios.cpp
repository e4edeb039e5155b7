// SPDX-License-Identifier: MIT
#include "input/scenarios.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "input/csv.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

bool is_true(const Values& values, const std::string& key, bool absent) {
  return values.number(key, absent ? 1 : 0) != 0;
}

bool is_discrete(const Values& values) { return values.text("plant.domain") == "discrete"; }

Eigen::MatrixXd given_matrix(const Values& values, const std::string& key) {
  const Eigen::MatrixXd* matrix = values.matrix(key);
  return matrix != nullptr ? *matrix : Eigen::MatrixXd();
}

Eigen::VectorXd given_vector(const Values& values, const std::string& key) {
  const Eigen::MatrixXd* matrix = values.matrix(key);
  return matrix != nullptr ? Eigen::VectorXd(matrix->col(0)) : Eigen::VectorXd();
}

int signal_of(const Values& values, const std::string& key) { return static_cast<int>(values.number(key, 0)); }

// The tables of `key` in one scenario: "scenario[0].load[0]", …
std::vector<std::string> tables_in(const Values& values, const std::string& scenario, const char* key) {
  return values.tables_of(scenario + "." + key);
}

// Each has its own courses.
const char* const courses_of_scenario[] = {"reference", "load", "input"};

// Which signals a row or a column of A, B or C is of.
Size size_of(const std::string& matrix, bool is_row) {
  if (is_row) return matrix == "C" ? Size::ny : Size::nx;
  return matrix == "B" ? Size::nu : Size::nx;
}

// −1: none is named, all are meant.
int entry_of(const Values& values, const std::string& table, bool is_row) {
  const std::string key = table + (is_row ? ".row" : ".column");
  const std::string name = values.text(key);
  if (name.empty()) return static_cast<int>(values.number(key, -1));
  const auto names = signal_names(values, size_of(values.text(table + ".matrix"), is_row));
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

void check_entry(const Values& values, const std::string& table, bool is_row, Report& report) {
  const std::string key = table + (is_row ? ".row" : ".column");
  const auto names = signal_names(values, size_of(values.text(table + ".matrix"), is_row));
  const int index = entry_of(values, table, is_row);
  if (index < static_cast<int>(names.size())) return;
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + in_quotes(name);
  const std::string name = values.text(key);
  report.error(key, "expected one of " + list + ", or its number from 0, found " +
                        (name.empty() ? std::to_string(index) : in_quotes(name)));
}

void check_times(const Values& values, const std::string& table, const char* begin, Report& report) {
  const double from = values.number(table + "." + begin, 0);
  if (values.number(table + ".until", design::forever) <= from)
    report.error(table + ".until", "expected more than " + std::string(begin) + " = " + shown(from) + ", found " +
                                       shown(values.number(table + ".until", 0)));
}

void check_course(const Values& values, const std::string& table, Report& report) {
  check_times(values, table, "at", report);
  std::string first;
  for (const char* shape : {".ramp", ".sine", ".csv"}) {
    if (!values.has(table + shape)) continue;
    if (!first.empty()) report.error(table + shape, "expected one of ramp, sine and csv, found " + first + ", too");
    first = shape + 1;
  }
  if (values.has(table + ".column") && !values.has(table + ".csv")) report.error(table + ".column", "needs csv");
}

void check_reference(const Values& values, const std::string& table, Report& report) {
  const auto followed = [&](const char* key) {
    const auto found = values.indices.find(key);
    if (found == values.indices.end()) return false;
    const auto& outputs = found->second;
    return std::find(outputs.begin(), outputs.end(), signal_of(values, table + ".output")) != outputs.end();
  };
  if (values.numbers.count(table + ".output") != 0 && !followed("lqr.track") && !followed("lqr.integral.outputs"))
    report.error(table + ".output",
                 "expected an output of lqr.track or lqr.integral.outputs: no other follows a "
                 "reference");
}

void check_whole_periods(const Values& values, const std::string& key, bool is_sampled, Report& report) {
  const double periods = values.number(key, 0) / values.number("plant.sample_time", 1);
  if (is_sampled && std::abs(periods - std::round(periods)) > 1e-9 * periods)
    report.error(key, "expected whole periods with a discrete plant, found " + shown(periods) + " periods");
}

void check_order(const Values& values, const std::string& table, Report& report) {
  const double least = values.number(table + ".min", -design::forever);
  const double most = values.number(table + ".max", design::forever);
  if (!(least < most))
    report.error(table + ".max", "expected min < max, found " + shown(least) + " and " + shown(most));
}

void check_plant(const Values& values, const std::string& scenario, Report& report) {
  const std::string plant = scenario + ".plant";
  const bool is_continuous = is_true(values, plant + ".continuous", false);
  if (is_continuous && !is_discrete(values)) report.error(plant + ".continuous", "needs plant.domain = \"discrete\"");
  if (is_continuous && !values.has(plant + ".A")) report.error(plant + ".A", "missing: of the continuous plant");
  for (const char* key : {".A", ".B", ".C", ".continuous", ".scale"})
    if (values.has(plant + key) && values.has("plant.f"))
      report.error(plant + key, "needs a plant of matrices; of plant.f `parameters` may be others");
  for (const char* key : {".A", ".B", ".C"})
    if (values.has(scenario + ".spread" + key) && values.has("plant.f"))
      report.error(scenario + ".spread" + key, "needs a plant of matrices: that of plant.f is simulated as it is");
  if (is_continuous && values.has("plant.B") && !values.has(plant + ".B"))
    report.error(plant + ".B", "missing: of the continuous plant");
  for (const char* key : {".A", ".B", ".C"})
    if (values.has(plant + key) && values.has("stage")) report.error(plant + key, "needs a design without [[stage]]");
  for (const std::string& table : tables_in(values, plant, "scale"))
    for (const bool is_row : {true, false}) check_entry(values, table, is_row, report);
}

// Sensors need a filter that hears them; inputs a design in which nothing else makes u.
void check_owners(const Values& values, const std::string& scenario, Report& report) {
  const bool estimates = values.has("kalman") || values.has("observer");
  const bool regulates = values.has("lqr") || values.has("pole_placement");
  for (const char* key : {".dropout", ".outlier", ".sensor"})
    if (values.has(scenario + key) && !estimates) report.error(scenario + key, "needs [kalman] or [observer]");
  for (const char* key : {".load", ".input", ".actuator"})
    if (values.has(scenario + key) && !values.has_inputs())
      report.error(scenario + key, values.has("plant.f") ? "needs plant.inputs" : "needs plant.B");
  if (values.has(scenario + ".input") && regulates)
    report.error(scenario + ".input", "needs a design without [lqr]: the regulator makes u; `load` adds to it");
}

void check_scenario(const Values& values, const std::string& scenario, Report& report) {
  const double samples = values.number(scenario + ".duration", 0) / values.number("plant.sample_time", 1);
  if (samples > most_samples)
    report.error(scenario + ".duration",
                 "expected at most " + shown(most_samples) + " samples, found " + shown(std::round(samples)));
  check_owners(values, scenario, report);
  for (const char* key : courses_of_scenario)
    for (const std::string& table : tables_in(values, scenario, key)) check_course(values, table, report);
  for (const std::string& table : tables_in(values, scenario, "reference")) check_reference(values, table, report);
  for (const std::string& table : tables_in(values, scenario, "dropout")) check_times(values, table, "from", report);
  for (const std::string& table : tables_in(values, scenario, "outlier")) check_times(values, table, "at", report);
  const bool is_sampled = is_discrete(values) && !is_true(values, scenario + ".plant.continuous", false);
  for (const std::string& table : tables_in(values, scenario, "sensor")) {
    check_order(values, table, report);
    check_whole_periods(values, table + ".delay", is_sampled, report);
  }
  for (const std::string& table : tables_in(values, scenario, "actuator")) check_order(values, table, report);
  check_whole_periods(values, scenario + ".plant.delay", is_sampled, report);
  check_plant(values, scenario, report);
}

void check_names(const Values& values, const std::vector<std::string>& tables, Report& report) {
  std::set<std::string> names;
  for (const std::string& table : tables)
    if (!names.insert(values.text(table + ".name")).second && values.has(table + ".name"))
      report.error(table + ".name", "expected a name of its own, found that of a scenario before, " +
                                        in_quotes(values.text(table + ".name")));
  const std::string wanted = values.text("require.scenario");
  if (wanted.empty() || names.count(wanted) != 0) return;
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + in_quotes(name);
  report.error("require.scenario",
               list.empty() ? "needs [[scenario]]" : "expected one of " + list + ", found " + in_quotes(wanted));
}

design::Course course(const Values& values, const std::string& table, const char* signal) {
  design::Course result;
  result.signal = signal_of(values, table + signal);
  result.value = values.number(table + ".value", result.value);
  result.at = values.number(table + ".at", result.at);
  result.until = values.number(table + ".until", result.until);
  result.ramp = values.number(table + ".ramp", result.ramp);
  result.sine = values.number(table + ".sine", result.sine);
  return result;
}

design::Outlier outlier(const Values& values, const std::string& table) {
  design::Outlier result;
  result.output = signal_of(values, table + ".output");
  result.value = values.number(table + ".value", 0);
  result.at = values.number(table + ".at", 0);
  if (values.has(table + ".until")) result.until = values.number(table + ".until", 0);
  return result;
}

design::Sensor sensor(const Values& values, const std::string& table) {
  design::Sensor result;
  result.output = signal_of(values, table + ".output");
  result.gain = values.number(table + ".gain", result.gain);
  result.bias = values.number(table + ".bias", result.bias);
  result.delay = values.number(table + ".delay", result.delay);
  result.quantum = values.number(table + ".quantum", result.quantum);
  result.min = values.number(table + ".min", result.min);
  result.max = values.number(table + ".max", result.max);
  return result;
}

design::Actuator actuator(const Values& values, const std::string& table) {
  design::Actuator result;
  result.input = signal_of(values, table + ".input");
  result.gain = values.number(table + ".gain", result.gain);
  result.time_constant = values.number(table + ".time_constant", result.time_constant);
  result.rate = values.number(table + ".rate", result.rate);
  result.min = values.number(table + ".min", result.min);
  result.max = values.number(table + ".max", result.max);
  return result;
}

design::PlantChange plant_change(const Values& values, const std::string& plant) {
  design::PlantChange result;
  result.continuous = is_true(values, plant + ".continuous", false);
  result.A = given_matrix(values, plant + ".A");
  result.B = given_matrix(values, plant + ".B");
  result.C = given_matrix(values, plant + ".C");
  if (const auto changed = values.named.find(plant + ".parameters"); changed != values.named.end())
    result.parameters = changed->second;
  if (values.has(plant + ".delay")) result.delay = values.number(plant + ".delay", 0);
  for (const std::string& table : tables_in(values, plant, "scale"))
    result.scale.push_back({values.text(table + ".matrix")[0], entry_of(values, table, true),
                            entry_of(values, table, false), values.number(table + ".factor", 1)});
  return result;
}

design::Scenario scenario_of(const Values& values, const std::string& table) {
  design::Scenario result;
  result.name = values.text(table + ".name");
  result.duration = values.number(table + ".duration", 0);
  result.x0 = given_vector(values, table + ".x0");
  result.noise = is_true(values, table + ".noise", true);
  for (const std::string& item : tables_in(values, table, "reference"))
    result.reference.push_back(course(values, item, ".output"));
  for (const std::string& item : tables_in(values, table, "load")) {
    const bool at_state = values.has(item + ".state");
    (at_state ? result.state_load : result.load).push_back(course(values, item, at_state ? ".state" : ".input"));
  }
  for (const std::string& item : tables_in(values, table, "input"))
    result.input.push_back(course(values, item, ".input"));
  for (const std::string& item : tables_in(values, table, "dropout"))
    result.dropout.push_back({signal_of(values, item + ".output"), values.number(item + ".from", 0),
                              values.number(item + ".until", design::forever)});
  for (const std::string& item : tables_in(values, table, "outlier")) result.outlier.push_back(outlier(values, item));
  for (const std::string& item : tables_in(values, table, "sensor")) result.sensor.push_back(sensor(values, item));
  for (const std::string& item : tables_in(values, table, "actuator"))
    result.actuator.push_back(actuator(values, item));
  result.plant = plant_change(values, table + ".plant");
  const std::string spread = table + ".spread";
  result.spread = {values.number(spread + ".A", 0), values.number(spread + ".B", 0), values.number(spread + ".C", 0),
                   given_vector(values, spread + ".x0")};
  return result;
}

// The signal that a course belongs to, whose name its column has.
std::string name_of_signal(const Values& values, const std::string& table, const design::Course& course) {
  const Size size = values.has(table + ".output") ? Size::ny : values.has(table + ".state") ? Size::nx : Size::nu;
  return signal_names(values, size)[static_cast<std::size_t>(course.signal)];
}

void load_column(const Values& values, const std::filesystem::path& folder, const std::string& table,
                 design::Course& course, Report& report) {
  const std::string key = table + ".csv";
  const std::string column =
      values.has(table + ".column") ? values.text(table + ".column") : name_of_signal(values, table, course);
  const auto read = read_columns((folder / values.text(key)).string(), {"t", column});
  if (const std::string* wrong = std::get_if<std::string>(&read)) return report.error(key, *wrong);
  const Columns& columns = std::get<Columns>(read);
  course.times = columns.values[0];
  course.column = columns.values[1];
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(course.times.begin(), course.times.end(), finite) ||
      !std::all_of(course.column.begin(), course.column.end(), finite))
    report.error(key, "expected finite numbers, found a field that is missing or not finite");
  else if (!std::is_sorted(course.times.begin(), course.times.end()))
    report.error(key, "expected times t that rise, found one before another");
}

}  // namespace

void check_scenarios(const Values& values, Report& report) {
  const std::vector<std::string> tables = values.tables_of("scenario");
  if (tables.size() > most_scenarios)
    return report.error(
        "scenario", "expected at most " + std::to_string(most_scenarios) + ", found " + std::to_string(tables.size()));
  for (const std::string& table : tables) check_scenario(values, table, report);
  check_names(values, tables, report);
  for (const char* key : {"require.overshoot", "require.settling_time", "require.share_at_limits", "require.rms"})
    if (values.has(key) && tables.empty()) report.error(key, "needs [[scenario]], in which it is measured");
}

std::vector<design::Scenario> scenarios(const Values& values) {
  std::vector<design::Scenario> result;
  for (const std::string& table : values.tables_of("scenario")) result.push_back(scenario_of(values, table));
  return result;
}

void load_columns(const Values& values, const std::optional<std::filesystem::path>& folder,
                  std::vector<design::Scenario>& scenarios, Report& report) {
  const std::vector<std::string> tables = values.tables_of("scenario");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    std::size_t of_input = 0, of_state = 0;
    const auto load = [&](const std::string& table, design::Course& course) {
      if (!values.has(table + ".csv")) return;
      if (!folder)
        report.error(table + ".csv", "no file can be read here");
      else
        load_column(values, *folder, table, course, report);
    };
    std::size_t k = 0;
    for (const std::string& table : tables_in(values, tables[i], "reference")) load(table, scenarios[i].reference[k++]);
    k = 0;
    for (const std::string& table : tables_in(values, tables[i], "input")) load(table, scenarios[i].input[k++]);
    for (const std::string& table : tables_in(values, tables[i], "load"))
      load(table, values.has(table + ".state") ? scenarios[i].state_load[of_state++] : scenarios[i].load[of_input++]);
  }
}

}  // namespace lqg::input
