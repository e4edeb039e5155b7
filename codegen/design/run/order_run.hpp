// SPDX-License-Identifier: MIT
// The parts of a run that have a compensator of a given order, or white parameters.
#pragma once

#include "design/equations/riccati.hpp"
#include "design/run/design_run_parts.hpp"

namespace lqg::design {

// K and X under white parameters, of a regulator alone; `unaware` is K without them. Or why there is none.
void run_white_law(const Problem& problem, const Samples& samples, const RealMatrix& unaware, DesignRun& result);

// What moves with x is noise to a filter alone: it is added to that of `samples`, whose G is the identity then. An
// error where the plant's second moments have no bound.
void add_noise_of_white_parameters(const Problem& problem, Samples& samples, Findings& findings);

// The compensator, with its costs, beside the LQG design that `result` has.
void run_compensator(const Problem& problem, const Samples& samples, const DesignRun* coarser, DesignRun& result);

// Of a finished run with white parameters and a regulator, what they cost and what the design without them would be.
void report_white_parameters(const Problem& problem, DesignRun& run);

}  // namespace lqg::design
