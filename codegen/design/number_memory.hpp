// SPDX-License-Identifier: MIT
// For programs that do little else than compute with many digits.
#pragma once

namespace lqg::design {

// From now on the digits of numbers come from a store of each thread: malloc and free took a sixth of a design's time.
// Of the whole program, GMP's and MPFR's other users included; to be called once, before the first number is made.
void use_number_stores();

}  // namespace lqg::design
