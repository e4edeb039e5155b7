// SPDX-License-Identifier: MIT
// What is wrong with a design, or worth a note, and under which key of the design file.
#pragma once

#include <string>
#include <vector>

namespace lqg::design {

enum class Severity { note, error };

struct Finding {
  Severity severity = Severity::error;
  std::string key;      // as in the design file: "kalman.measurement_noise"
  std::string message;  // what was expected, what was found
};

using Findings = std::vector<Finding>;

inline bool has_error(const Findings& findings) {
  for (const Finding& finding : findings)
    if (finding.severity == Severity::error) return true;
  return false;
}

void add_error(Findings& findings, const std::string& key, const std::string& message);

// A number in four significant digits, for people.
std::string decimal(double value);

// "requires at most 5, the loop has 7", with as many digits as it takes to tell the two apart.
std::string compared(const char* limit, double required, double found, const char* unit,
                     const std::string& what = "the loop has");

// Said before, it is not said again.
void add_note(Findings& findings, const std::string& key, const std::string& message);

}  // namespace lqg::design
