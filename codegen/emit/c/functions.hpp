// SPDX-License-Identifier: MIT
// The emitted functions, each under its contract.
#pragma once

#include <string>

#include "emit/c/function_bodies.hpp"

namespace lqg::emit {

std::string functions(const Controller& controller, const FunctionBodies& bodies);

}  // namespace lqg::emit
