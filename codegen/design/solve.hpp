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

// Does the problem make sense, before anything is solved? Without an error in `findings` it does.
bool is_well_posed(const Problem& problem, Findings& findings);

// A first look, several times faster, for a person who moves a weight and watches the curves: gains, poles, margins at
// the inputs and rms from one run with 50 digits. No second run has judged their roundings, loop.at_output and
// loop.rounded are empty, and nothing that makes a design impossible or a note is looked for beyond what keeps this run
// from its end: then it is empty, and solve() tells why. Not for code.
std::optional<Solution> first_look(const Problem& problem);

// `problem` for who wants to see a design that misses what is required: nothing is required of it, but what an
// automatic recovery (TransferRecovery) has to find a q for.
Problem without_requirements(Problem problem);

}  // namespace lqg::design
