// SPDX-License-Identifier: MIT
#include "input/changed_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "design/rounding.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

const Node* entry_of_table(const Node* table, const std::string& name) {
  for (std::size_t i = 0; table != nullptr && table->kind == Kind::table && i < table->keys.size(); ++i)
    if (table->keys[i].name == name) return &table->items[i];
  return nullptr;
}

class ChangesReader {
 public:
  ChangesReader(const Parameters& parameters, const FormulaPlaces& places, ExactValues& exact, Values& values,
                Report& report)
      : parameters_(parameters), places_(places), exact_(exact), values_(values), report_(report) {}

  void read(const std::string& key, const Node& table) {
    if (!values_.has("plant.f"))
      return report_.error(key, "needs plant.f: parameters of matrices are those of the design");
    if (table.kind != Kind::table)
      return report_.error(key, "expected a table of parameters, found " + describe(table));
    for (std::size_t i = 0; i < table.keys.size(); ++i)
      if (is_known(key, table.keys[i])) read_value(key, table.keys[i].name, table.items[i]);
  }

 private:
  bool is_known(const std::string& key, const Key& name) {
    std::vector<std::string> known;
    for (const Parameter& parameter : parameters_.all) known.push_back(parameter.name);
    if (std::find(known.begin(), known.end(), name.name) != known.end()) return true;
    if (parameters_.wrong.count(name.name) != 0) return false;  // that has been said
    const std::string near = nearest_word(known, name.name);
    report_.error(key, name.where,
                  "expected the name of a parameter, found " + in_quotes(name.name) +
                      (near.empty() ? "" : "; did you mean `" + near + "`?"));
    return false;
  }

  void read_value(const std::string& table, const std::string& name, const Node& node) {
    const std::string key = table + "." + name;
    report_.place(key, node.where);
    if (node.kind == Kind::number && std::isfinite(node.number)) {
      values_.named[table][name] = node.number;
      return;
    }
    if (node.kind != Kind::text)
      return report_.error(key, "expected a number or a formula, found " +
                                    (node.kind == Kind::number ? shown(node.number) : describe(node)));
    const expression::Tree tree = read_formula(key, node, parameters_, places_, report_);
    if (!tree) return;
    const auto value = exact_(*tree);
    if (const auto* fault = std::get_if<expression::Fault>(&value))
      return report_.error(key, places_.of(node, fault->at), fault->message);
    values_.named[table][name] = design::to_double(std::get<design::Real>(value));
  }

  const Parameters& parameters_;
  const FormulaPlaces& places_;
  ExactValues& exact_;
  Values& values_;
  Report& report_;
};

}  // namespace

void read_changed_parameters(const Node& document, const Parameters& parameters, const FormulaPlaces& places,
                             ExactValues& exact, Values& values, Report& report) {
  const Node* scenarios = entry_of_table(&document, "scenario");
  ChangesReader reader(parameters, places, exact, values, report);
  for (std::size_t i = 0; scenarios != nullptr && i < scenarios->items.size(); ++i)
    if (const Node* table = entry_of_table(entry_of_table(&scenarios->items[i], "plant"), "parameters"))
      reader.read("scenario[" + std::to_string(i) + "].plant.parameters", *table);
}

}  // namespace lqg::input
