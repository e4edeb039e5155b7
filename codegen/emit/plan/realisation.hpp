// SPDX-License-Identifier: MIT
// Which numbers the controller keeps.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

// "cheapest" pays for fewer multiply-adds with at most this many times the physical form's rounding error.
constexpr double most_loss = 4;

// The controller in the form that code.realisation asks for, `forms` filled in. None, with a finding, where the design
// cannot have it; "cheapest" then stays physical, with a note.
std::optional<Controller> in_chosen_form(Controller physical, design::Findings& findings);

}  // namespace lqg::emit
