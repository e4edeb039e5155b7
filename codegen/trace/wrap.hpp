// SPDX-License-Identifier: MIT
// Lines of C that are not too long: where they break.
#pragma once

#include <string>

namespace lqg::trace {

// Breaks a line of C over `width` columns; what follows is indented by `indent` columns.
std::string wrap(const std::string& line, int indent, int width = 100);

// A comment above a block; its lines end between words.
std::string heading(const std::string& equation);

}  // namespace lqg::trace
