// SPDX-License-Identifier: MIT
// Between the plant's own units and deviations from the operating point, in C that no trace prints.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// Lines of a body, the last one without its end; empty where nothing is to be added. Templates have them behind the
// condition that the point has such a part.

// "    const float deviations[TWO_NY] = {y[0] - TWO_OPERATING_Y_A, y[1]};" of what is handed over as 'y', 'u' or 'x'.
std::string declare_deviations(const Controller& controller, char of);
// "deviations", or the array itself: "y".
std::string deviations(const Controller& controller, char of);

// "(y[0] - TWO_OPERATING_Y_A)", of entry i of y, u, x or r given as `text`; `text` where its offset is 0.
std::string deviation(const Controller& controller, char of, int i, const std::string& text);

// "    u[0] = TWO_OPERATING_U_A + u[0];" of each input that has an offset.
std::string inputs_in_own_units(const Controller& controller);

// "    self->r[0] = TWO_OPERATING_Y_A;" of each reference that has one.
std::string references_of_point(const Controller& controller);

}  // namespace lqg::emit
