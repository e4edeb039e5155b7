// SPDX-License-Identifier: MIT
#include "input/values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "input/formulas.hpp"
#include "input/lists.hpp"
#include "input/matrices.hpp"
#include "input/named.hpp"
#include "input/names.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

using Nodes = std::map<std::string, const Node*>;

// "Q" of "lqr.Q"
std::string name_in_table(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// The key itself, or the bracket before it in a table's header.
Location start_of(const Key& key, const Node& node) {
  const auto order = [](const Location& where) { return std::pair(where.line, where.column); };
  return order(node.where) < order(key.where) ? node.where : key.where;
}

// Walks the tables: known keys into `nodes`, the rest is reported.
class Collector {
 public:
  Collector(Nodes& nodes, Values& values, const std::set<std::string>& wrong, Report& report)
      : nodes_(nodes), values_(values), wrong_(wrong), report_(report) {}

  void walk(const Node& table, const std::string& parent) {
    values_.tables.insert(parent);
    values_.instances[rule_path(parent)].push_back(parent);
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      const std::string path = path_of(parent, table.keys[i].name);
      const KeyRule* rule = find_rule(rule_path(path));
      if (wrong_.count(path) == 0) report_.place(path, table.items[i].where);  // else it is where it goes wrong
      values_.present.insert(path);
      if (rule == nullptr)
        report_unknown(table.keys[i], table.items[i], parent, path);
      else if (rule->type == Type::table)
        enter(table.items[i], path);
      else if (rule->type == Type::tables)
        enter_all(table.items[i], path);
      else
        nodes_[path] = &table.items[i];
    }
  }

 private:
  void report_unknown(const Key& key, const Node& node, const std::string& parent, const std::string& path) {
    const Suggestion suggestion = suggest(rule_path(parent), key.name);
    const bool is_here = parent_of(suggestion.path) == rule_path(parent);
    values_.present.insert(is_here ? path_of(parent, name_in_table(suggestion.path)) : suggestion.path);
    report_.error(path, start_of(key, node), suggestion.message);
  }

  void enter(const Node& node, const std::string& path) {
    if (node.kind == Kind::table)
      walk(node, path);
    else
      report_.error(path, "expected a table, found " + describe(node));
  }

  void enter_all(const Node& node, const std::string& path) {
    if (node.kind != Kind::array || node.items.empty())
      return report_.error(path, "expected tables [[" + path + "]], found " + describe(node));
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string item = path + "[" + std::to_string(i) + "]";
      report_.place(item, node.items[i].where);
      enter(node.items[i], item);
    }
  }

  Nodes& nodes_;
  Values& values_;
  const std::set<std::string>& wrong_;
  Report& report_;
};

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + in_quotes(words[i]);
  return list;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// "stage[0].from" of the table "stage[0]" and the rule of "stage.from".
std::string joined_rule(const std::string& table, const KeyRule& rule) {
  const std::string parent = parent_of(rule.path);
  return parent.empty() ? rule.path : table + rule.path.substr(parent.size());
}

// Reads one key after the other into `values`.
class ValueReader {
 public:
  ValueReader(Values& values, Report& report) : values_(values), report_(report) {}

