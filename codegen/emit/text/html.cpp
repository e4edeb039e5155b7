// SPDX-License-Identifier: MIT
#include "emit/text/html.hpp"

namespace lqg::emit {

namespace {

constexpr const char* style =
    R"(:root { color-scheme: light dark; --ink: #1c2430; --paper: #fcfcfa; --faint: #667; --rule: #d8dade; )"
    R"(--panel: #f1f2f0;
  --curve-0: #1763a6; --curve-1: #d9730d; --curve-2: #2e8540; --curve-3: #a62b6f; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7ea; --paper: #14181d; --faint: #98a2ad; )"
    R"(--rule: #333b44; --panel: #1c2229;
  --curve-0: #6cb2f0; --curve-1: #f0a050; --curve-2: #7bc98b; --curve-3: #e27bb1; } }
body { margin: 2rem auto; padding: 0 1rem; max-width: 64rem; font: 16px/1.45 system-ui, sans-serif; )"
    R"(color: var(--ink); background: var(--paper); }
h1 { margin: 0; font-size: 1.7rem; } )"
    R"(h2 { margin: 2.2rem 0 .6rem; font-size: 1.15rem; border-bottom: 1px solid var(--rule); }
p.brief { margin: .2rem 0 0; font-size: 1.1rem; } )"
    R"(p.made, footer, figcaption { color: var(--faint); font-size: .85rem; overflow-wrap: anywhere; }
.tables, .charts { display: grid; gap: 1rem; )"
    R"(grid-template-columns: repeat(auto-fit, minmax(min(20rem, 100%), 1fr)); align-items: start; }
.charts { grid-template-columns: repeat(auto-fill, minmax(min(27rem, 100%), 1fr)); }
table { width: 100%; border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
td, th { padding: .18rem .5rem; border-bottom: 1px solid var(--rule); text-align: right; } )"
    R"(td:first-child, th:first-child { text-align: left; }
th { font-weight: 600; }
details { margin: .4rem 0; padding: .3rem .7rem; background: var(--panel); border-radius: .3rem; } )"
    R"(summary { cursor: pointer; }
.matrix { overflow-x: auto; } )"
    R"(.matrix table { width: auto; font-family: ui-monospace, monospace; font-size: .8rem; } .matrix td { border: 0; }
svg { width: 100%; height: auto; background: var(--panel); border-radius: .3rem; font: 11px system-ui, sans-serif; })"
    R"( svg text { fill: var(--ink); }
svg .title { font-weight: 600; font-size: 12px; } svg .tick { fill: var(--faint); } )"
    R"(svg path { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
svg .grid { stroke: var(--rule); } svg .zero { stroke: var(--faint); } )"
    R"(svg .circle { fill: none; stroke: var(--faint); stroke-dasharray: 2 2; }
svg .dashes { stroke-dasharray: 5 3; } svg .dots { stroke-width: 3; stroke-linecap: round; }
svg .s0 { stroke: var(--curve-0); } svg .s1 { stroke: var(--curve-1); } svg .s2 { stroke: var(--curve-2); } )"
    R"(svg .s3 { stroke: var(--curve-3); }
svg .legend { font-weight: 600; } svg .c0 { fill: var(--curve-0); } svg .c1 { fill: var(--curve-1); } )"
    R"(svg .c2 { fill: var(--curve-2); } svg .c3 { fill: var(--curve-3); }
)";

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  return out;
}

std::size_t letters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

std::string table(const Rows& rows) {
  std::string out;
  for (const auto& [what, value] : rows)
    if (!value.empty()) out += "<tr><td>" + escaped(what) + "</td><td>" + escaped(value) + "</td></tr>\n";
  return out.empty() ? "" : "<table>\n" + out + "</table>\n";
}

std::string page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + "</title>\n<style>\n" + style + "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

}  // namespace lqg::emit
