// SPDX-License-Identifier: MIT
// Emitted C with at most 120 columns a line, whatever the names of the design.
#pragma once

#include <cstddef>
#include <string>

namespace lqg::emit {

constexpr std::size_t widest_line = 120;

// Columns, not bytes.
std::size_t columns(const std::string& text);

// Breaks lines that are too long: comments between words, code where trace::wrap does; a comment behind code moves
// above it. Lines of the preprocessor stay.
std::string fit_columns(const std::string& text);

}  // namespace lqg::emit
