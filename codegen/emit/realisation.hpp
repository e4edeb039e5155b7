// Which numbers the controller keeps.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

// "cheapest" pays for fewer multiply-adds with at most this many times the physical form's rounding error.
constexpr double most_loss = 4;

// Does what code.realisation asks for: fills in `linear` and `realisations`. False, with a finding, where the design
// cannot have it; "cheapest" then stays physical, with a note.
bool choose_realisation(Controller& controller, design::Findings& findings);

// "folded"
std::string name_of(design::Realisation realisation);

}  // namespace lqg::emit
