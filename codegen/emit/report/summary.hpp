// SPDX-License-Identifier: MIT
// The short table that lqgen prints on a terminal.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string summary(const Controller& controller);

}  // namespace lqg::emit
