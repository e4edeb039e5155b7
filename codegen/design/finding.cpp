// SPDX-License-Identifier: MIT
#include "design/finding.hpp"

#include <charconv>

namespace lqg::design {

void add_error(Findings& findings, const std::string& key, const std::string& message) {
  findings.push_back({Severity::error, key, message});
}

void add_note(Findings& findings, const std::string& key, const std::string& message) {
  for (const Finding& finding : findings)
    if (finding.key == key && finding.message == message) return;
  findings.push_back({Severity::note, key, message});
}

std::string decimal(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
  return std::string(text, end.ptr);
}

}  // namespace lqg::design
