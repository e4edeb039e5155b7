// SPDX-License-Identifier: MIT
#include "emit/text/text.hpp"

#include <algorithm>

namespace lqg::emit {

namespace {

const std::string mark = "//? ", inverse = "not ";

bool holds(const std::string& condition, const Conditions& conditions) {
  const bool is_inverse = condition.rfind(inverse, 0) == 0;
  return conditions.at(is_inverse ? condition.substr(inverse.size()) : condition) != is_inverse;
}

std::string without_blanks_behind(const std::string& text) { return text.substr(0, text.find_last_not_of(' ') + 1); }

}  // namespace

std::string fill(const std::string& text, const Words& words) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text[at] == '{' ? text.find('}', at) : std::string::npos;
    const auto word = end == std::string::npos ? words.end() : words.find(text.substr(at + 1, end - at - 1));
    if (word == words.end()) {
      out += text[at++];
    } else {
      out += word->second;
      at = end + 1;
    }
  }
  return out;
}

std::string keep_lines(const std::string& text, const Conditions& conditions) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const std::size_t marked = line.find(mark);
    const bool is_marked = marked != std::string::npos;
    if (!is_marked || holds(line.substr(marked + mark.size()), conditions))
      out += (is_marked ? without_blanks_behind(line.substr(0, marked)) : line) + text.substr(end, 1);
    at = end + 1;
  }
  return out;
}

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

}  // namespace lqg::emit
