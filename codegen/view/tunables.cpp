// SPDX-License-Identifier: MIT
#include "view/tunables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "input/edit.hpp"
#include "view/tunable_poles.hpp"

namespace lqg::view {

namespace {

using design::Signal;
using input::PlacedNumber;

enum class Named { nothing, states, inputs, outputs, noises, integrals };
enum class Span { point, weight, largest, time, limit, rate, walk, delay, steps, gate, spike, decay };

struct Rule {
  const char* key;
  const char* words;
  Named named;
  Span span;
  const char* unit = "";  // of a number alone
};

// clang-format off
const Rule rules[] = {
    {"plant.sample_time", "Timing", Named::nothing, Span::time, "s"},
    {"plant.delay", "Timing", Named::nothing, Span::delay, "s"},
    {"plant.operating_point.states", "Operating point", Named::states, Span::point},
    {"plant.operating_point.inputs", "Operating point", Named::inputs, Span::point},
    {"lqr.Q", "Weights of the states", Named::states, Span::weight},
    {"lqr.Q_output", "Weights of the outputs", Named::outputs, Span::weight},
    {"lqr.R", "Weights of the inputs", Named::inputs, Span::weight},
    {"lqr.Q_final", "Weights at the end of the horizon", Named::states, Span::weight},
    {"lqr.bryson.states", "Largest acceptable states", Named::states, Span::largest},
    {"lqr.bryson.outputs", "Largest acceptable outputs", Named::outputs, Span::largest},
    {"lqr.bryson.inputs", "Largest acceptable inputs", Named::inputs, Span::largest},
    {"lqr.bryson.rho", "Factor of R", Named::nothing, Span::weight},
    {"lqr.integral.Q", "Weights of the integrals", Named::integrals, Span::weight},
    {"lqr.input_rate", "Weights of the changes of the inputs", Named::inputs, Span::weight},
    {"lqr.decay", "Decay", Named::nothing, Span::decay},
    {"lqr.settling_time", "Timing", Named::nothing, Span::time, "s"},
    {"lqr.horizon", "Horizon of the regulator", Named::nothing, Span::steps, "samples"},
    {"kalman.process_noise", "Process noise", Named::noises, Span::weight},
    {"kalman.measurement_noise", "Measurement noise", Named::outputs, Span::weight},
    {"kalman.initial_covariance", "Initial covariance", Named::states, Span::weight},
    {"kalman.process_correlation_time", "Correlation times of the process noise", Named::noises, Span::time},
    {"kalman.measurement_correlation_time", "Correlation times of the measurement noise", Named::outputs, Span::time},
    {"kalman.horizon", "Horizon of the filter", Named::nothing, Span::steps, "samples"},
    {"kalman.disturbance", "Disturbances", Named::inputs, Span::walk},
    {"kalman.recovery", "Loop transfer recovery", Named::nothing, Span::weight},
    {"kalman.gate", "Gates", Named::nothing, Span::gate, "σ"},
    {"kalman.spike", "Gates", Named::nothing, Span::spike, "σ"},
    {"limits.u_min", "Smallest inputs", Named::inputs, Span::limit},
    {"limits.u_max", "Largest inputs", Named::inputs, Span::limit},
    {"limits.u_rate", "Largest rates of the inputs", Named::inputs, Span::rate},
};
// clang-format on

// "lqr.Q" and {1} of "lqr.Q[1]"; "kalman.disturbance" and "voltage" of "kalman.disturbance.voltage".
struct SplitKey {
  std::string base;
  std::vector<std::size_t> indices;
  std::string name = {};
};

SplitKey split(const std::string& key) {
  static const std::string by_name = "kalman.disturbance";
  if (key.rfind(by_name + ".", 0) == 0) return {by_name, {}, key.substr(by_name.size() + 1)};
  SplitKey result = {key.substr(0, key.find('[')), {}};
  for (std::size_t at = result.base.size(); at < key.size() && key[at] == '['; at = key.find(']', at) + 1)
    result.indices.push_back(static_cast<std::size_t>(std::stoul(key.substr(at + 1))));
  return result;
}

const Rule* rule_of(const std::string& base) {
  const auto found =
      std::find_if(std::begin(rules), std::end(rules), [&](const Rule& rule) { return base == rule.key; });
  return found == std::end(rules) ? nullptr : found;
}

// A process noise has the name of its state where it enters that state alone, as without a G.
std::vector<Signal> noises(const input::DesignFile& file) {
  if (file.locations.count("plant.G") == 0) return file.problem->plant.states;
  std::vector<Signal> names;
  for (Eigen::Index i = 0; i < file.problem->plant.G.cols(); ++i) names.push_back({"w" + std::to_string(i), ""});
  return names;
}

std::vector<Signal> names_of(Named named, const input::DesignFile& file) {
  const design::Problem& problem = *file.problem;
  switch (named) {
    case Named::states: return problem.plant.states;
    case Named::inputs: return problem.plant.inputs;
    case Named::outputs: return problem.plant.outputs;
    case Named::noises: return noises(file);
    case Named::integrals: break;
    case Named::nothing: return {};
  }
  std::vector<Signal> names;
  if (problem.regulator && problem.regulator->integral)
    for (const int output : problem.regulator->integral->outputs)
      names.push_back(problem.plant.outputs[static_cast<std::size_t>(output)]);
  return names;
}

// The entry of a vector or of a diagonal; nothing beside the diagonal. Of walks the place of the name: without names
// the file has indices, which nobody turns.
std::optional<std::size_t> entry(const Rule& rule, const SplitKey& key, const std::vector<Signal>& names) {
  if (rule.span == Span::walk) {
    const auto has_name = [&](const Signal& signal) { return signal.name == key.name; };
    const auto found = std::find_if(names.begin(), names.end(), has_name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
  }
  if (key.indices.empty()) return 0;
  const bool is_beside = key.indices.size() > 2 || (key.indices.size() == 2 && key.indices[0] != key.indices[1]);
  return is_beside ? std::nullopt : std::optional(key.indices[0]);
}

// The parameter whose value the number at `key` is: "parameters.R" or "parameters.R.value".
const design::Parameter* parameter_at(const std::string& key, const input::DesignFile& file) {
  static const std::string table = "parameters.", value = ".value";
  if (key.rfind(table, 0) != 0) return nullptr;
  std::string name = key.substr(table.size());
  if (const std::size_t dot = name.find('.'); dot != name.npos && name.substr(dot) == value) name.resize(dot);
  for (const design::Parameter& parameter : file.problem->parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

std::string last_word(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// "(rad/s)/s" of a rate, "V/√s" of a walk, "V" of a limit; nothing of a weight, whose unit nobody thinks in.
std::string unit_of(const Rule& rule, const std::string& unit) {
  if (rule.span == Span::time) return "s";
  if (unit.empty() || rule.span == Span::weight) return "";
  if (rule.span == Span::rate || rule.span == Span::walk)
    return (unit.find_first_of("/ ") == unit.npos ? unit : "(" + unit + ")") + (rule.span == Span::rate ? "/s" : "/√s");
  return unit;
}

void set_name(Tunable& tunable, const Rule& rule, std::size_t index, const std::vector<Signal>& names) {
  tunable.group = std::string(rule.words);
  if (rule.named == Named::nothing) {
    tunable.name = last_word(rule.key);
    tunable.unit = rule.unit;
    return;
  }
  tunable.group += ", " + std::string(rule.key);
  const Signal signal = index < names.size() ? names[index] : Signal{std::to_string(index), ""};
  tunable.name = signal.name;
  tunable.unit = unit_of(rule, signal.unit);
}

void span_decades(Tunable& tunable, double factor) {
  tunable.scale = Scale::logarithmic;
  tunable.low = tunable.value / factor;
  tunable.high = tunable.value * factor;
}

// A straight scale that holds the value and has 0 on one of its ends.
void span_from_zero(Tunable& tunable, double otherwise) {
  const double far = tunable.value != 0 ? 4 * tunable.value : otherwise;
  tunable.low = std::min(0.0, far);
  tunable.high = std::max(0.0, far);
}

void span_delay(Tunable& tunable, const design::Plant& plant) {
  tunable.high = std::max(2 * tunable.value, 5 * plant.sample_time);
  if (plant.domain == design::Domain::discrete) tunable.step = plant.sample_time;
}

// Twice the number to both sides, or 1.
void span_both_sides(Tunable& tunable) {
  tunable.high = tunable.value == 0 ? 1 : 2 * std::abs(tunable.value);
  tunable.low = -tunable.high;
}

// α of a continuous cost is a rate from 0 on; of samples a factor from 1 on.
void span_decay(Tunable& tunable, const design::Problem& problem) {
  if (problem.regulator && problem.regulator->cost == design::Cost::continuous) return span_from_zero(tunable, 1);
  tunable.low = 1;
  tunable.high = std::max(1.05, 1 + 4 * (tunable.value - 1));
}

void set_range(Tunable& tunable, const Rule& rule, double largest, const design::Problem& problem) {
  const bool has_decades = tunable.value > 0;
  switch (rule.span) {
    case Span::point: span_both_sides(tunable); break;
    case Span::weight: has_decades ? span_decades(tunable, 1000) : span_from_zero(tunable, largest); break;
    case Span::largest: span_decades(tunable, 30); break;
    case Span::time: span_decades(tunable, 10); break;
    case Span::rate: span_decades(tunable, 10); break;
    case Span::walk: span_decades(tunable, 100); break;
    case Span::spike: span_decades(tunable, 10); break;
    case Span::limit: span_from_zero(tunable, largest); break;
    case Span::delay: span_delay(tunable, problem.plant); break;
    case Span::gate: tunable.high = std::max(10.0, 2 * tunable.value); break;
    case Span::decay: span_decay(tunable, problem); break;
    case Span::steps:
      tunable.scale = Scale::whole;
      tunable.high = tunable.value > 0 ? std::min<double>(design::most_steps, 4 * tunable.value) : 200;
      break;
  }
}

// From a tenth to ten times its value.
Tunable tunable_parameter(const PlacedNumber& number, const design::Parameter& parameter) {
  Tunable tunable;
  tunable.group = "Parameters";
  tunable.name = parameter.name;
  tunable.unit = parameter.unit;
  tunable.targets = {{number.key, 1}};
  tunable.value = number.value;
  number.value > 0 ? span_decades(tunable, 10) : span_from_zero(tunable, 1);
  return tunable;
}

// Numbers that have a default and that a person wants to move: they are added to the file when they are written.
std::vector<PlacedNumber> absent_numbers(const input::DesignFile& file) {
  std::vector<PlacedNumber> numbers;
  const auto add = [&](const std::string& key, const char* table, double value) {
    if (file.locations.count(key) == 0 && file.locations.count(table) != 0) numbers.push_back({key, value, 0, 0});
  };
  if (file.problem->regulator) add("plant.delay", "plant", 0);
  add("lqr.bryson.rho", "lqr.bryson", 1);
  return numbers;
}

using Largest = std::map<std::string, double>;  // by the first word of a key's rule

Largest largest_numbers(const std::vector<PlacedNumber>& numbers) {
  Largest largest;
  for (const PlacedNumber& number : numbers)
    if (std::isfinite(number.value)) {
      const std::string base = split(number.key).base;
      double& size = largest[base.rfind("limits.u_m", 0) == 0 ? "limits" : base];
      size = std::max(size, std::abs(number.value));
    }
  return largest;
}

double largest_beside(const Largest& largest, const std::string& base) {
  const auto found = largest.find(base.rfind("limits.u_m", 0) == 0 ? "limits" : base);
  return found == largest.end() || found->second == 0 ? 1 : found->second;
}

}  // namespace

std::vector<Tunable> tunables(const input::DesignFile& file) {
  std::vector<PlacedNumber> numbers = input::numbers_of(file.text);
  const Largest largest = largest_numbers(numbers);
  std::vector<PlacedNumber> absent = absent_numbers(file);
  numbers.insert(numbers.begin(), absent.begin(), absent.end());
  std::vector<Tunable> result;
  for (const PlacedNumber& number : numbers) {
    if (const design::Parameter* parameter = parameter_at(number.key, file)) {
      result.push_back(tunable_parameter(number, *parameter));
      continue;
    }
    const SplitKey key = split(number.key);
    const Rule* const rule = rule_of(key.base);
    if (rule == nullptr || !std::isfinite(number.value)) continue;
    const std::vector<Signal> names = names_of(rule->named, file);
    const std::optional<std::size_t> index = entry(*rule, key, names);
    if (!index) continue;
    Tunable tunable;
    tunable.targets = {{number.key, 1}};
    tunable.value = number.value;
    set_name(tunable, *rule, *index, names);
    set_range(tunable, *rule, largest_beside(largest, key.base), *file.problem);
    result.push_back(tunable);
  }
  const std::vector<Tunable> poles = tunable_poles(numbers);
  result.insert(result.end(), poles.begin(), poles.end());
  return result;
}

}  // namespace lqg::view
