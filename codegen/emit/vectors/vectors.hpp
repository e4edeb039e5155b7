// SPDX-License-Identifier: MIT
// Reference vectors: the host's own run of a noisy closed loop, and how far the target may be from it.
#pragma once

#include <cstdint>
#include <vector>

#include "emit/controller.hpp"
#include "emit/vectors/calls.hpp"

namespace lqg::emit {

// What goes in and what comes out in one sample.
struct Sample {
  std::vector<double> r;  // in: the references
  std::vector<double> y;  // in: the outputs; of a regulator alone the states
  std::vector<double> u;  // in for predict (what was applied), and what control must return
  std::vector<double> x;  // the estimate after update
  std::vector<double> P;  // after update, lower triangle; of an online filter
};

// The largest |C − reference| that is accepted, of each kind of result: `margin` times the error that the same run has
// on the host in the target's precision. That error is the precision times the conditioning of this filter, found
// by doing it; the reference has at least twice the target's digits and unrounded constants.
struct Tolerances {
  static constexpr double margin = 4;
  std::vector<double> x, u, P;
};

struct Vectors {
  std::vector<Sample> samples;
  Tolerances tolerance;
  int limited = 0;         // samples of that run in which a limit held u
  std::uint32_t hash = 0;  // FNV-1a over every bit of x, the covariance, ξ and u of the run in the target's precision
  Calls calls;
};

Vectors make_vectors(const Controller& controller);

// Of a filter that carries P, in that run in the target's numbers.
struct RoundingOfFilter {
  double error = 0;  // rms(error) / rms of the worst estimate or input
  // rms(error of x̂_i) / √P_ii of the last sample, the worst i; infinite where P_ii is 0
  double share_of_deviation = 0;
};
RoundingOfFilter rounding_of_filter(const Controller& controller);

}  // namespace lqg::emit