  void read(const KeyRule& rule, const Node& node) {
    if (!has_its_matrix(rule)) return;
    switch (rule.type) {
      case Type::identifier: read_text(rule, node, check_design_name); break;
      case Type::line: read_text(rule, node, check_comment_text); break;
      case Type::word: read_word(rule, node); break;
      case Type::positive: read_number(rule, node, "a number > 0", [](double x) { return x > 0; }); break;
      case Type::not_negative: read_number(rule, node, "a number ≥ 0", [](double x) { return x >= 0; }); break;
      case Type::real: read_number(rule, node, "a finite number", [](double x) { return !std::isnan(x); }); break;
      case Type::flag: read_flag(rule, node); break;
      case Type::threshold: read_threshold(rule, node); break;
      case Type::amount: read_amount(rule, node); break;
      case Type::whole: read_whole(rule, node, 1, std::numeric_limits<int>::max()); break;
      case Type::steps: read_whole(rule, node, 0, design::most_steps); break;
      case Type::step: read_whole(rule, node, 1, design::most_steps); break;
      case Type::signals: read_signals(rule, node); break;
      case Type::indices:
        if (auto indices = read_indices(rule, node, values_.sizes, names_of(Size::ny), report_))
          values_.indices[rule.path] = *indices;
        break;
      case Type::counts:
        if (auto counts = read_counts(rule.path, node, report_)) values_.indices[rule.path] = *counts;
        break;
      case Type::ranges:
        if (auto ranges = read_ranges(rule, node, names_of(rule.rows), report_)) values_.matrices[rule.path] = *ranges;
        break;
      case Type::prices:
        if (node.kind != Kind::table)
          read_number(rule, node, "a number > 0, or names with numbers > 0", [](double x) { return x > 0; });
        else if (auto prices = read_prices(rule.path, node, all_names(), report_))
          values_.named[rule.path] = *prices;
        break;
      case Type::walks:
        if (auto walks = read_walks(rule, node, values_.sizes, names_of(rule.rows), report_)) {
          values_.indices[rule.path] = walks->indices;
          if (walks->sizes.size() > 0) values_.matrices[rule.path] = walks->sizes;
        }
        break;
      case Type::signal:
        if (const auto index = read_signal_index(rule, node, names_of(rule.rows), report_))
          values_.numbers[rule.path] = *index;
        break;
      case Type::entry: read_entry(rule, node); break;
      case Type::poles:
        if (auto poles = read_poles(rule.path, node, report_)) values_.poles[rule.path] = *poles;
        break;
      case Type::mask:
        if (const auto mask = mask_of_names(rule, node)) {
          if (auto matrix = read_matrix(rule, *mask, values_.sizes, report_)) values_.matrices[rule.path] = *matrix;
        }
        break;
      case Type::matrix:
      case Type::weight:
      case Type::vector:
      case Type::positives:
      case Type::bounds:
        if (auto matrix = read_matrix(rule, node, values_.sizes, report_)) values_.matrices[rule.path] = *matrix;
        break;
      case Type::formulas:  // by read_equations
      case Type::point:
      case Type::states:
      case Type::table:
      case Type::tables:
      case Type::parameters: break;
    }
  }

 private:
  std::vector<std::string> names_of(Size size) const { return signal_names(values_, size); }
  std::vector<std::string> all_names() const {
    std::vector<std::string> all;
    for (const Size size : {Size::nx, Size::nu, Size::ny})
      for (const std::string& name : names_of(size)) all.push_back(name);
    return all;
  }

  // A mask whose rows may be lists of names, [["angle", "rate"]]: as rows of 0 and 1.
  std::optional<Node> mask_of_names(const KeyRule& rule, const Node& node) {
    Node mask = node;
    if (node.kind != Kind::array) return mask;
    const std::vector<std::string> names = names_of(rule.columns);
    const auto is_name = [](const Node& entry) { return entry.kind == Kind::text; };
    const auto has_names = [&](const Node& row) { return std::any_of(row.items.begin(), row.items.end(), is_name); };
    if (!std::any_of(node.items.begin(), node.items.end(), has_names)) return mask;
    for (std::size_t i = 0; i < mask.items.size(); ++i) {
      Node& row = mask.items[i];
      if (row.kind != Kind::array || (!row.items.empty() && !has_names(row))) continue;
      std::vector<Node> entries(names.size(), Node{Kind::number, row.where, 0, "", {}, {}});
      for (std::size_t j = 0; j < row.items.size(); ++j) {
        const auto found = std::find(names.begin(), names.end(), row.items[j].text);
        if (!is_name(row.items[j]) || found == names.end()) {
          report_.error(rule.path + "[" + std::to_string(i) + "][" + std::to_string(j) + "]", row.items[j].where,
                        "expected one of " + listed(names) + ", found " +
                            (is_name(row.items[j]) ? in_quotes(row.items[j].text) : describe(row.items[j])));
          return {};
        }
        entries[static_cast<std::size_t>(found - names.begin())].number = 1;
      }
      row.items = entries;
    }
    return mask;
  }

  // False where the key speaks of inputs or outputs and there are none. For the tables [lqr], [limits],
  // [kalman] that is said once for all of their keys.
  bool has_its_matrix(const KeyRule& rule) {
    const bool is_of_f = values_.has("plant.f");
    if (is_of_f && (rule.path == "plant.inputs" || rule.type == Type::formulas || rule.type == Type::point))
      return true;
    for (const auto& [size, matrix, otherwise] :
         {std::tuple(Size::nu, "plant.B", "plant.inputs"), std::tuple(Size::ny, "plant.C", "plant.h")}) {
      const char* const source = is_of_f ? otherwise : matrix;
      if ((rule.rows != size && rule.columns != size) || values_.has(source)) continue;
      if (parent_of(rule.path) == "plant") report_.error(rule.path, "needs " + std::string(source));
      return false;
    }
    return true;
  }

