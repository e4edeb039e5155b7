// SPDX-License-Identifier: MIT
// What the header says of an extended filter.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// In place of the matrices of a linear plant: its signals. The equations are in emit/text/equations.
std::string describe_extended_plant(const Controller& controller);

// In place of a gain: what the filter does, and with which noises.
std::string describe_extended_filter(const Controller& controller);

}  // namespace lqg::emit
