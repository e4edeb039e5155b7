// SPDX-License-Identifier: MIT
#include "serve/rules.hpp"

#include <string_view>

#include "serve/token.hpp"

namespace lqg::serve {

namespace {

bool is_own_host(const Asked& asked, const Door& door) {
  const std::string port = ":" + std::to_string(door.port);
  return asked.hosts == 1 && (asked.host == "127.0.0.1" + port || asked.host == "localhost" + port);
}

// Browsers leave Origin out where a page asks its own server with GET.
bool is_own_origin(const Asked& asked) { return asked.origin.empty() || asked.origin == "http://" + asked.host; }

bool is_own_site(const Asked& asked) {
  return asked.site.empty() || asked.site == "same-origin" || (asked.site == "none" && asked.method == "GET");
}

// "TOKEN" of "/TOKEN/state?since=1".
std::string_view token_in(const Asked& asked) {
  std::string_view target = asked.target;
  if (target.empty() || target[0] != '/') return {};
  target.remove_prefix(1);
  return target.substr(0, target.find_first_of("/?"));
}

bool is_json(const std::string& type) { return type == "application/json" || type.rfind("application/json;", 0) == 0; }

}  // namespace

std::optional<Refusal> refuse(const Asked& asked, const Door& door) {
  if (!is_own_host(asked, door)) return Refusal{403, "wrong host"};
  if (!is_own_origin(asked) || !is_own_site(asked)) return Refusal{403, "wrong origin"};
  if (!is_same_secret(token_in(asked), door.token)) return Refusal{403, "wrong token"};
  if (asked.method != "GET" && asked.method != "POST") return Refusal{405, "expected GET or POST"};
  if (asked.method == "POST" && !is_json(asked.content_type)) return Refusal{415, "expected application/json"};
  return std::nullopt;
}

std::string path_of(const Asked& asked) {
  const std::string target = asked.target.substr(0, asked.target.find('?'));
  const std::size_t behind_token = target.find('/', 1);
  return behind_token == target.npos ? "" : target.substr(behind_token);
}

std::string query_of(const Asked& asked) {
  const std::size_t mark = asked.target.find('?');
  return mark == asked.target.npos ? "" : asked.target.substr(mark + 1);
}

}  // namespace lqg::serve