  void read_text(const KeyRule& rule, const Node& node, Complaint (*check)(const std::string&)) {
    if (node.kind != Kind::text) return expected(rule, "a string", describe(node));
    if (const Complaint complaint = check(node.text))
      report_.error(rule.path, *complaint);
    else
      values_.texts[rule.path] = node.text;
  }

  void read_word(const KeyRule& rule, const Node& node) {
    if (node.kind != Kind::text) return expected(rule, listed(rule.words), describe(node));
    if (!contains(rule.words, node.text))
      expected(rule, listed(rule.words), in_quotes(node.text));
    else
      values_.texts[rule.path] = node.text;
  }

  void read_number(const KeyRule& rule, const Node& node, const char* wanted, bool (*is_good)(double)) {
    if (node.kind != Kind::number) return expected(rule, wanted, describe(node));
    if (!is_good(node.number) || std::isinf(node.number)) return expected(rule, wanted, shown(node.number));
    values_.numbers[rule.path] = node.number;
  }

  void read_threshold(const KeyRule& rule, const Node& node) {
    const char* const wanted = "a number > 0, or inf";
    if (node.kind != Kind::number) return expected(rule, wanted, describe(node));
    if (!(node.number > 0)) return expected(rule, wanted, shown(node.number));
    values_.numbers[rule.path] = node.number;
  }

  void read_amount(const KeyRule& rule, const Node& node) {
    if (node.kind == Kind::text && contains(rule.words, node.text)) {
      values_.texts[rule.path] = node.text;
      return;
    }
    const std::string wanted = "a number ≥ 0 or " + listed(rule.words);
    if (node.kind == Kind::text) return expected(rule, wanted, in_quotes(node.text));
    read_number(rule, node, wanted.c_str(), [](double x) { return x >= 0; });
  }

  void read_flag(const KeyRule& rule, const Node& node) {
    if (node.kind != Kind::boolean)
      return expected(rule, "true or false", node.kind == Kind::text ? in_quotes(node.text) : describe(node));
    values_.numbers[rule.path] = node.number;
  }

  void read_entry(const KeyRule& rule, const Node& node) {
    if (node.kind == Kind::text)
      values_.texts[rule.path] = node.text;
    else if (const auto index = read_signal_index(rule, node, {}, report_))
      values_.numbers[rule.path] = *index;
  }

  void read_whole(const KeyRule& rule, const Node& node, int least, int most) {
    const std::string wanted = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
    if (node.kind != Kind::number) return expected(rule, wanted, describe(node));
    if (!is_whole(node) || node.number < least || node.number > most) return expected(rule, wanted, shown(node));
    values_.numbers[rule.path] = node.number;
  }

  void read_signals(const KeyRule& rule, const Node& node) {
    const std::string size = " (" + name_of(rule.rows) + ")";
    if (node.kind != Kind::array) return expected(rule, "an array of names" + size, describe(node));
    const int count = values_.sizes.at(rule.rows);
    if (count > 0 && static_cast<std::size_t>(count) != node.items.size())
      expected(rule, counted(count, "name") + size, std::to_string(node.items.size()));
    std::vector<design::Signal> signals;
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      design::Signal signal;
      const Complaint complaint = read_signal(rule, i, node.items[i], seen, signal);
      if (complaint)
        report_.error(rule.path + "[" + std::to_string(i) + "]", node.items[i].where, *complaint);
      else
        signals.push_back(signal);
    }
    for (std::size_t i = 0; i < signals.size() && signals.size() == node.items.size(); ++i)
      if (const Complaint complaint = check_limit_name(rule.path, signals[i].name, seen))
        report_.error(rule.path + "[" + std::to_string(i) + "]", node.items[i].where, *complaint);
    if (signals.size() == node.items.size()) values_.signals[rule.path] = signals;
  }

  // `seen`: names before this one, in capitals as the generated constants have them.
  static Complaint read_signal(const KeyRule& rule, std::size_t index, const Node& node,
                               std::map<std::string, std::size_t>& seen, design::Signal& signal) {
    if (node.kind != Kind::text) return "expected a name in quotes, found " + describe(node);
    if (const Complaint complaint = parse_signal(node.text, signal)) return complaint;
    if (const Complaint complaint = check_signal_name(rule.path, signal.name)) return complaint;
    const auto [first, is_new] = seen.emplace(in_capitals(signal.name), index);
    if (is_new) return {};
    return "expected a name of its own, capitals aside, found that of [" + std::to_string(first->second) + "], " +
           in_quotes(signal.name);
  }

  void expected(const KeyRule& rule, const std::string& wanted, const std::string& found) {
    report_.error(rule.path, "expected " + wanted + ", found " + found);
  }

  Values& values_;
  Report& report_;
};

