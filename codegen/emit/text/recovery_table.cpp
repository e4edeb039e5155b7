// SPDX-License-Identifier: MIT
#include "emit/text/recovery_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "emit/text/html.hpp"

namespace lqg::emit {

namespace {

using design::RecoveryPoint;
using design::RecoveryReport;

const std::string dash = "–";

std::optional<double> cost_ratio(const RecoveryReport& report, const RecoveryPoint& point) {
  const std::optional<double>& without = report.points.front().cost_per_sample;
  if (!without || !point.cost_per_sample || !(*without > 0)) return std::nullopt;
  return *point.cost_per_sample / *without;
}

// "+1.6 %", and from the double on "11 times".
std::string cost_in_words(const std::optional<double>& ratio) {
  if (!ratio) return dash;
  if (*ratio >= 2) return decimal(*ratio) + " times";
  char text[32];
  std::snprintf(text, sizeof text, "%+.3g %%", 100 * (*ratio - 1));
  return text;
}

// "0.69, 6.25 dB": the factor (2 + α)/(2 − α) by which all gains may rise or fall.
std::string disk_in_words(const std::optional<double>& disk) {
  if (!disk) return dash;
  if (!(*disk < 2)) return decimal(*disk);
  return decimal(*disk) + ", " + decimal(20 * std::log10((2 + *disk) / (2 - *disk))) + " dB";
}

std::string phase_in_words(const design::Margins& margins) {
  if (margins.phase_deg) return decimal(*margins.phase_deg) + "°";
  return margins.disk ? "∞" : dash;
}

std::string q_in_words(const RecoveryReport& report, const RecoveryPoint& point) {
  return decimal(point.q) + (point.q == report.q ? ", this design" : "");
}

}  // namespace

std::vector<std::vector<std::string>> recovery_table(const Controller& controller) {
  if (!controller.solution.loop.recovery) return {};
  const RecoveryReport& report = *controller.solution.loop.recovery;
  const bool has_cost = std::any_of(report.points.begin(), report.points.end(),
                                    [](const RecoveryPoint& point) { return point.cost_per_sample.has_value(); });
  std::vector<std::vector<std::string>> rows = {{"q", "disk margin", "phase margin"}};
  if (has_cost) rows.front().push_back("cost, beside q = 0");
  for (const RecoveryPoint& point : report.points) {
    rows.push_back({q_in_words(report, point), disk_in_words(point.at_input.disk), phase_in_words(point.at_input)});
    if (has_cost) rows.back().push_back(cost_in_words(cost_ratio(report, point)));
  }
  return rows;
}

std::string recovery_in_words(const Controller& controller) {
  const RecoveryReport& report = *controller.solution.loop.recovery;
  std::string out = "The gain of the filter is that of more noise, q B Bᵀ at the inputs, than there is. ";
  for (const RecoveryPoint& point : report.points) {
    if (point.q != report.q || point.q == 0) continue;
    const std::optional<double> ratio = cost_ratio(report, point);
    if (ratio && *ratio >= 2)
      out += "This design costs " + decimal(*ratio) + " times as much as the one without it. ";
    else if (ratio)
      out += "This design costs " + decimal(100 * (*ratio - 1)) + " % more than the one without it. ";
  }
  return out + "Costs, rms and covariances are those of the noise itself.";
}

std::string describe_recovery(const Controller& controller) {
  const std::vector<std::vector<std::string>> rows = recovery_table(controller);
  if (rows.empty()) return "";
  std::vector<std::size_t> widths(rows.front().size());
  for (const std::vector<std::string>& row : rows)
    for (std::size_t j = 0; j < row.size(); ++j) widths[j] = std::max(widths[j], letters(row[j]));
  std::string out = "\nLoop transfer recovery, L of W + q B Bᵀ, margins at the inputs:\n\n";
  for (const std::vector<std::string>& row : rows) {
    std::string line = " ";
    for (std::size_t j = 0; j < row.size(); ++j)
      line += " " + row[j] + std::string(j + 1 < row.size() ? widths[j] - letters(row[j]) + 2 : 0, ' ');
    out += line + "\n";
  }
  return out;
}

}  // namespace lqg::emit
