// SPDX-License-Identifier: MIT
#include "design/checks/requirements.hpp"

#include <algorithm>

namespace lqg::design {

namespace {

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
  const std::optional<double> delay =
      margins.delay_samples ? std::optional(*margins.delay_samples * problem.plant.sample_time) : std::nullopt;
  check_margin(require.delay_margin, delay, has_loop, "require.delay_margin", " s", findings);
  if (!require.max_pole) return;
  double largest = 0;
  for (const std::complex<double>& pole : solution.loop.poles) largest = std::max(largest, std::abs(pole));
  if (largest > *require.max_pole)
    add_error(findings, "require.max_pole", compared("no pole beyond |z| =", *require.max_pole, largest, ""));
}

}  // namespace lqg::design
