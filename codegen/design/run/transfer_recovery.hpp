// SPDX-License-Identifier: MIT
// Loop transfer recovery: how much noise the filter is told of that is not there.
#pragma once

#include "design/run/design_run.hpp"

namespace lqg::design {

// Errors under "kalman.recovery" where it has no meaning: a filter without a regulator, one that carries its
// covariance, a gain with a structure; and where "auto" has nothing to meet.
void check_recovery(const Problem& problem, Findings& findings);

// `problem` with the smallest q of two digits with which the loop has the margins and poles that are required of it,
// in place of "auto"; 0 where it has them without. Upwards in steps 1, 2, 5, 10, from where the fictitious noise is
// nothing beside the plant's own, to where more of it changes nothing; then by bisection between two of these. Where
// the margins do not rise with q, there may be a smaller one between two steps. Empty with an error where no q is
// enough: it says what the best one reaches, and for which cost. By runs in 50 digits.
std::optional<Problem> with_found_recovery(const Problem& problem, Findings& findings);

// What without it, and less or more of it, would give; that of the design itself from `loop`, which is described.
RecoveryReport recovery_report(const Problem& problem, const LoopSolution& loop);

// In words: what was found, and what it costs; that it costs much; that it is of no use.
void note_recovery(const Problem& problem, const LoopSolution& loop, bool was_found, Findings& findings);

}  // namespace lqg::design
