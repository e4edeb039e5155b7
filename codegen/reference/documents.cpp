// SPDX-License-Identifier: MIT
#include "reference/documents.hpp"

#include <algorithm>
#include <sstream>

#include "reference/wording.hpp"

namespace lqg::reference {
namespace {

using input::KeyRule;

constexpr char introduction[] = R"(# Keys of the design file

A design file is [TOML](https://toml.io). Each key belongs to one table. The rules that hold for all keys are in
[README.md](README.md#the-design-file), examples in [designs/](designs). Sizes: nx states, nu inputs, ny outputs,
nw process noises. A number may be an [expression in quotes](README.md#parameters-and-expressions), everywhere.

lqgen reads design files by the table from which this page is made. `lqgen --keys` prints the page, `lqgen --schema` the
JSON Schema for editors, [design.schema.json](design.schema.json).
)";

std::string in_cell(const std::string& text) { return replaced(text, "|", "\\|"); }

std::string link(const KeyRule& rule) { return rule.more.empty() ? "" : " [More](" + rule.more + ")."; }

std::size_t characters(const std::string& text) {
  const auto begins = [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0) != 0x80; };
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins));
}

// Lines of at most 120 characters.
std::string wrapped(const std::string& text) {
  constexpr std::size_t longest = 120;
  std::istringstream words(text);
  std::string out, line, word;
  while (words >> word) {
    if (!line.empty() && characters(line) + 1 + characters(word) > longest) out += line + "\n", line.clear();
    line += (line.empty() ? "" : " ") + word;
  }
  return out + line + "\n";
}

std::string heading(const KeyRule& rule) {
  return "\n## " + header_of(rule) + "\n\n" + wrapped(rule.text + link(rule));
}

std::string row(const KeyRule& rule) {
  return "| `" + name_of(rule) + "` | " + in_cell(values_of(rule)) + " | " + in_cell(rule.text) + link(rule) + " | " +
         in_cell(otherwise(rule)) + " |\n";
}

// The keys of one table; of the table itself only what stands beside its keys.
std::string rows_of(const std::string& table) {
  std::string out;
  for (const KeyRule& rule : input::key_rules())
    if (input::parent_of(rule.path) == table && !is_table(rule)) out += row(rule);
  if (out.empty()) return "";
  return "\n| key | value | what it is | default |\n| --- | --- | --- | --- |\n" + out;
}

// Backslashes and what a line of roff must not begin with.
std::string in_roff(const std::string& text) {
  std::string out = replaced(replaced(replaced(text, "`", ""), "\\", "\\e"), "-", "\\-");
  return out.empty() || (out[0] != '.' && out[0] != '\'') ? out : "\\&" + out;
}

// Each sentence on lines of its own, which roff joins.
std::string in_sentences(const std::string& text) {
  std::istringstream lines(replaced(in_roff(text), ". ", ".\n"));
  std::string out, line;
  while (std::getline(lines, line)) out += wrapped(line);
  return out;
}

std::string entry(const KeyRule& rule) {
  const std::string absent = otherwise(rule), values = replaced(in_roff(values_of(rule)), "\"", "\\(dq");
  std::string out = ".TP\n.BR " + in_roff(rule.path) + " \" (" + values + ")\"\n" + in_sentences(rule.text);
  if (absent == "required") return out + "Required.\n";
  return absent.empty() ? out : out + "Default: " + in_roff(absent) + ".\n";
}

}  // namespace

std::string page() {
  std::string out = introduction + rows_of("");
  for (const KeyRule& rule : input::key_rules())
    if (is_table(rule)) out += heading(rule) + rows_of(rule.path);
  return out;
}

std::string manual() {
  std::string out;
  for (const KeyRule& rule : input::key_rules())
    out += is_table(rule) ? ".SS " + in_roff(header_of(rule)) + "\n" + in_sentences(rule.text) : entry(rule);
  return out;
}

}  // namespace lqg::reference
