// SPDX-License-Identifier: MIT
// A delayed plant whose inputs in the near future are known is one with less delay, later.
#pragma once

#include "design/sampled/augmentation.hpp"

namespace lqg::design {

// Whole periods of the delay only postpone: what u[k] weighs and does begins `steps` periods later, when the inputs on
// their way have acted. The optimal law of the plant without these periods, of its state predicted by that much, is
// the one of the delayed plant:  K = K_sooner predict. (Without this the Riccati equation of the delayed plant has
// R = 0 and its closed loop a chain of poles at 0.)
struct Prediction {
  Samples samples;       // of the plant with less delay
  RealMatrix predict;    // its z from z of the delayed one
  Index steps = 0;       // from here to that state
  bool is_exact = true;  // false: some weight is of u when it is decided, not postponed, and K is but a good start
};

// Empty when the delay has no whole period before a part of one.
std::optional<Prediction> without_whole_periods(const Problem& problem, const Samples& samples);

// X of the delayed plant's equation `e` from that of the plant with less delay, of an exact prediction. The weights of
// the steps until then are on inputs that are on their way: with E = the rows that carry weight, α of the pincer,
//   X = Σ_{k < steps} (E Aᵏ)ᵀ Q_E (E Aᵏ) + α^(2 steps) predictᵀ X_sooner predict.
RealMatrix cost_after_prediction(const Problem& problem, const RiccatiEquation& e, const Prediction& prediction,
                                 const RealMatrix& X_sooner);

}  // namespace lqg::design
