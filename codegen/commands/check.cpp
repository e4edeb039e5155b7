// SPDX-License-Identifier: MIT
#include "commands/check.hpp"

#include <nlohmann/json.hpp>

#include "emit/report/json.hpp"

namespace lqg::commands {

std::string check_json(int status, const input::DesignFile& file, design::Findings findings,
                       const controller::Controller* controller) {
  using Json = nlohmann::ordered_json;
  Json out = {{"status", status}, {"findings", Json::array()}, {"design", nullptr}};
  input::sort_by_place(file, findings);
  for (const design::Finding& finding : findings) {
    const input::Location where = input::locate(file, finding.key);
    const bool has_key = !finding.key.empty() && finding.key[0] != '@';
    out["findings"].push_back({{"severity", finding.severity == design::Severity::error ? "error" : "note"},
                               {"line", where.line},
                               {"column", where.column},
                               {"key", has_key ? finding.key : ""},
                               {"message", finding.message}});
  }
  if (controller) out["design"] = Json::parse(emit::json(*controller));
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lqg::commands
