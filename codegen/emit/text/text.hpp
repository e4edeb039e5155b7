// SPDX-License-Identifier: MIT
// Strings with places to fill in; nothing of a design.
#pragma once

#include <map>
#include <string>

namespace lqg::emit {

using Words = std::map<std::string, std::string>;

// `text` with every {word} replaced by its meaning.
std::string fill(const std::string& text, const Words& words);

using Conditions = std::map<std::string, bool>;

// `text` without the lines that end with "//? condition", or "//? not condition", where that does not hold; the others
// lose the mark and the blanks before it. A condition that is not known throws std::out_of_range.
std::string keep_lines(const std::string& text, const Conditions& conditions);

std::string upper(std::string text);

}  // namespace lqg::emit
