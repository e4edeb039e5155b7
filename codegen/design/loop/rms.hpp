// SPDX-License-Identifier: MIT
// What the noises make of the closed loop.
#pragma once

#include "design/loop/compensator.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

// √E[xᵢ²], √E[uᵢ²] and √E[yᵢ²] of the loop at work, to six digits: without limits, with r = 0. `samples` have a noise.
// Of the steady covariance P = A P Aᵀ + B diag(noise) Bᵀ of [x; s]. Empty when the loop is not stable.
std::optional<Rms> steady_rms(const Problem& problem, const Samples& samples, const Compensator& controller);

}  // namespace lqg::design
