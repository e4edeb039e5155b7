// SPDX-License-Identifier: MIT
// The comment at the top of every emitted file.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// The whole comment that opens the header with these functions.
std::string preamble(const Controller& controller, const std::string& functions);

}  // namespace lqg::emit
