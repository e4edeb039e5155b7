// SPDX-License-Identifier: MIT
// What becomes of the loop when the target holds the controller's numbers.
#pragma once

#include <functional>

#include "design/finding.hpp"
#include "design/loop/compensator.hpp"
#include "design/sampled/stages.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// The controller's K, L, M and its model A, B, C, D rounded to the target's numbers, around the exact plant: poles
// (those of inputs that are kept for D, too), cost and margins (to six digits). `solution` has its cost and poles.
// A filter alone has the poles of Â − (ÂL + M)Ĉ. An error under "code.real" when this is unstable, which advises double
// where that is stable; a note when it costs more than 1 % more. With stages the loop is that of the `last` one.
// `poles` are those in many digits: 1 as a double may be less in them. A loop that is unstable in them has its own
// note, and is left alone.
void check_rounded(const Problem& problem, const SampledStage& last, const std::vector<ComplexReal>& poles,
                   Solution& solution, Findings& findings);

// The same of a controller with numbers as a scalar holds them, around the exact plant: fills in solution.loop.rounded.
using ControllerIn = std::function<Compensator(Scalar)>;
void check_rounded_controller(const Problem& problem, const SampledStage& last, const ControllerIn& controller_in,
                              Solution& solution, Findings& findings);

// `a` as the target holds it.
RealMatrix held_by(Scalar real, const RealMatrix& a);

// Errors under "code.real" when the model is lost: A ≠ I rounds to I, a column of B or a row of C to 0. Found before
// the gains, which no digits may be enough for then. Double is advised where it keeps what is lost.
void check_model(const SampledPlant& exact, Scalar real, Findings& findings);

}  // namespace lqg::design
