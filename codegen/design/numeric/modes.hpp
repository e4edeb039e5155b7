// SPDX-License-Identifier: MIT
// Modes of a pair (A, B) that B does not reach; of (Aᵀ, Cᵀ): that C does not see.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

struct Mode {
  ComplexReal value;          // the eigenvalue; of a conjugate pair the one with the positive imaginary part
  std::vector<Index> states;  // that take part in it
};

// Below this a coupling counts as none: 10^(−0.6 digits), far below any product of doubles, far above the
// working rounding. What a pair with couplings near that bound is found to be changes with the digits, which
// Ziv's test sees.
Real no_coupling();

struct Unreached {
  std::vector<Mode> modes;  // conjugates once
  Index dimension = 0;      // of the space they live in
};

// The modes of a pair whose A is nearer to 0 than to I: a continuous plant's.
Unreached unreached_modes(const RealMatrix& A, const RealMatrix& B, const Real& coupling = no_coupling());

// The same of a sampled plant, by way of A − I: with a short period A is the identity and little else.
Unreached unreached_sampled_modes(const RealMatrix& A, const RealMatrix& B, const Real& coupling = no_coupling());

// v with vᴴA = λvᴴ, unscaled, and the states in it.
struct LeftEigenvector {
  RealMatrix re, im;  // columns
  std::vector<Index> states;
};

LeftEigenvector left_eigenvector(const RealMatrix& A, const ComplexReal& value);

// Is the mode on the limit of stability or beyond? 10^(−digits/6) inside of it still counts as on it.
bool on_or_outside_circle(const ComplexReal& z);
bool on_circle(const ComplexReal& z);
bool on_axis(const ComplexReal& s, const Real& scale);
bool on_or_right_of_axis(const ComplexReal& s, const Real& scale);

}  // namespace lqg::design
