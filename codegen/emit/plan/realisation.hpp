// SPDX-License-Identifier: MIT
// Which numbers the controller keeps.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

// "cheapest" pays for fewer multiply-adds with at most this many times the physical form's rounding error.
constexpr double most_loss = 4;

// A filter that carries P may lose more: its estimates are uncertain by their standard deviations, and a rounding error
// of this share of one adds a millionth to the variance.
constexpr double negligible_share = 1e-3;

// The controller in the form that code.realisation asks for, `forms` filled in. None, with a finding, where the design
// cannot have it; "cheapest" then stays physical, with a note.
std::optional<Controller> in_chosen_form(Controller physical, design::Findings& findings);

}  // namespace lqg::emit
