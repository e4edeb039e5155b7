// SPDX-License-Identifier: MIT
// NAME_batch.h: the step of many instances side by side, for simulators, Monte Carlo and reinforcement learning.
#pragma once

#include <optional>
#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// Why the controller has no batch; none where it has one. Beside its reason it says what to do.
std::optional<std::string> why_no_batch(const Controller& controller);

// Of a controller that has one. It includes NAME.h.
std::string batch_header(const Controller& controller);

}  // namespace lqg::emit
