// SPDX-License-Identifier: MIT
// A row of the table of keys in words.
#pragma once

#include <string>

#include "input/keys.hpp"

namespace lqg::reference {

// "nx × nu matrix", "a number > 0"
std::string values_of(const input::KeyRule& rule);

// What holds without the key: "required", "0", "`"float"`"; "" where nothing is to be said.
std::string otherwise(const input::KeyRule& rule);

// "Q" of "lqr.Q"
std::string name_of(const input::KeyRule& rule);

bool is_table(const input::KeyRule& rule);

// "[lqr.bryson]", "[[stage]]"
std::string header_of(const input::KeyRule& rule);

std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace lqg::reference
