// SPDX-License-Identifier: MIT
// Are the numbers that a controller is made of numbers of its target?
#pragma once

#include "controller/controller.hpp"

namespace lqg::controller {

// The target can tell the variances of the innovations, and the squares of the gate's thresholds, from 0 and infinity.
bool fit_variances(const Controller& controller);

// Of what is no matrix of the solution, which design/checks/representable asks: the sample time, the gate, x0, the
// limits, the gains that follow from others. What is too large is an error, and so is what must not become 0; other
// numbers that become 0 are a note, and so are limits that no number of the target reaches.
void check_numbers(const Controller& controller, design::Findings& findings);

// Of the matrices of a linear form.
void check_numbers(const design::LinearForm& form, bool is_double, design::Findings& findings);

}  // namespace lqg::controller
