// SPDX-License-Identifier: MIT
// The loop of plant and controller, opened at the plant's inputs or at its outputs.
#pragma once

#include "design/loop/compensator.hpp"

namespace lqg::design {

// L(z) = C (zI − A)⁻¹ B from what enters where the loop is open to what comes back there, with the sign that closes
// the loop by −1: A − BC has the closed loop's poles.
struct OpenLoop {
  RealMatrix A, B, C;
};

// At the inputs: from the plant's ū to what the controller answers; the controller's own u goes into its
// prediction. Filter form: y is sampled while the last u acts, and answered at once. Predictor form: y is sampled
// while the new u acts, and answered one sample later.
OpenLoop open_at_inputs(const MeasuredPlant& plant, const Compensator& controller);

// At the outputs: from the ȳ that the controller reads to the plant's −y.
OpenLoop open_at_outputs(const MeasuredPlant& plant, const Compensator& controller);

}  // namespace lqg::design
