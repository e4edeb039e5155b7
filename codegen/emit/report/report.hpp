// SPDX-License-Identifier: MIT
// NAME.html: what a person wants to see of a design, in one file without scripts.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string report(const Controller& controller);

}  // namespace lqg::emit
