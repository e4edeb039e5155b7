// SPDX-License-Identifier: MIT
#include "design/checks/requirements.hpp"

#include <algorithm>
#include <cstdio>

namespace lqg::design {

namespace {

std::string text_of(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// With as many digits as it takes to tell the two apart.
std::string compared(const char* limit, double required, double found, const char* unit) {
  const char* format = text_of(required, "%.6g") != text_of(found, "%.6g") ? "%.6g" : "%.17g";
  return std::string("requires ") + limit + " " + text_of(required, format) + unit + ", the loop has " +
         text_of(found, format) + unit;
}

void check_margin(const std::optional<double>& required, const std::optional<double>& found, bool has_loop,
                  const char* key, const char* unit, Findings& findings) {
  if (!required) return;
  if (!has_loop)
    add_error(findings, key, "there is no stable loop of a regulator around this plant that could have it");
  else if (found && *found < *required)
    add_error(findings, key, compared("at least", *required, *found, unit));
}

}  // namespace

void check_requirements(const Problem& problem, const Solution& solution, Findings& findings) {
  const Requirements& require = problem.requirements;
  const Margins& margins = solution.loop.at_input;
  const bool has_loop = margins.disk.has_value();
  check_margin(require.gain_margin_dB, margins.gain_dB, has_loop, "require.gain_margin_dB", " dB", findings);
  check_margin(require.phase_margin_deg, margins.phase_deg, has_loop, "require.phase_margin_deg", "°", findings);
  check_margin(require.disk_margin, margins.disk, has_loop, "require.disk_margin", "", findings);
  if (!require.max_pole) return;
  double largest = 0;
  for (const std::complex<double>& pole : solution.loop.poles) largest = std::max(largest, std::abs(pole));
  if (largest > *require.max_pole)
    add_error(findings, "require.max_pole", compared("no pole beyond |z| =", *require.max_pole, largest, ""));
}

}  // namespace lqg::design
