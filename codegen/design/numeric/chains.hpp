// SPDX-License-Identifier: MIT
// Chains of delays: states that only take another one's value a sample later, and states that become the same number.
#pragma once

#include <vector>

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// Of s⁺ = A s + B w: state i is state `source`[i] as it was `ago`[i] samples before. A state that is more than a delay
// is its own source.
struct Chains {
  std::vector<Index> source, ago;

  // Those that are their own source, in their order.
  std::vector<Index> kept() const;
};

// A row of A with nothing but one 1, and of B with nothing, is a delay.
Chains chains_of(const RealMatrix& A, const RealMatrix& B);

// States of s⁺ = A s + B w that are equal, exactly, some samples after any start, as one: those with equal rows of [A
// B], where equal states count as one. s = spread s', and s' moves by the new A and B.
struct Merged {
  RealMatrix A, B, spread;
};

Merged with_equal_states_merged(const RealMatrix& A, const RealMatrix& B);

}  // namespace lqg::design
