// SPDX-License-Identifier: MIT
// Many digits to the target's number, rounded once.
#pragma once

#include "design/rounding.hpp"

namespace lqg::controller {

inline double rounded_to_target(const design::Real& value, bool is_double) {
  return is_double ? design::to_double(value) : static_cast<double>(design::to_float(value));
}

}  // namespace lqg::controller
