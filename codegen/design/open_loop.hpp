// The loop of plant and controller, opened at the plant's inputs.
#pragma once

#include "design/linear_algebra.hpp"
#include "design/problem.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// L(z) = C (zI − A)⁻¹ B from the plant's input ū to what the controller answers, with the sign of u = −…, so
// that the loop is closed by −1 and A − BC has the closed loop's poles.
struct OpenLoop {
  RealMatrix A, B, C;
};

// Regulator alone: L = K(zI − A)⁻¹B. With a filter: plant and controller; the controller's own u goes into
// its prediction. Filter form: y is sampled while the last u acts, and answered at once. Predictor form: y is
// sampled while the new u acts, and answered one sample later.
OpenLoop open_loop(const Problem& problem, const Solution& solution);

}  // namespace lqg::design
