// SPDX-License-Identifier: MIT
#include "input/lists.hpp"

#include <algorithm>
#include <cmath>

#include "design/problem.hpp"
#include "input/formulas.hpp"
#include "input/matrices.hpp"
#include "input/text.hpp"
#include "input/values.hpp"

namespace lqg::input {
namespace {

using Pole = std::complex<double>;

std::string item_of(const std::string& key, std::size_t index) { return key + "[" + std::to_string(index) + "]"; }

bool is_finite_number(const Node& node) { return node.kind == Kind::number && std::isfinite(node.number); }

std::optional<Pole> read_pole(const Node& node) {
  if (is_finite_number(node)) return Pole(node.number, 0);
  const bool is_pair = node.kind == Kind::array && node.items.size() == 2 && is_finite_number(node.items[0]) &&
                       is_finite_number(node.items[1]);
  if (!is_pair) return {};
  return Pole(node.items[0].number, node.items[1].number);
}

std::string shown_pole(const Pole& pole) { return "[" + shown(pole.real()) + ", " + shown(pole.imag()) + "]"; }

// Takes the conjugate of `pole` out of `poles`.
bool take_conjugate(std::vector<Pole>& poles, const Pole& pole) {
  const auto found = std::find(poles.begin(), poles.end(), std::conj(pole));
  if (found == poles.end()) return false;
  poles.erase(found);
  return true;
}

Node with_name_as_index(Node item, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), item.text);
  if (item.kind != Kind::text || found == names.end()) return item;
  item.kind = Kind::number;
  item.number = static_cast<double>(found - names.begin());
  return item;
}

// What else than an index is good.
std::string names_too(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? ", or one of " : ", ") + in_quotes(name);
  return list;
}

// ", "force"", of all of them.
std::string of_names(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? ", " : " or ") + in_quotes(name);
  return list;
}

}  // namespace

std::optional<std::vector<int>> read_indices(const KeyRule& rule, const Node& node, const std::map<Size, int>& sizes,
                                             const std::vector<std::string>& names, Report& report) {
  const int size = sizes.at(rule.rows);
  const std::string wanted =
      size > 0 ? "a whole number from 0 to " + std::to_string(size - 1) + " (" + name_of(rule.rows) + " − 1)"
               : "a whole number ≥ 0";
  if (node.kind != Kind::array || node.items.empty()) {
    report.error(rule.path, "expected an array of indices or names, found " + describe(node));
    return {};
  }
  std::vector<int> indices;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node item = with_name_as_index(node.items[i], names);
    const bool is_number = item.kind == Kind::number;
    const bool good = is_number && item.number >= 0 && item.number == std::floor(item.number) &&
                      item.number < (size > 0 ? size : most_signals);
    std::string wrong;
    if (!good)
      wrong = "expected " + wanted + names_too(names) + ", found " +
              (is_number                 ? shown(item.number)
               : item.kind == Kind::text ? in_quotes(item.text)
                                         : describe(item));
    else if (std::find(indices.begin(), indices.end(), static_cast<int>(item.number)) != indices.end())
      wrong = "expected every index once, found " + shown(item.number) + " again";
    if (!wrong.empty()) {
      report.error(item_of(rule.path, i), item.where, wrong);
      return {};
    }
    indices.push_back(static_cast<int>(item.number));
  }
  return indices;
}

std::optional<std::vector<int>> read_counts(const std::string& key, const Node& node, Report& report) {
  constexpr double most = design::most_steps;
  if (node.kind != Kind::array || node.items.empty()) {
    report.error(key, "expected an array of whole numbers, found " + describe(node));
    return {};
  }
  std::vector<int> counts;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    const bool is_number = item.kind == Kind::number;
    if (!is_number || !(item.number >= 1 && item.number <= most) || !is_whole(item)) {
      report.error(item_of(key, i), item.where,
                   "expected a whole number from 1 to " + std::to_string(design::most_steps) + ", found " +
                       (is_number ? shown(item) : describe(item)));
      return {};
    }
    counts.push_back(static_cast<int>(item.number));
  }
  return counts;
}

std::optional<Walks> read_walks(const KeyRule& rule, const Node& node, const std::map<Size, int>& sizes,
                                const std::vector<std::string>& names, Report& report) {
  Walks walks;
  if (node.kind != Kind::table) {
    const std::optional<std::vector<int>> indices = read_indices(rule, node, sizes, names, report);
    if (!indices) return {};
    walks.indices = *indices;
    return walks;
  }
  if (node.items.empty()) {
    report.error(rule.path, "expected names of inputs, found an empty table");
    return {};
  }
  walks.sizes.resize(static_cast<Eigen::Index>(node.items.size()));
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    const std::string& name = node.keys[i].name;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      report.error(rule.path, node.keys[i].where,
                   "expected names of inputs" + of_names(names) + ", found " + in_quotes(name));
      return {};
    }
    report.place(rule.path + "." + name, item.where);
    if (!is_finite_number(item) || !(item.number > 0)) {
      report.error(rule.path + "." + name,
                   "expected a number > 0, found " + (item.kind == Kind::number ? shown(item.number) : describe(item)));
      return {};
    }
    walks.indices.push_back(static_cast<int>(found - names.begin()));
    walks.sizes(static_cast<Eigen::Index>(i)) = item.number;
  }
  return walks;
}

std::optional<int> read_signal_index(const KeyRule& rule, const Node& node, const std::vector<std::string>& names,
                                     Report& report) {
  const Node item = with_name_as_index(node, names);
  const double most = names.empty() ? most_signals : static_cast<double>(names.size());
  if (item.kind == Kind::number && item.number >= 0 && item.number == std::floor(item.number) && item.number < most)
    return static_cast<int>(item.number);
  const std::string found = item.kind == Kind::number ? shown(item.number)
                            : item.kind == Kind::text ? in_quotes(item.text)
                                                      : describe(item);
  const std::string numbers = names.empty() ? "≥ 0" : "from 0 to " + std::to_string(names.size() - 1);
  report.error(rule.path, "expected a whole number " + numbers + names_too(names) + ", found " + found);
  return {};
}

std::optional<std::vector<Pole>> read_poles(const std::string& key, const Node& node, Report& report) {
  if (node.kind != Kind::array || node.items.empty()) {
    report.error(key, "expected an array of poles, found " + describe(node));
    return {};
  }
  std::vector<Pole> left;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::optional<Pole> pole = read_pole(node.items[i]);
    if (!pole) {
      report.error(item_of(key, i), node.items[i].where,
                   "expected a finite number or [re, im], found " + describe(node.items[i]));
      return {};
    }
    left.push_back(*pole);
  }
  std::vector<Pole> poles;
  while (!left.empty()) {
    const Pole pole = left.front();
    left.erase(left.begin());
    if (pole.imag() == 0) {
      poles.push_back(pole);
    } else if (take_conjugate(left, pole)) {
      const Pole upper = pole.imag() > 0 ? pole : std::conj(pole);
      poles.insert(poles.end(), {upper, std::conj(upper)});
    } else {
      report.error(key, "expected the conjugate of " + shown_pole(pole) + ", too");
      return {};
    }
  }
  return poles;
}

}  // namespace lqg::input
