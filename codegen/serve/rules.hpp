// SPDX-License-Identifier: MIT
// Who may ask. The page is for one person at this machine: other programs in the browser, other pages, and names that
// were made to lead here (DNS rebinding) are refused before anything is read.
#pragma once

#include <optional>
#include <string>

namespace lqg::serve {

// What the rules look at in a request; headers that are not there are empty.
struct Asked {
  std::string method;                            // "GET"
  std::string target;                            // "/TOKEN/state?since=1"
  std::string host, origin, content_type, site;  // site: Sec-Fetch-Site
  std::size_t hosts = 1;                         // how many Host headers there are
};

struct Door {
  unsigned port = 0;
  std::string token;
};

struct Refusal {
  int status = 403;
  std::string why;
};

// Nothing where the request is served. 403: Host is not 127.0.0.1:PORT or localhost:PORT, Origin is not one of these
// with http://, the browser says that another site asks, or the first part of the path is not the token. 405: neither
// GET nor POST. 415: POST of something that is not JSON, which a form of another page could send.
std::optional<Refusal> refuse(const Asked& asked, const Door& door);

// "/state" and "since=1" of "/TOKEN/state?since=1".
std::string path_of(const Asked& asked);
std::string query_of(const Asked& asked);

}  // namespace lqg::serve
