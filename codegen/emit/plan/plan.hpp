// SPDX-License-Identifier: MIT
// The choice among what the target can have: which numbers the controller keeps, straight-line code or the library's
// loops.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

// The controller as it is written: form and style chosen, its cost counted. Findings: what the target cannot have, the
// code does not fit the flash that the design allows.
std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, controller::Source source,
                                          design::Findings& findings);

}  // namespace lqg::emit
