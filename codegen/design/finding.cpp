// SPDX-License-Identifier: MIT
#include "design/finding.hpp"

#include <charconv>
#include <cstdio>

namespace lqg::design {

namespace {

std::string text_of(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

void add_error(Findings& findings, const std::string& key, const std::string& message) {
  findings.push_back({Severity::error, key, message});
}

void add_note(Findings& findings, const std::string& key, const std::string& message) {
  for (const Finding& finding : findings)
    if (finding.key == key && finding.message == message) return;
  findings.push_back({Severity::note, key, message});
}

std::string compared(const char* limit, double required, double found, const char* unit, const std::string& what) {
  const char* format = text_of(required, "%.6g") != text_of(found, "%.6g") ? "%.6g" : "%.17g";
  return std::string("requires ") + limit + " " + text_of(required, format) + unit + ", " + what + " " +
         text_of(found, format) + unit;
}

std::string decimal(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
  return std::string(text, end.ptr);
}

}  // namespace lqg::design
