// SPDX-License-Identifier: MIT
// Units of formulas: whether they go together, and with those of the signals.
#pragma once

#include "input/formulas.hpp"
#include "input/parameters.hpp"
#include "input/values.hpp"

namespace lqg::input {

// Reports formulas in which a sum has different units and the like, and entries of the plant, limits and times whose
// unit is known and not that of their place. Units that are not given, or not known, are not judged.
void check_units(const Formulas& formulas, const Parameters& parameters, const Values& values,
                 const FormulaPlaces& places, Report& report);

// The unit of a signal as it is written; unknown where there is none or a strange one.
expression::Measure measure_of_unit(const std::string& unit);
// That of signal `index` of "plant.states" and their like.
expression::Measure measure_of_signal(const Values& values, const std::string& key, std::size_t index);

}  // namespace lqg::input
