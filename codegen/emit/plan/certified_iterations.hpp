// SPDX-License-Identifier: MIT
// How often a sample of a controller with foresight changes the set of active limits: a proof where there is one.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

// Of a controller with `worth` and without `limits.iterations`: replaces the cap where a bound can be proved in some
// seconds, which it can of few limited quantities that depend on few states.
void certify_iterations(Controller& controller);

}  // namespace lqg::emit
