// SPDX-License-Identifier: MIT
// What follows from a test that passed for each value by itself: what a prover that computes with intervals cannot
// find.
#pragma once

#include <limits>
#include <vector>

#include "trace/graph.hpp"

namespace lqg::trace {

// |node| is below `bound`, or below the node `limit`; with neither it is finite.
struct Consequence {
  int node = -1;
  double bound = std::numeric_limits<double>::infinity();
  int limit = -1;
};

// By these rules, rounded or not; a NaN passes no test:
//     a − a = 0, a − a < b         a is finite
//     a + b, a − b, −a, |a| finite a and b are finite
//     a − a < c − s                s < c
//     |a| < b                      as it says
//     !(a < 0)                     a is not negative, in the whole condition: a NaN is caught by what it is part of
//     a + b < c, neither negative  a < c and b < c: rounding is monotone
//     k a < c, k = 2^e, a ≥ 0      a < c/k
//     a a < c                      |a| < √c where that is a power of two, else |a| < max(1, c)
std::vector<Consequence> consequences(const Graph& graph, int condition);

}  // namespace lqg::trace
