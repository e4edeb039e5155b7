// SPDX-License-Identifier: MIT
// The regulator's weights, from whichever keys gave them.
#pragma once

#include "design/solution.hpp"

namespace lqg::design {

// Q, R, N of xᵀQx + uᵀRu + 2xᵀNu over the plant's own state and input, in the units of the file (a density with a
// cost that is an integral), in the digits in force. Bryson's rule (A. E. Bryson, Y.-C. Ho, "Applied Optimal Control",
// 1975) puts one over the squares of the largest acceptable values.
//   stated:  Q and R of the file or of Bryson's states and inputs, N;  Q = 0 where the outputs carry the weight
//   outputs: yᵀQ_o y of y = Cx + Du:  Q = CᵀQ_oC, N = CᵀQ_oD, R = DᵀQ_oD
// Empty without weights (placed poles).
SampledCost stated_weights(const Problem& problem);
SampledCost output_weights(const Problem& problem);

// Both together.
SampledCost weights_of(const Problem& problem);

}  // namespace lqg::design
