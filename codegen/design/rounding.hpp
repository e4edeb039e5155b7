// From many digits to the numbers of a machine: correctly rounded, to nearest even, subnormals included.
#pragma once

#include "design/real.hpp"

namespace lqg::design {

inline double to_double(const Real& x) { return mpfr_get_d(x.backend().data(), MPFR_RNDN); }
inline float to_float(const Real& x) { return mpfr_get_flt(x.backend().data(), MPFR_RNDN); }

}  // namespace lqg::design
