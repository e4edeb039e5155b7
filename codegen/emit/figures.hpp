// What the emitted code costs the target.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

Figures unrolled_figures(const Controller& controller);
Figures linear_figures(const Controller& controller);  // of controller.linear
Figures compact_figures(const Controller& controller);

}  // namespace lqg::emit
