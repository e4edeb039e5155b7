// SPDX-License-Identifier: MIT
#include "input/named.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/names.hpp"
#include "input/text.hpp"
#include "input/values.hpp"

namespace lqg::input {

namespace {

// The signal that a key names, with or without its unit; or −1, and what is wrong reported.
int signal_of(const std::string& path, const Key& key, const std::vector<std::string>& names, Report& report) {
  design::Signal signal;
  const bool is_signal = !parse_signal(key.name, signal);
  const auto found = std::find(names.begin(), names.end(), is_signal ? signal.name : key.name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + in_quotes(name);
  report.error(path, key.where, "expected one of " + list + ", found " + in_quotes(key.name));
  return -1;
}

// [low, high] of a largest size or a pair.
std::optional<std::pair<double, double>> read_range(const Node& node) {
  if (node.kind == Kind::number && node.number > 0) return std::pair(-node.number, node.number);
  if (node.kind != Kind::array || node.items.size() != 2) return {};
  const Node &low = node.items[0], &high = node.items[1];
  if (low.kind != Kind::number || high.kind != Kind::number || !(low.number < high.number)) return {};
  return std::pair(low.number, high.number);
}

// The names of a table one after the other: `take(index, value)` of each, once.
template <class Take>
bool walk_names(const std::string& path, const Node& node, const std::vector<std::string>& names, Report& report,
                Take take) {
  if (node.kind != Kind::table || node.keys.empty()) {
    report.error(path, "expected a table with names, found " + describe(node));
    return false;
  }
  std::vector<bool> is_taken(names.size(), false);
  bool good = true;
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const int index = signal_of(path, node.keys[i], names, report);
    if (index >= 0 && is_taken[static_cast<std::size_t>(index)])
      report.error(path, node.keys[i].where,
                   "expected every name once, found " + in_quotes(names[static_cast<std::size_t>(index)]) + " again");
    good = index >= 0 && !is_taken[static_cast<std::size_t>(index)] && take(index, node.items[i]) && good;
    if (index >= 0) is_taken[static_cast<std::size_t>(index)] = true;
  }
  return good;
}

}  // namespace

std::optional<Eigen::MatrixXd> read_ranges(const KeyRule& rule, const Node& node, const std::vector<std::string>& names,
                                           Report& report) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd ranges(names.size(), 2);
  ranges.col(0).setConstant(-infinity);
  ranges.col(1).setConstant(infinity);
  const bool good = walk_names(rule.path, node, names, report, [&](int i, const Node& value) {
    const auto range = read_range(value);
    if (!range) {
      const std::string& name = names[static_cast<std::size_t>(i)];
      report.error(rule.path + "." + name, value.where,
                   "expected a largest size > 0, or [low, high] with low < high, found " +
                       (value.kind == Kind::number ? shown(value.number) : describe(value)));
      return false;
    }
    ranges.row(i) << range->first, range->second;
    return true;
  });
  if (!good) return {};
  return ranges;
}

std::optional<std::map<std::string, double>> read_prices(const std::string& key, const Node& node,
                                                         const std::vector<std::string>& names, Report& report) {
  std::map<std::string, double> prices;
  const bool good = walk_names(key, node, names, report, [&](int i, const Node& value) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    const bool is_price = value.kind == Kind::number && value.number > 0 && std::isfinite(value.number);
    if (!is_price)
      report.error(
          key + "." + name, value.where,
          "expected a number > 0, found " + (value.kind == Kind::number ? shown(value.number) : describe(value)));
    else
      prices[name] = value.number;
    return is_price;
  });
  if (!good) return {};
  return prices;
}

}  // namespace lqg::input
