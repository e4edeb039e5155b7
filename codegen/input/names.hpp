// SPDX-License-Identifier: MIT
// Names and texts that end up in generated C: what they may be.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "design/problem.hpp"

namespace lqg::input {

constexpr std::size_t longest_name = 31;  // characters of an external identifier that C99 tells apart

// Each of these says what is wrong, "expected …, found …"; nothing when all is well.
using Complaint = std::optional<std::string>;

// The design's name: prefix of every emitted symbol and the name of the files.
Complaint check_design_name(const std::string& name);

// A name in [parameters]: no function has it, and it is not pi.
Complaint check_parameter_name(const std::string& name);

// Text that stands in a comment of the generated code: one line that cannot end the comment, continue it, or
// open one.
Complaint check_comment_text(const std::string& text);

// The design file's name, which stands in comments of what is emitted and in a string of an #error.
Complaint check_file_name(const std::string& name);

// A name as the generated constants have it.
std::string in_capitals(std::string name);

// The constant NAME_X_STATE, or NAME_U_INPUT, NAME_Y_OUTPUT, of a signal of "plant.states" …: no other has its name.
Complaint check_signal_name(const std::string& key, const std::string& name);

// The constants NAME_U_MIN_INPUT, NAME_Y_MAX_OUTPUT …: no input or output among `others`, in capitals, has their name.
Complaint check_limit_name(const std::string& key, const std::string& name,
                           const std::map<std::string, std::size_t>& others);

// "dy1 [m]" into a name, a C identifier, and a unit.
Complaint parse_signal(const std::string& text, design::Signal& signal);

}  // namespace lqg::input
