// SPDX-License-Identifier: MIT
// What was found in double, without the digits that its way there decides.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace lqg::design {

inline double six_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

}  // namespace lqg::design
