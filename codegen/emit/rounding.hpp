// Many digits to the target's number, rounded once.
#pragma once

#include "design/real.hpp"

namespace lqg::emit {

inline double rounded_to_double(const design::Real& value) { return mpfr_get_d(value.backend().data(), MPFR_RNDN); }

inline float rounded_to_float(const design::Real& value) { return mpfr_get_flt(value.backend().data(), MPFR_RNDN); }

inline double rounded_to_target(const design::Real& value, bool is_double) {
  return is_double ? rounded_to_double(value) : static_cast<double>(rounded_to_float(value));
}

}  // namespace lqg::emit
