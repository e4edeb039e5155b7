// SPDX-License-Identifier: MIT
// A point of the unit circle in double.
#pragma once

#include <complex>

#include "design/real.hpp"

namespace lqg::design {

// e^(j angle): cosine and sine as correctly rounded doubles, but where many digits after a double's last one are those
// of a tie. For 0 ≤ angle ≤ π it takes a hundredth of MPFR's time. Only of operations that IEEE 754 defines, so that it
// has the same bits on every machine.
std::complex<double> on_circle(const Real& angle);

}  // namespace lqg::design
