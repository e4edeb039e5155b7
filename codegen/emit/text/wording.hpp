// SPDX-License-Identifier: MIT
// A design's names, numbers and equations in words.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"
#include "emit/text/text.hpp"

namespace lqg::emit {

// {name}, {NAME}, {real}, the dimensions and the rest that most templates need.
Words common_words(const Controller& controller);

// The states with their names: the plant's own, then the inputs on their way, "force_delayed_2", "force_delayed_1".
std::vector<design::Signal> state_signals(const Controller& controller);
// Of what the filter keeps: of one that keeps z "mode_0" and so on, without units, before the inputs on their way.
std::vector<design::Signal> kept_signals(const Controller& controller);

// "2.5 %" of 0.025.
std::string in_percent(double share);

// "unrolled", or "compact", which is all that has loops.
std::string style_of(const Controller& controller);

// "speed [m/s]", or "speed" where it has no unit.
std::string name_with_unit(const design::Signal& signal);

// The outputs that r names.
std::vector<design::Signal> reference_signals(const Controller& controller);

// The law for people: "−K [x̂; ξ] + Nbar r".
std::string equation_of_law(const Controller& controller);

// The library's state of the filter: "steady", "plain", "ud".
std::string filter_name(step::Filter filter);

// The number as the target has it, without the suffix of a literal; as a double where the target has none, such as a
// cost.
std::string number(const design::Real& value, bool is_double);

// Rows under each other, columns aligned, further in by two: "  A = [ 1.0  0.5 ]\n      [ 0.0  1.0 ]\n".
std::string matrix_lines(const std::string& name, const design::RealMatrix& matrix, bool is_double);

// The values of a C array, row after row: "    0.5f, 1.0f,\n    0.0f, 1.0f\n".
std::string array_values(const design::RealMatrix& matrix, bool is_double);

std::string version();
std::string header_format();

// Who made the file, of what, and what may be done with it: lines of a comment.
std::string provenance(const Controller& controller);

}  // namespace lqg::emit
