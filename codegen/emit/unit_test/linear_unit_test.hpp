// SPDX-License-Identifier: MIT
// What the emitted test of a controller that keeps z does otherwise.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// The calls of one sample; `look` stands between control and advance.
std::string linear_sample(const Controller& controller, const std::string& look);

// x̂ beside the reference, to stand there.
std::string linear_estimate_check();

// A sample with a hostile number: all stays finite, and the status says so.
std::string linear_hostile_sample(const Controller& controller);

}  // namespace lqg::emit
