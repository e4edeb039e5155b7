// SPDX-License-Identifier: MIT
// The door to the design engine: from a problem to its solution.
#pragma once

#include <optional>

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/progress.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// Solves `problem`. Empty, with at least one error in `findings`, when the design is impossible; the culprit is named
// (mode, states that take part, key). Notes may come with a solution. `progress` gets a line about every second.
std::optional<Solution> solve(const Problem& problem, Findings& findings, const Progress& progress = {});

}  // namespace lqg::design
