// A delayed plant whose inputs in the near future are known is one with less delay, later.
#pragma once

#include "design/sampled/augmentation.hpp"

namespace lqg::design {

// Whole periods of the delay only postpone: what u[k] weighs and does begins `steps` periods later, when the inputs on
// their way have acted. The optimal law of the plant without these periods, of its state predicted by that much, is
// the one of the delayed plant:  K = K_sooner predict. (Without this the Riccati equation of the delayed plant has
// R = 0 and its closed loop a chain of poles at 0.)
struct Prediction {
  Samples samples;      // of the plant with less delay
  RealMatrix predict;   // its z from z of the delayed one
  bool is_exact = true; // false: some weight is of u when it is decided, not postponed, and K is but a good start
};

// Empty when the delay has no whole period before a part of one.
std::optional<Prediction> without_whole_periods(const Problem& problem, const Samples& samples);

}  // namespace lqg::design
