// SPDX-License-Identifier: MIT
// Poles as the report and the messages show them.
#pragma once

#include <string>

#include "design/numeric/linear_algebra.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// By falling |z|, then by falling imaginary part, then by falling real part.
Poles sorted_poles(const std::vector<ComplexReal>& values);

std::string short_number(double value);

// "0.5", "±2j" or "0.9 ± 0.1j". Parts that are rounding beside the rest, or beside `scale`, are left out, so that
// the text does not depend on the digits.
std::string short_complex(const ComplexReal& value, const Real& scale);

}  // namespace lqg::design
