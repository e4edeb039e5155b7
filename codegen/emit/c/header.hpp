// SPDX-License-Identifier: MIT
// NAME.h: types, names, constants and functions of one controller.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string header(const Controller& controller);

}  // namespace lqg::emit
