// SPDX-License-Identifier: MIT
#include "emit/text/parameter_description.hpp"

#include <algorithm>

#include "emit/text/columns.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using TextTable = std::vector<std::vector<std::string>>;

constexpr std::size_t most_expressions = 40;

std::string shortest(double value) { return number(design::Real(value), true); }

// An expression is in ASCII.
std::string cut(const std::string& text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? text : text.substr(0, longest) + " …";
}

// Columns side by side, but for the last one of a row, which is cut.
std::string lines_of(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (const auto& row : table)
    for (std::size_t j = 0; j + 1 < row.size(); ++j) {
      if (widths.size() <= j) widths.push_back(0);
      widths[j] = std::max(widths[j], columns(row[j]));
    }
  std::string out;
  for (const auto& row : table) {
    std::string line = " ";
    for (std::size_t j = 0; j < row.size(); ++j)
      line += " " + (j + 1 < row.size() ? row[j] + std::string(widths[j] - columns(row[j]) + 1, ' ') : cut(row[j]));
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string origin_of(const design::Parameter& parameter) {
  const std::string set = parameter.is_set ? "set on the command line" : "";
  if (parameter.formula.empty()) return set;
  return set + (set.empty() ? "" : ", ") + "= " + parameter.formula;
}

}  // namespace

std::vector<std::vector<std::string>> table_of_parameters(const Controller& controller) {
  TextTable table;
  for (const design::Parameter& parameter : controller.problem.parameters)
    table.push_back({parameter.name, shortest(parameter.value) + (parameter.unit.empty() ? "" : " " + parameter.unit),
                     origin_of(parameter)});
  return table;
}

std::vector<std::vector<std::string>> table_of_expressions(const Controller& controller) {
  const std::vector<design::Formula>& all = controller.problem.formulas;
  TextTable table;
  for (std::size_t i = 0; i < std::min(all.size(), most_expressions); ++i)
    table.push_back({all[i].key, shortest(all[i].value), "= " + all[i].text});
  if (all.size() > most_expressions)
    table.push_back({"and " + std::to_string(all.size() - most_expressions) + " more", "", ""});
  return table;
}

std::string describe_parameters(const Controller& controller) {
  if (controller.problem.parameters.empty()) return "";
  return "\nParameters:\n\n" + lines_of(table_of_parameters(controller));
}

std::string describe_expressions(const Controller& controller) {
  if (controller.problem.formulas.empty()) return "";
  return "\nNumbers of the design file that expressions give:\n\n" + lines_of(table_of_expressions(controller));
}

}  // namespace lqg::emit
