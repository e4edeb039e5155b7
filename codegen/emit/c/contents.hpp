// SPDX-License-Identifier: MIT
// The table of contents of a header: which function is called when.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// Lines of a comment. `functions` are those of the header.
std::string table_of_contents(const Controller& controller, const std::string& functions);

}  // namespace lqg::emit
