// NAME_partial_update: the update by some of the outputs.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// Empty where there is nothing to choose from, or no NAME_innovation to look at the outputs with.
std::string partial_update_function(const Controller& controller);

}  // namespace lqg::emit
