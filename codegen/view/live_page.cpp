// SPDX-License-Identifier: MIT
#include "view/live_page.hpp"

#include <filesystem>

#include "emit/page/page.hpp"
#include "serve/token.hpp"
#include "view/panel.hpp"
#include "view/picture.hpp"

namespace lqg::view {

namespace {

// Names the scripts that may run: text that came into the page by a mistake of ours is none of them.
std::string with_nonce(std::string html, const std::string& nonce) {
  const std::string tag = "<script>";
  for (std::size_t at = html.find(tag); at != html.npos; at = html.find(tag, at + 1))
    html.replace(at, tag.size(), "<script nonce=\"" + nonce + "\">");
  return html;
}

}  // namespace

serve::Reply live_page(const std::string& path) {
  emit::PageExtras extras;
  extras.panel = panel::body;
  extras.style = panel::style;
  extras.script = panel::script;
  extras.may_connect = true;
  const std::string nonce = serve::random_token();
  const std::string name = std::filesystem::path(path).filename().string();
  return {200, "text/html; charset=utf-8", with_nonce(emit::page_html(empty_page(name), extras), nonce),
          "default-src 'none'; script-src 'nonce-" + nonce +
              "'; style-src 'unsafe-inline'; img-src data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
              "frame-ancestors 'none'"};
}

}  // namespace lqg::view
