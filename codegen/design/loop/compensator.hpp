// SPDX-License-Identifier: MIT
// The controller as one linear system, and the loops that it closes around a plant.
#pragma once

#include "design/numeric/linear_algebra.hpp"
#include "design/problem.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// s⁺ = A s + B y, u = C s + D y with r = 0 and no limits; s = [x̂⁻; ξ; u[k−1]], each where the design has it.
// Without a filter the state itself is measured: y = x.
struct Compensator {
  RealMatrix A, B, C, D;
  Index estimates = 0, integrals = 0;  // of its states the first ones, and the ones after these
};

// What the controller sees of the plant: x⁺ = A x + B u + G w, y = C x + D u + v. In filter form y is sampled
// while the last u acts, so that with D that u is a state too; in predictor form the controller's D is 0:
// (controller's D)(plant's D) = 0 always.
struct MeasuredPlant {
  RealMatrix A, B, C, D, G;
};

// Of the numbers in `solution`, which may be those that the target holds:
//   e = y − C x̂ − D u,  x̂ ← x̂ + L e,  u = −K [x̂; ξ; u[k−1]] (a Δu with `input_rate`),
//   x̂ ← A x̂ + B u + M e,  ξ ← ξ − T y;  in predictor form u comes before e, and is made of x̂ without it.
// `solution` has a regulator.
Compensator compensator(const Problem& problem, const Solution& solution);

// The plant of the last stage, which the steady loop is made of.
const SampledPlant& final_plant(const Solution& solution);

// Are the loop's poles those of regulator and filter? Not with integrals of outputs that D of the last input is in, in
// filter form: ξ⁺ = ξ − T (C x + D u[k−1]), where the regulator was designed with D u[k].
bool is_separated(const Problem& problem, const SampledPlant& plant);

MeasuredPlant measured_plant(const Problem& problem, const SampledPlant& plant);

// The same of the last stage's plant, which is not disturbed.
MeasuredPlant measured_plant(const Problem& problem, const Solution& solution);

// [x; s]⁺ of plant and controller, A; what [w; v] adds to it, B. The plant's input is u = C [x; s] + D [w; v].
struct ClosedLoop {
  RealMatrix A, B, C, D;
};

ClosedLoop closed_loop(const MeasuredPlant& plant, const Compensator& controller);

}  // namespace lqg::design
