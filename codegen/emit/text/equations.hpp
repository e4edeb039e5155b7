// SPDX-License-Identifier: MIT
// The equations of a plant in words.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

struct EquationLine {
  std::string left, right;  // "dp/dt", "v"
};

// f of each state and h of each output, as the file has them; none of a plant of matrices.
std::vector<EquationLine> equation_lines(const Controller& controller);

// The same as lines of the header's first comment and of the terminal, behind an empty one and a heading.
std::string describe_equations(const Controller& controller);

}  // namespace lqg::emit
