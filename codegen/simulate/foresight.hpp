// SPDX-License-Identifier: MIT
// Limits that are foreseen, beside limits that are clipped at.
#pragma once

#include "controller/controller.hpp"

namespace lqg::simulate {

// Of a controller with foresight: the law of x itself around the design's own plant, without noise, in double, from
// starts that are the same on every host.
controller::Worth worth_of_foresight(const controller::Controller& controller);

}  // namespace lqg::simulate
