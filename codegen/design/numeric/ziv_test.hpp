// SPDX-License-Identifier: MIT
// Ziv's test: two runs, one with many more digits, must agree on every number that is emitted.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// A number is settled when its distance to the coarser one, added or subtracted, changes neither its double
// nor its float. Two kinds of numbers never get there; they are recognised and made exact in `fine`:
//   zero: beside `scale` both are nothing but rounding, 10^(−0.6 digits) at most, and it shrank with the digits
//   tie:  both lie that close to the middle between two neighbouring doubles or floats
// `coarse_digits` are those of the coarser run; those of the finer one are in force.
bool passes_ziv_test(const Real& coarse, Real& fine, const Real& scale, unsigned coarse_digits);

// Every entry, beside the largest one of the matrix. False when one is not settled, or when the shapes
// differ.
bool passes_ziv_test(const RealMatrix& coarse, RealMatrix& fine, unsigned coarse_digits);
bool passes_ziv_test(const RealVector& coarse, RealVector& fine, unsigned coarse_digits);

// Poles, each with its nearest counterpart; zero is a part that is 10^−20 at most and shrinks from run to run, or
// was exactly zero before (a defective eigenvalue has only a part of the digits).
bool passes_ziv_test(const std::vector<ComplexReal>& coarse, std::vector<ComplexReal>& fine);

}  // namespace lqg::design
