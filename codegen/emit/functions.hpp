// The emitted functions, each under its contract.
#pragma once

#include <string>

#include "emit/bodies.hpp"

namespace lqg::emit {

std::string functions(const Controller& controller, const Bodies& bodies);

}  // namespace lqg::emit
