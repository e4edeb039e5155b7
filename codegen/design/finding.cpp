#include "design/finding.hpp"

namespace lqg::design {

void add_error(Findings& findings, const std::string& key, const std::string& message) {
  findings.push_back({Severity::error, key, message});
}

void add_note(Findings& findings, const std::string& key, const std::string& message) {
  for (const Finding& finding : findings)
    if (finding.key == key && finding.message == message) return;
  findings.push_back({Severity::note, key, message});
}

}  // namespace lqg::design
