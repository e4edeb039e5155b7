// What becomes of the loop when the target holds the controller's numbers.
#pragma once

#include "design/finding.hpp"
#include "design/loop/compensator.hpp"
#include "design/sampled/stages.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// The controller's K, L, M and its model A, B, C, D rounded to the target's numbers, around the exact plant: poles
// (those of inputs that are kept for D, too), cost and margins (to six digits). `solution` has its cost and poles.
// A filter alone has the poles of Â − (ÂL + M)Ĉ. An error under "code.real" when this is unstable; a note when it costs
// more than 1 % more. With stages the loop is that of the `last` one.
void check_rounded(const Problem& problem, const SampledStage& last, Solution& solution, Findings& findings);

// The same of a controller with numbers as the target holds them, around the exact plant: fills in solution.loop.rounded.
void check_rounded_controller(const Problem& problem, const SampledStage& last, const Compensator& controller,
                              Solution& solution, Findings& findings);

// `a` as the target holds it.
RealMatrix held_by(Scalar real, const RealMatrix& a);

// Errors under "code.real" when the model is lost: A ≠ I rounds to I, a column of B or a row of C to 0. Found before the
// gains, which no digits may be enough for then.
void check_model(const SampledPlant& exact, Scalar real, Findings& findings);

}  // namespace lqg::design
