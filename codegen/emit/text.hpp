// Text that becomes C: placeholders, names, matrices.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emit/controller.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

using Words = std::map<std::string, std::string>;

// `text` with every {word} replaced by its meaning.
std::string fill(const std::string& text, const Words& words);

// {name}, {NAME}, {real}, the dimensions and the rest that most templates need.
Words common_words(const Controller& controller);

std::string upper(std::string text);

// The states with their names: the plant's own, then the inputs on their way, "force_delayed_2", "force_delayed_1".
std::vector<design::Signal> state_signals(const Controller& controller);

// "speed [m/s]", or "speed" where it has no unit.
std::string name_with_unit(const design::Signal& signal);

// The outputs that r names.
std::vector<design::Signal> reference_signals(const Controller& controller);

// The law for people: "−K [x̂; ξ] + Nbar r".
std::string equation_of_law(const Controller& controller);

// The library's state of the filter: "steady", "plain", "ud".
std::string filter_name(step::Filter filter);

// The number as the target has it, without the suffix of a literal.
std::string number(const design::Real& value, bool is_double);

// Rows under each other, columns aligned, for a comment: " * A = [ 1.0  0.5 ]\n *     [ 0.0  1.0 ]\n".
std::string matrix_comment(const std::string& name, const design::RealMatrix& matrix, bool is_double);

// The values of a C array, row after row: "    0.5f, 1.0f,\n    0.0f, 1.0f\n".
std::string array_values(const design::RealMatrix& matrix, bool is_double);

// A decimal with four significant digits, for people.
std::string rounded(double value);

}  // namespace lqg::emit
