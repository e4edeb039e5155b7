// SPDX-License-Identifier: MIT
// Sliders of placed poles: a real one has one, two conjugate ones have two, which move both.
#pragma once

#include <vector>

#include "input/edit.hpp"
#include "view/tunables.hpp"

namespace lqg::view {

std::vector<Tunable> tunable_poles(const std::vector<input::PlacedNumber>& numbers);

}  // namespace lqg::view
