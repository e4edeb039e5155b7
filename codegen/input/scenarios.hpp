// SPDX-License-Identifier: MIT
// The scenarios of a design file, and what [require] asks of them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "design/problem.hpp"
#include "input/report.hpp"
#include "input/values.hpp"

namespace lqg::input {

constexpr double most_samples = 1e6;  // of a scenario
constexpr int most_scenarios = 100;

// What one key alone does not tell.
void check_scenarios(const Values& values, Report& report);

// Of values that have passed the check.
std::vector<design::Scenario> scenarios(const Values& values);

// Reads the columns that courses name. Files are sought from `folder` on; without one none may be named.
void load_columns(const Values& values, const std::optional<std::filesystem::path>& folder,
                  std::vector<design::Scenario>& scenarios, Report& report);

}  // namespace lqg::input
