// SPDX-License-Identifier: MIT
#include "input/formulas.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "design/rounding.hpp"
#include "input/keys.hpp"
#include "input/names.hpp"
#include "input/text.hpp"
#include "input/values.hpp"

namespace lqg::input {
namespace {

// Where numbers stand in the value of a key.
enum class Numbers { nowhere, alone, in_arrays, in_tables, alone_or_in_tables };

Numbers numbers_in(Type type) {
  switch (type) {
    case Type::positive:
    case Type::not_negative:
    case Type::real:
    case Type::threshold:
    case Type::amount:
    case Type::whole:
    case Type::steps:
    case Type::step: return Numbers::alone;
    case Type::matrix:
    case Type::weight:
    case Type::vector:
    case Type::positives:
    case Type::bounds:
    case Type::counts:
    case Type::poles: return Numbers::in_arrays;
    case Type::ranges:
    case Type::walks: return Numbers::in_tables;
    case Type::prices: return Numbers::alone_or_in_tables;
    default: return Numbers::nowhere;
  }
}

class FormulaReader {
 public:
  FormulaReader(const Parameters& parameters, const FormulaPlaces& places, ExactValues& values, Report& report)
      : parameters_(parameters), places_(places), values_(values), report_(report) {}

  Formulas read(Node& document) {
    walk_table(document, "");
    return std::move(result_);
  }

 private:
  void walk_table(Node& table, const std::string& parent) {
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      const std::string path = path_of(parent, table.keys[i].name);
      const KeyRule* rule = find_rule(rule_path(path));
      if (rule == nullptr) continue;
      Node& node = table.items[i];
      if (rule->type == Type::table)
        walk_table(node, path);
      else if (rule->type == Type::tables)
        for (std::size_t j = 0; j < node.items.size(); ++j) walk_table(node.items[j], item_of(path, j));
      else
        read_value(*rule, node, path);
    }
  }

  static std::string item_of(const std::string& path, std::size_t i) { return path + "[" + std::to_string(i) + "]"; }

  void read_value(const KeyRule& rule, Node& node, const std::string& path) {
    key_ = path;
    const Numbers numbers = numbers_in(rule.type);
    if (node.kind == Kind::text && !is_word(rule, node.text) &&
        (numbers == Numbers::alone || numbers == Numbers::alone_or_in_tables))
      take(node, path);
    if (node.kind == Kind::array && numbers == Numbers::in_arrays) read_array(node, path);
    if (node.kind != Kind::table || (numbers != Numbers::in_tables && numbers != Numbers::alone_or_in_tables)) return;
    for (std::size_t i = 0; i < node.items.size(); ++i) read_entry(node.items[i], path_of(path, node.keys[i].name));
  }

  // One of the rule's words, or what may be one misspelt.
  bool is_word(const KeyRule& rule, const std::string& text) const {
    if (std::find(rule.words.begin(), rule.words.end(), text) != rule.words.end()) return true;
    return !rule.words.empty() && !check_parameter_name(text) && parameters_.find(text) == nullptr &&
           parameters_.wrong.count(text) == 0;
  }

  void read_array(Node& array, const std::string& path) {
    for (std::size_t i = 0; i < array.items.size(); ++i) read_entry(array.items[i], item_of(path, i));
  }

  void read_entry(Node& node, const std::string& path) {
    if (node.kind == Kind::text) take(node, path);
    if (node.kind == Kind::array) read_array(node, path);
  }

  void take(Node& node, const std::string& path) {
    if (!count(node, path)) return;
    const expression::Tree tree = read_formula(path, node, parameters_, places_, report_);
    if (!tree) return refuse();
    const auto value = values_(*tree);
    if (const auto* fault = std::get_if<expression::Fault>(&value)) {
      report_.error(path, places_.of(node, fault->at), fault->message);
      return refuse();
    }
    const design::Real& exact = std::get<design::Real>(value);
    node.kind = Kind::number;
    node.number = design::to_double(exact);
    node.formula = std::make_shared<const Formula>(Formula{node.text, tree, exact});
    report_.place(path, node.where);
    result_.all.push_back({path, node});
  }

  // Where there are too many, that is said once.
  bool count(const Node& node, const std::string& path) {
    const bool was_good = bytes_ <= most_formula_bytes;
    bytes_ += node.text.size();
    const bool is_good = bytes_ <= most_formula_bytes;
    if (was_good && !is_good)
      report_.error(path, node.where,
                    "expected at most " + std::to_string(most_formula_bytes) + " bytes of expressions in a file");
    if (!is_good) refuse();
    return is_good;
  }

  void refuse() { result_.wrong.insert(key_); }

  const Parameters& parameters_;
  const FormulaPlaces& places_;
  ExactValues& values_;
  Report& report_;
  std::string key_;
  std::size_t bytes_ = 0;
  Formulas result_;
};

}  // namespace

Formulas read_formulas(Node& document, const Parameters& parameters, const FormulaPlaces& places, ExactValues& values,
                       Report& report) {
  return FormulaReader(parameters, places, values, report).read(document);
}

bool is_whole(const Node& number) {
  const design::Real exact = exact_value(number);
  return exact == floor(exact);
}

design::Real exact_value(const Node& number) {
  return number.formula ? number.formula->exact : design::Real(number.number);
}

}  // namespace lqg::input
