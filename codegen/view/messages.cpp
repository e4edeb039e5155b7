// SPDX-License-Identifier: MIT
#include "view/messages.hpp"

#include <nlohmann/json.hpp>

namespace lqg::view {

namespace {

using Json = nlohmann::ordered_json;

const char* word_of(Scale scale) {
  return scale == Scale::logarithmic ? "logarithmic" : scale == Scale::whole ? "whole" : "linear";
}

Json json_of(const Tunable& tunable) {
  Json targets = Json::array();
  for (const Target& target : tunable.targets) targets.push_back({{"key", target.key}, {"factor", target.factor}});
  return {{"group", tunable.group}, {"name", tunable.name}, {"unit", tunable.unit}, {"targets", targets},
          {"value", tunable.value}, {"low", tunable.low},   {"high", tunable.high}, {"scale", word_of(tunable.scale)},
          {"step", tunable.step}};
}

void add_lines(Json& message, const Picture& picture) {
  message["lines"] = picture.lines;
  message["line"] = picture.line;
  message["has_error"] = picture.has_error;
  message["has_page"] = picture.page.has_value();
}

// The page is JSON already.
std::string with_page(const Json& message, const std::optional<emit::PageData>& page) {
  std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.pop_back();
  return text + ",\"page\":" + (page ? emit::page_json(*page) : "null") + "}\n";
}

bool is_change(const Json& change) {
  return change.is_object() && change.contains("key") && change["key"].is_string() && change.contains("value") &&
         change["value"].is_number();
}

}  // namespace

std::optional<Numbers> numbers_in(const std::string& body) {
  const Json message = Json::parse(body, nullptr, false);
  if (!message.is_object() || !message.contains("revision") || !message["revision"].is_number_integer())
    return std::nullopt;
  if (!message.contains("changes") || !message["changes"].is_array()) return std::nullopt;
  Numbers numbers;
  numbers.revision = message["revision"].get<long>();
  for (const Json& change : message["changes"]) {
    if (!is_change(change)) return std::nullopt;
    numbers.changes.push_back({change["key"].get<std::string>(), change["value"].get<double>()});
  }
  return numbers;
}

std::optional<std::string> name_in(const std::string& body) {
  const Json message = Json::parse(body, nullptr, false);
  if (!message.is_object() || !message.contains("name") || !message["name"].is_string()) return std::nullopt;
  return message["name"].get<std::string>();
}

std::string state_message(const State& state, const Picture& picture, const std::optional<emit::PageData>& last_good) {
  Json message = {{"revision", state.revision}, {"path", state.path}};
  add_lines(message, picture);
  message["tunables"] = Json::array();
  for (const Tunable& tunable : picture.tunables) message["tunables"].push_back(json_of(tunable));
  message["others"] = state.others;
  return with_page(message, last_good);
}

std::string trial_message(const Picture& picture, double milliseconds) {
  Json message;
  add_lines(message, picture);
  message["milliseconds"] = milliseconds;
  return with_page(message, picture.page);
}

std::string superseded_message() { return Json{{"superseded", true}}.dump() + "\n"; }

std::string written_message() { return Json{{"written", true}}.dump() + "\n"; }

std::string error_message(const std::string& why) {
  return Json{{"error", why}}.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lqg::view
