// SPDX-License-Identifier: MIT
// The unit of a formula, from the units of its parameters and variables.
#pragma once

#include <functional>
#include <variant>

#include "expression/parse.hpp"
#include "expression/tree.hpp"
#include "expression/unit.hpp"

namespace lqg::expression {

// What is known of the unit of a value.
struct Measure {
  enum class Kind {
    free,     // of numbers alone: they may stand for something with any unit
    pure,     // of 1 and of sin, exp and their kind: pure in a product, anything in a sum
    unknown,  // of something without a unit: not judged
    known
  };
  Kind kind = Kind::unknown;
  Unit unit = {};
};

// Of a parameter or a variable.
using MeasureOf = std::function<Measure(const Node& node)>;

// The unit of a bound tree, or what does not go together: a sum (also min, max and atan2) of different units, sin, exp
// and their kind of what is no pure number (an angle in rad is one), an exponent that is none. Names the units.
std::variant<Measure, Fault> measure_of(const Node& node, const MeasureOf& measure_of_name);

}  // namespace lqg::expression
