// SPDX-License-Identifier: MIT
#include "input/design_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>
#include <utility>
#include <variant>

#include "design/operating_point.hpp"
#include "input/assemble.hpp"
#include "input/changed_parameters.hpp"
#include "input/consistency.hpp"
#include "input/document.hpp"
#include "input/equations.hpp"
#include "input/formulas.hpp"
#include "input/names.hpp"
#include "input/parameters.hpp"
#include "input/report.hpp"
#include "input/scenarios.hpp"
#include "input/text.hpp"
#include "input/unit_check.hpp"
#include "input/values.hpp"

namespace lqg::input {
namespace {

constexpr std::size_t largest_file = 4u << 20;  // bytes

DesignFile unreadable(const std::string& reason) {
  DesignFile file;
  file.readable = false;
  Report(file).error("@", Location{0, 0}, "cannot be read: " + reason);
  return file;
}

// Stands for a place where no key is known.
std::string place_key(Location where) { return "@" + std::to_string(where.line) + ":" + std::to_string(where.column); }

DesignFile refused(const std::string& text, const std::vector<Fault>& faults) {
  DesignFile file;
  file.text = text;
  Report report(file);
  for (const Fault& fault : faults) report.error(place_key(fault.where), fault.where, fault.message);
  return file;
}

DesignFile read_stream(std::istream& stream, const std::filesystem::path& folder, const Settings& settings) {
  std::string text(largest_file + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) return unreadable("reading it failed");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return parse_design(text, folder, settings);
}

std::vector<design::Parameter> stated(const Parameters& parameters) {
  std::vector<design::Parameter> all;
  for (const Parameter& one : parameters.all)
    all.push_back({one.name, one.number, one.unit, on_one_line(one.formula), one.is_set});
  return all;
}

std::vector<design::Formula> stated(const Formulas& formulas) {
  std::vector<design::Formula> all;
  for (const PlacedFormula& one : formulas.all)
    all.push_back({one.key, on_one_line(one.node.formula->text), one.node.number});
  return all;
}

// The key above: of "plant.A[2][0]" "plant.A[2]", of "plant.A" "plant", of "plant" "".
std::string above(const std::string& key) {
  const std::size_t cut = key.find_last_of(".[");
  return cut == key.npos ? "" : key.substr(0, cut);
}

}  // namespace

std::optional<Setting> setting_of(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == text.npos || sign == 0) return std::nullopt;
  return Setting{text.substr(0, sign), text.substr(sign + 1)};
}

DesignFile read_design_file(const std::string& path, const Settings& settings) {
  if (path == "-") return read_stream(std::cin, ".", settings);
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return unreadable(error ? error.message() : "there is no such file");
  if (std::filesystem::is_directory(status)) return unreadable("it is a folder");
  if (!std::filesystem::is_regular_file(status)) return unreadable("it is not a regular file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return unreadable(std::generic_category().message(errno));
  DesignFile file = read_stream(stream, std::filesystem::path(path).parent_path(), settings);
  if (!file.readable) return file;
  if (const Complaint complaint = check_file_name(std::filesystem::path(path).filename().string())) {
    Report(file).error("@", Location{0, 0}, *complaint);
    file.problem.reset();
    sort_by_place(file, file.findings);
  }
  return file;
}

DesignFile parse_design(const std::string& text, const std::optional<std::filesystem::path>& folder,
                        const Settings& settings) {
  if (text.size() > largest_file) return refused(text, {{{0, 0}, "expected at most 4 MiB"}});
  if (const auto faults = check_text(text); !faults.empty()) return refused(text, faults);
  auto document = parse_toml(text);
  if (const Fault* fault = std::get_if<Fault>(&document)) return refused(text, {*fault});
  DesignFile file;
  file.text = text;
  Report report(file);
  const FormulaPlaces places(file.text);
  ExactValues exact;
  const Parameters parameters = read_parameters(std::get<Node>(document), settings, places, exact, report);
  const Formulas formulas = read_formulas(std::get<Node>(document), parameters, places, exact, report);
  Values values = read_values(std::get<Node>(document), formulas.wrong, report);
  read_equations(std::get<Node>(document), parameters, places, exact, values, report);
  read_changed_parameters(std::get<Node>(document), parameters, places, exact, values, report);
  check_consistency(values, report);
  check_units(formulas, parameters, values, places, report);
  if (!design::has_error(file.findings)) {
    design::Problem problem = assemble(values);
    problem.parameters = stated(parameters);
    problem.formulas = stated(formulas);
    load_columns(values, folder, problem.scenarios, report);
    begin_at_operating_point(values, problem);
    design::Findings findings;
    design::express_as_deviations(problem, findings);
    for (const design::Finding& finding : findings) report.error(finding.key, finding.message);
    if (!design::has_error(file.findings)) file.problem = std::move(problem);
  }
  sort_by_place(file, file.findings);
  return file;
}

Location locate(const DesignFile& file, const std::string& key) {
  for (std::string at = key; !at.empty(); at = above(at)) {
    const auto found = file.locations.find(at);
    if (found != file.locations.end()) return found->second;
  }
  return {1, 1};
}

void sort_by_place(const DesignFile& file, design::Findings& findings) {
  const auto place = [&](const design::Finding& finding) {
    const Location where = locate(file, finding.key);
    return std::pair(where.line, where.column);
  };
  std::stable_sort(findings.begin(), findings.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

std::string format(const std::string& path, Location where, const design::Finding& finding) {
  std::string line = path;
  if (where.line > 0) line += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  line += finding.severity == design::Severity::note ? ": note: " : ": ";
  if (!finding.key.empty() && finding.key[0] != '@') line += finding.key + ": ";
  return printable(line + finding.message);
}

}  // namespace lqg::input
