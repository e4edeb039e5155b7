// SPDX-License-Identifier: MIT
// What is formally right and of little use: notes, each with the key to look at.
#pragma once

#include "design/run/design_run.hpp"

namespace lqg::design {

// Of a finished run, with poles, margins and the loop of rounded numbers:
//   plant.domain       a discrete plant with a mode that grows and changes its sign from sample to sample
//   plant.sample_time  a continuous mode too fast for the samples; a loop whose fastest pole takes a thousand of them;
//                      or one that settles within one
//   lqr, …             a loop that one more sample of delay, or an input that is 12 % stronger or weaker, makes
//                      unstable
//   lqr.R              a gain that moves no pole, a weight that is none beside the states'
//   limits.u_max       noise that takes u to its limits, a reference of 1 that asks for more than they allow
//   code.real          poles that rounding to the target's numbers moves visibly
void note_implausible(const Problem& problem, const DesignRun& run, Findings& findings);

}  // namespace lqg::design
