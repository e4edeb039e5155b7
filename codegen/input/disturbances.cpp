// SPDX-License-Identifier: MIT
#include "input/disturbances.hpp"

#include <algorithm>
#include <cmath>

#include "input/matrices.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

// 0: not said.
double entry_of(const Values& values, const char* key, int i) {
  const Eigen::MatrixXd* vector = values.matrix(key);
  if (vector == nullptr || i >= vector->rows()) return 0;
  const double value = std::abs((*vector)(i, 0));
  return std::isfinite(value) ? value : 0;
}

// Of a limit its distance from the operating point.
double reach_of(const Values& values, const char* key, int input) {
  const Eigen::MatrixXd* limits = values.matrix(key);
  const Eigen::MatrixXd* point = values.matrix("plant.operating_point.inputs");
  if (limits == nullptr || point == nullptr || input >= std::min(limits->rows(), point->rows()))
    return entry_of(values, key, input);
  const double reach = std::abs((*limits)(input, 0) - (*point)(input, 0));
  return std::isfinite(reach) ? reach : 0;
}

double size_of_input(const Values& values, int input) {
  const double limit = std::max(reach_of(values, "limits.u_min", input), reach_of(values, "limits.u_max", input));
  return limit > 0 ? limit : entry_of(values, "lqr.bryson.inputs", input);
}

void check_sizes(const Values& values, Report& report) {
  const std::string key = "kalman.disturbance";
  const auto found = values.indices.find(key);
  if (found == values.indices.end() || values.matrix(key) != nullptr) return;
  const std::vector<std::string> names = signal_names(values, Size::nu);
  for (const int input : found->second) {
    if (default_disturbance(values, input)) continue;
    const std::size_t at = static_cast<std::size_t>(input);
    const std::string name = at < names.size() ? names[at] : "u" + std::to_string(input);
    report.error(key, "expected the size of the disturbance in the unit of " + name + " per √s, as in { " + name +
                          " = 0.5 }: neither limits nor lqr.bryson.inputs tell the size of the input");
  }
}

// A multiple of the sample time, up to what typing rounded numbers explains.
void check_late_output(const Values& values, int output, double delay, Report& report) {
  const std::string key = "plant.output_delay";
  const double T = values.number("plant.sample_time", 0), periods = delay / T, below = std::floor(periods);
  const std::vector<std::string> names = signal_names(values, Size::ny);
  const std::string of = " for " + names[static_cast<std::size_t>(output)];
  if (!(delay >= 0) || std::isinf(delay)) return report.error(key, "expected numbers ≥ 0, found " + shown(delay) + of);
  if (!(T > 0) || std::abs(periods - std::round(periods)) <= 1e-9 * periods) return;
  report.error(key, "expected whole periods of plant.sample_time, " + shown(below * T, 6) + " or " +
                        shown((below + 1) * T, 6) + ", found " + shown(delay) + of);
}

double late_states(const Values& values, Report& report) {
  const Eigen::MatrixXd* delays = values.matrix("plant.output_delay");
  const double T = values.number("plant.sample_time", 0);
  double states = 0;
  for (int i = 0; delays != nullptr && i < delays->rows(); ++i) {
    check_late_output(values, i, (*delays)(i, 0), report);
    if (T > 0) states += std::max(0.0, std::round((*delays)(i, 0) / T));
  }
  return states;
}

}  // namespace

std::optional<double> default_disturbance(const Values& values, int input) {
  constexpr double share = 0.001;
  const double size = size_of_input(values, input), T = values.number("plant.sample_time", 0);
  if (!(size > 0) || !(T > 0)) return std::nullopt;
  return share * size / std::sqrt(T);
}

void check_added_states(const Values& values, Report& report) {
  check_sizes(values, report);
  const auto disturbances = values.indices.find("kalman.disturbance");
  const double disturbed = disturbances == values.indices.end() ? 0 : static_cast<double>(disturbances->second.size());
  const double late = late_states(values, report);
  const double nx = values.sizes.at(Size::nx), nu = std::max(0, values.sizes.at(Size::nu));
  const double on_their_way = std::ceil(values.number("plant.delay", 0) / values.number("plant.sample_time", 1)) * nu;
  const double all = nx + disturbed + late + on_their_way;
  if (disturbed + late > 0 && nx > 0 && all > most_signals)
    report.error(late > 0 ? "plant.output_delay" : "kalman.disturbance",
                 "expected at most " + std::to_string(most_signals) +
                     " states together with disturbances, outputs and inputs on their way, found " + shown(all));
}

}  // namespace lqg::input
