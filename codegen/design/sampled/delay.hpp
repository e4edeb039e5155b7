// SPDX-License-Identifier: MIT
// The time from sampling y to u taking effect, and the inputs that are on their way.
#pragma once

#include "design/numeric/linear_algebra.hpp"
#include "design/problem.hpp"

namespace lqg::design {

// delay = (samples − 1) T + part with 0 < part ≤ T: in period k the plant's input is u[k − samples] for `part`
// seconds, then u[k − samples + 1]. No delay: samples = 0. A delay within 10^−9 of whole periods is whole.
struct Delay {
  Index samples = 0;
  Real part;
  bool is_whole = true;
};

Delay delay_of(const Plant& plant);

// The state with the inputs on their way, the oldest first: z = [x; u[k−d]; …; u[k−1]]. `moves` is
// [A  B_old  B_new]: x⁺ = A x + B_old u[k−d] + B_new u[k−d+1]. Returns [A B] of z⁺ = A z + B u, side by side.
RealMatrix with_inputs_on_their_way(const RealMatrix& moves, Index nu, Index samples);

// The 0/1 matrix that takes [z; u; w] to [x; u[k−d]; u[k−d+1]; w].
RealMatrix acting_inputs(Index nx, Index nu, Index nw, Index samples);

}  // namespace lqg::design
