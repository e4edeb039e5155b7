// SPDX-License-Identifier: MIT
// What every part of emit calls the data that it writes down.
#pragma once

#include "controller/controller.hpp"
#include "controller/rounding.hpp"
#include "controller/stage_in_force.hpp"
#include "controller/state_fields.hpp"
#include "design/numeric/linear_algebra.hpp"

namespace lqg::emit {

using controller::CodeCost;
using controller::Controller;
using controller::Field;
using controller::FormChoice;
using controller::FormCost;
using controller::Gains;
using controller::rounded_to_target;
using design::decimal;
using design::is_zero;

}  // namespace lqg::emit
