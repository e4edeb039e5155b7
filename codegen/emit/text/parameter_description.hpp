// SPDX-License-Identifier: MIT
// The parameters of the design file, and its numbers that expressions give.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

// One a row: name, value and unit, expression; "" of what is a number.
std::vector<std::vector<std::string>> table_of_parameters(const Controller& controller);
// One a row: key, expression, value. Of many the first ones, and a row that says how many there are.
std::vector<std::vector<std::string>> table_of_expressions(const Controller& controller);

// Both as lines of text behind an empty one and a heading; empty without them.
std::string describe_parameters(const Controller& controller);
std::string describe_expressions(const Controller& controller);

}  // namespace lqg::emit
