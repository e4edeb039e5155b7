// SPDX-License-Identifier: MIT
#include "input/unit_check.hpp"

#include <optional>
#include <utility>
#include <variant>

namespace lqg::input {
namespace {

using expression::Measure;
using expression::Unit;
using OptionalUnit = std::optional<Unit>;  // nothing: not known

// What the entries of a key are measured in: of signals in rows and columns, and per second.
enum class Rate { none, of_plant, per_second };

struct Place {
  const char* rule;
  const char* rows;     // key of the signals whose unit an entry has; nullptr: that of `unit`
  const char* columns;  // key of the signals by whose unit it is divided, or nullptr
  Rate rate = Rate::none;
  const char* unit = "";
};

constexpr const char* states = "plant.states";
constexpr const char* inputs = "plant.inputs";
constexpr const char* outputs = "plant.outputs";

// clang-format off
constexpr Place known_places[] = {
    {"plant.A", states, states, Rate::of_plant},
    {"plant.B", states, inputs, Rate::of_plant},
    {"plant.C", outputs, states},
    {"plant.D", outputs, inputs},
    {"stage.A", states, states, Rate::of_plant},
    {"stage.B", states, inputs, Rate::of_plant},
    {"stage.C", outputs, states},
    {"stage.D", outputs, inputs},
    {"lqr.bryson.states", states, nullptr},
    {"lqr.bryson.outputs", outputs, nullptr},
    {"lqr.bryson.inputs", inputs, nullptr},
    {"kalman.initial_state", states, nullptr},
    {"kalman.output_min", outputs, nullptr},
    {"kalman.output_max", outputs, nullptr},
    {"limits.u_min", inputs, nullptr},
    {"limits.u_max", inputs, nullptr},
    {"limits.u_rate", inputs, nullptr, Rate::per_second},
    {"limits.states", states, nullptr},
    {"limits.outputs", outputs, nullptr},
    {"limits.output_rates", outputs, nullptr, Rate::per_second},
    {"scenario.x0", states, nullptr},
    {"plant.sample_time", nullptr, nullptr, Rate::none, "s"},
    {"plant.delay", nullptr, nullptr, Rate::none, "s"},
    {"plant.output_delay", nullptr, nullptr, Rate::none, "s"},
    {"plant.jitter", nullptr, nullptr, Rate::none, "s"},
    {"lqr.settling_time", nullptr, nullptr, Rate::none, "s"},
    {"kalman.process_correlation_time", nullptr, nullptr, Rate::none, "s"},
    {"kalman.measurement_correlation_time", nullptr, nullptr, Rate::none, "s"},
    {"require.delay_margin", nullptr, nullptr, Rate::none, "s"},
    {"require.settling_time", nullptr, nullptr, Rate::none, "s"},
    {"scenario.duration", nullptr, nullptr, Rate::none, "s"},
    {"scenario.spread.x0", states, nullptr}};
// clang-format on

// The indices behind a key, {1, 0} of "plant.A[1][0]", or the name, "speed" of "limits.states.speed".
struct EntryOfKey {
  std::vector<std::size_t> indices;
  std::string name;
};

const Place* place_of(const std::string& rule) {
  const Place* best = nullptr;
  for (const Place& place : known_places)
    if (rule == place.rule || (rule.rfind(std::string(place.rule) + ".", 0) == 0 && place.rows != nullptr))
      best = &place;
  return best;
}

// The indices at the end of the key alone: not those of "stage[1]".
EntryOfKey entry_behind(const std::string& key, const Place& place) {
  EntryOfKey entry;
  const std::string rule = rule_path(key), base = place.rule;
  if (rule.size() > base.size()) {
    entry.name = rule.substr(base.size() + 1);
    return entry;
  }
  const std::size_t last_name = key.rfind('.') == key.npos ? 0 : key.rfind('.');
  for (std::size_t at = key.find('[', last_name); at != key.npos; at = key.find('[', at + 1))
    entry.indices.push_back(std::stoul(key.substr(at + 1)));
  return entry;
}

// The unit of a signal of the file.
OptionalUnit unit_of_signal(const Values& values, const char* key, std::size_t index) {
  const Measure measure = measure_of_signal(values, key, index);
  return measure.kind == Measure::Kind::known ? OptionalUnit(measure.unit) : std::nullopt;
}

std::optional<std::size_t> index_of_name(const Values& values, const char* key, const std::string& name) {
  const auto found = values.signals.find(key);
  if (found == values.signals.end()) return std::nullopt;
  const std::string bare = name.substr(0, name.find_first_of(" ["));
  for (std::size_t i = 0; i < found->second.size(); ++i)
    if (found->second[i].name == bare) return i;
  return std::nullopt;
}

// What the formula at `key` has to be measured in.
OptionalUnit expected_unit(const Values& values, const std::string& key) {
  const Place* place = place_of(rule_path(key));
  if (place == nullptr) return std::nullopt;
  if (place->rows == nullptr) return expression::parse_unit(place->unit);
  const EntryOfKey entry = entry_behind(key, *place);
  const std::optional<std::size_t> row =
      entry.indices.empty() ? index_of_name(values, place->rows, entry.name) : std::optional(entry.indices[0]);
  OptionalUnit unit = row ? unit_of_signal(values, place->rows, *row) : std::nullopt;
  if (unit && place->columns != nullptr) {
    if (entry.indices.size() < 2) return std::nullopt;
    const OptionalUnit column = unit_of_signal(values, place->columns, entry.indices[1]);
    unit = column ? OptionalUnit(*unit / *column) : std::nullopt;
  }
  const bool is_rate =
      place->rate == Rate::per_second || (place->rate == Rate::of_plant && values.text("plant.domain") != "discrete");
  return unit && is_rate ? OptionalUnit(*unit / *expression::parse_unit("s")) : unit;
}

void check_formula(const PlacedFormula& placed, const Parameters& parameters, const Values& values,
                   const FormulaPlaces& places, Report& report) {
  const auto measured = expression::measure_of(*placed.node.formula->tree, measure_of_parameters(parameters));
  if (const auto* fault = std::get_if<expression::Fault>(&measured))
    return report.error(placed.key, places.of(placed.node, fault->at), fault->message);
  const Measure& found = std::get<Measure>(measured);
  const OptionalUnit expected = expected_unit(values, placed.key);
  if (found.kind != Measure::Kind::known || !expected || is_same(found.unit, *expected)) return;
  report.error(placed.key, placed.node.where,
               "expected an expression in " + expression::in_words(*expected) + ", found one in " +
                   expression::in_words(found.unit) + (is_like(found.unit, *expected) ? ": convert it" : ""));
}

}  // namespace

Measure measure_of_unit(const std::string& unit) {
  if (unit.empty()) return {};
  const OptionalUnit parsed = expression::parse_unit(unit);
  return parsed ? Measure{Measure::Kind::known, *parsed} : Measure();
}

Measure measure_of_signal(const Values& values, const std::string& key, std::size_t index) {
  const auto found = values.signals.find(key);
  if (found == values.signals.end() || index >= found->second.size()) return {};
  return measure_of_unit(found->second[index].unit);
}

void check_units(const Formulas& formulas, const Parameters& parameters, const Values& values,
                 const FormulaPlaces& places, Report& report) {
  for (const PlacedFormula& placed : formulas.all) check_formula(placed, parameters, values, places, report);
}

}  // namespace lqg::input
