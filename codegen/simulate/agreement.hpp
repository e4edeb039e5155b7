// SPDX-License-Identifier: MIT
// Is a linear form the controller that it stands for?
#pragma once

#include "controller/controller.hpp"

namespace lqg::simulate {

// In how many digits z⁺ = A z + B y, u = C z + D y answers an impulse of each output as update, control and predict of
// `physical` do, both in many digits: D, CB, CAB … CA²ⁿ⁻¹B. Systems of order n that agree in these agree in all
// (Cayley–Hamilton).
double agreement(const controller::Controller& physical, const design::LinearForm& form);

// Many digits; a form that agrees in fewer than half of them is another controller.
unsigned digits_of_agreement(const design::Solution& solution);

}  // namespace lqg::simulate
