// SPDX-License-Identifier: MIT
// The steady optimal gain K of the regulator.
#pragma once

#include "design/sampled/augmentation.hpp"

namespace lqg::design {

// A Riccati result over all of z, with the poles of z⁺ = A z + B v under v = −K z (without the pincer's α).
struct SteadyRegulator {
  RiccatiResult riccati;
  std::vector<ComplexReal> poles;
};

// `start` is X in fewer digits, or empty.
SteadyRegulator solve_regulator(const Problem& problem, const Samples& samples, const RealMatrix& start);

// The equation whose solvability decides on that of the regulator: of the plant without whole periods of delay.
RiccatiEquation deciding_equation(const Problem& problem, const Samples& samples);

// A − BK over z, of the sampled plant also where the gain is a continuous one.
RealMatrix regulated_loop(const Problem& problem, const SampledPlant& plant, const RealMatrix& K);

// Says under the right key why there is no gain.
void explain_regulator(RiccatiFailure failure, Findings& findings);

}  // namespace lqg::design
