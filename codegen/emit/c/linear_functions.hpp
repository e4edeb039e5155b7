// SPDX-License-Identifier: MIT
// The emitted functions of a controller that keeps z, behind init and reset, each under its contract.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string linear_functions(const Controller& controller);

}  // namespace lqg::emit
