// SPDX-License-Identifier: MIT
// What a design file may leave out, for problems that are made in C++.
#pragma once

#include "design/problem.hpp"

namespace lqg::design {

// `problem` with every empty matrix that has a default replaced by it, from the sizes of A, B and C (no B or no C: none
// of their columns or rows): D = 0, G = I, H = 0, N = 0, W's cross noise = 0, x0 = 0, P0 = I. Weights, noises and kinds
// stay as they are, but that a discrete plant has a discrete cost and discrete noise.
Problem with_defaults(Problem problem);

}  // namespace lqg::design
