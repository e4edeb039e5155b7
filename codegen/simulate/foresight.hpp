// SPDX-License-Identifier: MIT
// Limits that are foreseen, beside limits that are clipped at.
#pragma once

#include "controller/controller.hpp"

namespace lqg::simulate {

// Of a controller with foresight: the law of x itself around the design's own plant, without noise, in double, from
// starts that are the same on every host. The run that is shown has the law's emitted numbers and arithmetic: u has the
// bits of NAME_control, clipped those of the same design with horizon = 0.
controller::Worth worth_of_foresight(const controller::Controller& controller);

}  // namespace lqg::simulate
