// SPDX-License-Identifier: MIT
// For programs that do little else than compute with many digits.
#pragma once

namespace lqg::design {

// From now on the digits of GMP's and MPFR's numbers, of whoever in this program makes them, come from stores, one in
// each thread, in place of malloc. To be called once, before the first number is made.
void use_number_stores();

// Gives back what the store of this thread keeps; ThreadCaches does it at the thread's end.
void empty_number_store();

}  // namespace lqg::design