void report_missing(const Values& values, Report& report) {
  for (const KeyRule& rule : key_rules()) {
    if (rule.need == Need::optional) continue;
    for (const std::string& table : values.tables_like(parent_of(rule.path))) {
      const std::string path = joined_rule(table, rule);
      if (!values.has(path)) report.error(path, "missing");
    }
  }
}

std::string decimal(std::to_chars_result (*print)(char*, char*, double, int), double number, int digits) {
  char buffer[32];
  return std::string(buffer, print(buffer, buffer + sizeof buffer, number, digits).ptr);
}

}  // namespace

const design::ExactMatrix* Values::matrix(const std::string& key) const {
  const auto found = matrices.find(key);
  return found == matrices.end() ? nullptr : &found->second;
}

std::string Values::text(const std::string& key) const {
  const auto found = texts.find(key);
  return found == texts.end() ? "" : found->second;
}

double Values::number(const std::string& key, double absent) const {
  const auto found = numbers.find(key);
  return found == numbers.end() ? absent : found->second;
}

bool Values::has_inputs() const { return has("plant.f") ? sizes.at(Size::nu) != 0 : has("plant.B"); }
bool Values::has_outputs() const { return has("plant.f") ? sizes.at(Size::ny) != 0 : has("plant.C"); }

const std::vector<std::string>& Values::tables_like(const std::string& rule) const {
  static const std::vector<std::string> none;
  const auto found = instances.find(rule);
  return found == instances.end() ? none : found->second;
}

std::vector<std::string> Values::tables_of(const std::string& key) const {
  std::vector<std::string> found;
  for (int i = 0; tables.count(key + "[" + std::to_string(i) + "]") != 0; ++i)
    found.push_back(key + "[" + std::to_string(i) + "]");
  return found;
}

std::vector<std::string> signal_names(const Values& values, Size size) {
  const auto [key, letter] = size == Size::nx   ? std::pair("plant.states", "x")
                             : size == Size::nu ? std::pair("plant.inputs", "u")
                                                : std::pair("plant.outputs", "y");
  std::vector<std::string> names;
  const auto named = values.signals.find(key);
  if (named != values.signals.end())
    for (const design::Signal& signal : named->second) names.push_back(signal.name);
  else
    for (int i = 0; i < values.sizes.at(size); ++i) names.push_back(letter + std::to_string(i));
  return names;
}

Values read_values(const Node& document, const std::set<std::string>& wrong, Report& report) {
  Values values;
  Nodes nodes;
  Collector(nodes, values, wrong, report).walk(document, "");
  values.sizes = measure(nodes);
  ValueReader reader(values, report);
  for (const KeyRule& rule : key_rules()) {
    for (const std::string& table : values.tables_like(parent_of(rule.path))) {
      KeyRule instance = rule;
      instance.path = joined_rule(table, rule);
      const auto node = nodes.find(instance.path);
      if (node != nodes.end() && wrong.count(instance.path) == 0) reader.read(instance, *node->second);
    }
  }
  report_missing(values, report);
  return values;
}

std::string counted(long count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string shown(double number) {
  return decimal([](char* first, char* last, double x, int) { return std::to_chars(first, last, x); }, number, 0);
}

std::string shown(const Node& number) {
  constexpr int enough_digits = 25;
  const design::Real exact = exact_value(number);
  return exact == number.number ? shown(number.number) : exact.str(enough_digits);
}

std::string shown(double number, int digits) {
  return decimal([](char* first, char* last, double x,
                    int n) { return std::to_chars(first, last, x, std::chars_format::general, n); },
                 number, digits);
}

}  // namespace lqg::input
