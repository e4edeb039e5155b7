// SPDX-License-Identifier: MIT
#include "reference/wording.hpp"

#include "input/matrices.hpp"

namespace lqg::reference {

using input::KeyRule;
using input::Type;

std::string name_of(const KeyRule& rule) {
  const std::string parent = input::parent_of(rule.path);
  return parent.empty() ? rule.path : rule.path.substr(parent.size() + 1);
}

bool is_table(const KeyRule& rule) {
  return rule.type == Type::table || rule.type == Type::tables || rule.type == Type::parameters;
}

std::string header_of(const KeyRule& rule) {
  return rule.type == Type::tables ? "[[" + rule.path + "]]" : "[" + rule.path + "]";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}

std::string values_of(const KeyRule& rule) {
  const std::string rows = input::name_of(rule.rows), columns = input::name_of(rule.columns);
  std::string words;
  for (const std::string& word : rule.words) words += (words.empty() ? "`\"" : ", `\"") + word + "\"`";
  switch (rule.type) {
    case Type::identifier: return "identifier";
    case Type::line: return "one line of text";
    case Type::word: return words;
    case Type::positive: return "number > 0";
    case Type::not_negative: return "number ≥ 0";
    case Type::real: return "number";
    case Type::flag: return "`true`, `false`";
    case Type::threshold: return "number > 0, or inf";
    case Type::amount: return "number ≥ 0, or " + words;
    case Type::whole:
    case Type::step: return "whole number ≥ 1";
    case Type::steps: return "whole number ≥ 0";
    case Type::matrix: return rows + " × " + columns;
    case Type::weight: return rows + " × " + columns + ", or its diagonal";
    case Type::mask: return rows + " × " + columns + " of 0 and 1, or names";
    case Type::vector: return rows + " numbers";
    case Type::positives: return rows + " numbers > 0";
    case Type::bounds: return rows + " numbers, inf allowed";
    case Type::counts: return "whole numbers ≥ 1";
    case Type::ranges: return "name = largest size, or [low, high]";
    case Type::prices: return "number > 0, or name = number > 0";
    case Type::indices: return "names or numbers of outputs";
    case Type::walks: return "names or numbers of inputs, or a number > 0 of each";
    case Type::signal:
    case Type::entry: return "name or number of a signal";
    case Type::poles: return "poles";
    case Type::formulas: return rows + " formulas";
    case Type::point: return rows + " numbers, formulas or `\"?\"`";
    case Type::states: return "names of states";
    case Type::signals: return rows + " names with units";
    case Type::table:
    case Type::tables:
    case Type::parameters: return "table";
  }
  return "";
}

std::string otherwise(const KeyRule& rule) {
  if (rule.need == input::Need::required) return "required";
  if (!rule.otherwise.empty()) return rule.otherwise;
  return rule.words.empty() || rule.type == Type::amount ? "" : "`\"" + rule.words.front() + "\"`";
}

}  // namespace lqg::reference
