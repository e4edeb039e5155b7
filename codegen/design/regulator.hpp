// The optimal gain K of the regulator.
#pragma once

#include "design/problem.hpp"
#include "design/riccati.hpp"
#include "design/samples.hpp"

namespace lqg::design {

// The Riccati equation that `problem.regulator` stands for; `start` is its X in fewer digits, or empty.
RiccatiResult solve_regulator(const Problem& problem, const Samples& samples, const RealMatrix& start);

// Says under the right key why there is no gain.
void explain_regulator(RiccatiFailure failure, Findings& findings);

}  // namespace lqg::design
