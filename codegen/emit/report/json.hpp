// SPDX-License-Identifier: MIT
// NAME.json: the design for other programs, every number so that it reads back exactly.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string json(const Controller& controller);

}  // namespace lqg::emit
