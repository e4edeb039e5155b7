// SPDX-License-Identifier: MIT
// One chart of the charts of several designs.
#pragma once

#include <string>

#include "emit/text/chart.hpp"

namespace lqg::view {

// `chart` with the name of its design in its labels, and with the colours or lines of the design of that number.
emit::Chart owned_chart(emit::Chart chart, const std::string& owner, std::size_t number);

// Adds what is drawn in `other` to `chart`, and makes its window large enough for both. The grid and what is the same
// in both stand in it once.
void lay_over(emit::Chart& chart, const emit::Chart& other);

}  // namespace lqg::view
