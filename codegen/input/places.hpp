// SPDX-License-Identifier: MIT
// Places of a text: from lines and columns to bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "input/location.hpp"
#include "input/text.hpp"

namespace lqg::input {

// Finds the byte of a line and a column in characters.
class Places {
 public:
  explicit Places(std::string_view text) : text_(text) {
    lines_.push_back(text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0);  // a byte order mark is in no column
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) lines_.push_back(at + 1);
  }

  std::size_t byte(Location where) const {
    std::size_t at = lines_[static_cast<std::size_t>(where.line - 1)];
    for (int column = 1; column < where.column && at < text_.size(); ++column)
      at += std::max<std::size_t>(1, decode(text_, at).length);
    return at;
  }

  // Of the number that begins there: up to what may stand behind a value.
  std::size_t length(std::size_t begin) const {
    return std::min(text_.find_first_of(" \t\r\n,]}#", begin), text_.size()) - begin;
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> lines_;  // where each begins
};

}  // namespace lqg::input
