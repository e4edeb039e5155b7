// SPDX-License-Identifier: MIT
#include "input/toml_hint.hpp"

#include <regex>

namespace lqg::input {
namespace {

constexpr std::size_t longest_line = 400;  // std::regex recurses

// What stands to the right of the first =, without strings and comment.
std::string value_of(std::string_view line) {
  std::string value;
  char delimiter = 0;
  for (const char c : line.substr(line.find('=') + 1)) {
    if (delimiter != 0)
      delimiter = c == delimiter ? '\0' : delimiter;
    else if (c == '"' || c == '\'')
      delimiter = c;
    else if (c == '#')
      break;
    else
      value += c;
  }
  return value;
}

bool has(const std::string& text, const char* pattern) { return std::regex_search(text, std::regex(pattern)); }

}  // namespace

std::string toml_hint(std::string_view line) {
  if (line.size() > longest_line) return "";
  const std::string value = value_of(line);
  if (has(value, "^\\s*\\[.*;") || has(value, "\\[[^\\]]*[0-9.]\\s+[-+]?[0-9.]") ||
      has(value, "^\\s*(eye|diag|zeros|ones)\\("))
    return "expected a matrix as an array of rows, [[1, 2], [3, 4]], found MATLAB's notation";
  if (has(value, "[0-9.)]\\s*[*/^]|[*/^]\\s*[0-9.(]|[0-9.)]\\s+[-+]\\s*[0-9.(]|\\b(pi|sqrt|exp|sin|cos)\\b"))
    return "expected numbers, found arithmetic: it stands in quotes, \"2*pi*50\"";
  if (has(value, "(^|[\\s\\[,])[-+]?[0-9][0-9_.]*(e[-+]?[0-9]+)?\\s*[A-Za-z%][A-Za-z/]*[0-9]?\\s*($|[,\\]])"))
    return "expected a number without a unit; units are SI, and may stand in a comment behind it or "
           "in the names of signals, \"dy1 [m]\"";
  return "";
}

}  // namespace lqg::input
