// SPDX-License-Identifier: MIT
#include "emit/page/page.hpp"

#include "emit/page/body.hpp"
#include "emit/page/embedded.hpp"
#include "emit/page/page_json.hpp"
#include "emit/text/html.hpp"

namespace lqg::emit {

namespace {

std::string policy(const PageExtras& extras) {
  return std::string("default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; base-uri 'none'; ") +
         "form-action 'none'" + (extras.may_connect ? "; connect-src 'self'" : "");
}

std::string script(const std::string& text) { return "<script>\n" + text + "</script>\n"; }

// Our own scripts share names with each other, and with nobody else.
std::string own_scripts() {
  return std::string("(() => {\n\"use strict\";\n") + embedded::data + embedded::chart + embedded::figure +
         embedded::copy + embedded::page + "})();\n";
}

}  // namespace

std::string page_html(const PageData& data, const PageExtras& extras) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         policy(extras) + "\">\n<title>" + escaped(data.title) + "</title>\n<style>\n" + embedded::style +
         extras.style + "</style>\n</head>\n<body>\n<pre id=\"lqg-errors\" role=\"alert\" hidden></pre>\n" +
         extras.panel + "<main id=\"lqg-page\">\n" + body(data, true) +
         "</main>\n<div id=\"lqg-said\" role=\"status\"></div>\n<script type=\"application/json\" id=\"lqg-data\">\n" +
         json_of(data, false) + "\n</script>\n" + script(embedded::chart_js) + script(own_scripts()) +
         (extras.script.empty() ? "" : script(extras.script)) + "</body>\n</html>\n";
}

std::string page_json(const PageData& data) { return json_of(data, true); }

}  // namespace lqg::emit
