// SPDX-License-Identifier: MIT
// A plant that is stated by equations: plant.f, plant.h, and plant.operating_point, where they are linearised.
#pragma once

#include "input/document.hpp"
#include "input/exact_value.hpp"
#include "input/formula_place.hpp"
#include "input/parameters.hpp"
#include "input/report.hpp"
#include "input/values.hpp"

namespace lqg::input {

// Into `values.equations`, and with an operating point into `values.linearisation`. What is wrong is reported, also
// where the linearisation cannot be had. Nothing happens without plant.f and plant.h.
void read_equations(const Node& document, const Parameters& parameters, const FormulaPlaces& places, ExactValues& exact,
                    Values& values, Report& report);

}  // namespace lqg::input
