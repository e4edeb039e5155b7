// SPDX-License-Identifier: MIT
// Text from a file: its encoding, and how it is shown in a message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "input/location.hpp"

namespace lqg::input {

// One character of UTF-8; length 0 where the bytes are not UTF-8 (overlong forms and surrogates are not).
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

// The character that begins at `at`, at < text.size().
Character decode(std::string_view text, std::size_t at);

// A control character of ASCII or Unicode, a line separator, or one that turns the direction of writing: what
// must not reach a comment of generated code. A tab is one too.
bool is_control(char32_t code);

// `text` on one line, control characters and bytes that are not UTF-8 as escapes.
std::string printable(std::string_view text);

// The same, quoted and cut after 60 characters.
std::string in_quotes(std::string_view text);

// On one line: each stretch of blanks and line breaks as one blank.
std::string on_one_line(std::string_view text);

// With a to z in place of A to Z.
std::string in_lower_case(std::string_view text);

// Everything that must not reach the TOML parser: bytes that are not UTF-8, control characters, characters
// beyond ASCII outside comments and strings of one line (toml++ 3.3.0 has undefined behaviour there), keys of
// very many parts (a tree too deep to take down again). At most one fault a line.
std::vector<Fault> check_text(std::string_view text);

}  // namespace lqg::input
