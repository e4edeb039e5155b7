// SPDX-License-Identifier: MIT
// scenario.plant.parameters: what the plants of scenarios have in place of the design's parameters.
#pragma once

#include "input/document.hpp"
#include "input/exact_value.hpp"
#include "input/formula_place.hpp"
#include "input/parameters.hpp"
#include "input/report.hpp"
#include "input/values.hpp"

namespace lqg::input {

// Into `values.named`, by the key of the table. What is wrong is reported.
void read_changed_parameters(const Node& document, const Parameters& parameters, const FormulaPlaces& places,
                             ExactValues& exact, Values& values, Report& report);

}  // namespace lqg::input
