// SPDX-License-Identifier: MIT
// Runs of a controller that is one linear system beside the physical form that it stands for.
#pragma once

#include "emit/vectors/vectors.hpp"

namespace lqg::emit {

// For controller.linear: y of a noisy closed loop, u and x̂ as the physical form in many digits has them, and how far
// the target may be from that with z.
Vectors linear_vectors(const Controller& controller);

// rms of the error of u, in the target's numbers and for the y of that run, divided by the rms of u: of z where the
// controller keeps z, else of x̂ with u applied as it is. The worst input counts.
double rounding_error(const Controller& controller);

}  // namespace lqg::emit
