// SPDX-License-Identifier: MIT
// A compensator in the one set of coordinates that its loop gives a meaning.
#pragma once

#include <optional>

#include "design/loop/compensator.hpp"
#include "design/run/white_parameters.hpp"

namespace lqg::design {

// z' = `to` z are the compensator's estimates of states of the plant. The other matrices are those of
// CompensatorSolution.
struct CompensatorForm {
  RealMatrix to;
  Compensator controller;
  RealMatrix T, P, expected, estimate, heard, of_state, keep;
  std::vector<int> estimates;
};

// Which states: one after the other the one whose estimate tells most that those before do not, in parts of its
// standard deviation; among equals the first. `own` are the plant's states without an input that MeasuredPlant adds.
// of_state: z from which on the loop costs least where x is known, so scaled that of_state T = I. Empty where
// the second moments have no bound in the digits in force.
std::optional<CompensatorForm> in_estimates(const OrderProblem& problem, const MeasuredPlant& plant, Index own,
                                            const Compensator& controller);

void take_form(const CompensatorForm& form, CompensatorSolution& solution);

}  // namespace lqg::design
