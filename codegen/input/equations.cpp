// SPDX-License-Identifier: MIT
#include "input/equations.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "design/rounding.hpp"
#include "expression/parse.hpp"
#include "input/equation_units.hpp"
#include "input/matrices.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

using expression::Tree;
using Trees = std::vector<design::WantedPoint::Formula>;
using Names = std::vector<std::string>;

const char* const point_key = "plant.operating_point";

const Node* value_in(const Node* table, const std::string& name) {
  for (std::size_t i = 0; table != nullptr && table->kind == Kind::table && i < table->keys.size(); ++i)
    if (table->keys[i].name == name) return &table->items[i];
  return nullptr;
}

std::string entry_key(const std::string& key, std::size_t i) { return key + "[" + std::to_string(i) + "]"; }

std::string value_in_words(const Node& node) { return node.kind == Kind::number ? shown(node.number) : describe(node); }

// Equations and operating point of one file.
class EquationsReader {
 public:
  EquationsReader(const Node& document, const Parameters& parameters, const FormulaPlaces& places, ExactValues& exact,
                  Values& values, Report& report)
      : plant_(value_in(&document, "plant")), parameters_(parameters), places_(places), exact_(exact), values_(values),
        report_(report), states_(signal_names(values, Size::nx)), inputs_(signal_names(values, Size::nu)) {}

  void read() {
    if (!values_.has("plant.f")) return refuse_without_f();
    for (const char* key : {"plant.A", "plant.B", "plant.C", "plant.D", "plant.operating_point.outputs"})
      if (values_.has(key)) report_.error(key, "comes from plant.f and plant.h: expected one of the two");
    if (!check_lists() || !are_names_known() || !check_names()) return;
    auto equations = std::make_shared<design::Equations>();
    const bool is_good = read_formulas("plant.f", equations->f, equations->f_text);
    if (!read_formulas("plant.h", equations->h, equations->h_text) || !is_good) return;
    values_.equations = equations;
    const EquationUnits units(value_in(plant_, "f"), value_in(plant_, "h"), parameters_, places_, values_, report_);
    if (units.check()) linearise();
  }

 private:
  void refuse_without_f() {
    if (values_.has("plant.h")) report_.error("plant.h", "needs plant.f");
    for (const char* key : {"plant.operating_point.steady", "plant.steady"})
      if (values_.has(key)) report_.error(key, "needs plant.f");
    read_point_of_matrices("states", states_, Size::nx);
    read_point_of_matrices("inputs", inputs_, Size::nu);
  }

  void read_point_of_matrices(const std::string& part, const Names& names, Size size) {
    const std::string key = std::string(point_key) + "." + part;
    design::WantedPoint point;
    if (!values_.has(key) || values_.sizes.at(size) <= 0 || !read_values_of(part, names, name_of(size), point)) return;
    design::RealMatrix column(static_cast<Eigen::Index>(names.size()), 1);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!point.values[i])
        return report_.error(entry_key(key, i), "expected a number or a formula: \"?\" needs plant.f");
      const auto value = exact_(*point.values[i]);
      if (const auto* number = std::get_if<design::Real>(&value)) column(static_cast<Eigen::Index>(i), 0) = *number;
    }
    values_.matrices[key] = design::ExactMatrix::of(column);
  }

  // Arrays, and no longer than a plant may be.
  bool check_lists() {
    for (const std::string part : {"f", "h", "inputs"}) {
      const Node* list = value_in(plant_, part);
      if (list == nullptr) continue;
      const bool is_list = list->kind == Kind::array && !list->items.empty();
      if (!is_list && part != "inputs")
        return refuse_list(part, "an array of formulas in quotes, found " + describe(*list));
      if (list->items.size() > most_signals)
        return refuse_list(part,
                           "at most " + std::to_string(most_signals) + ", found " + std::to_string(list->items.size()));
    }
    return true;
  }

  bool refuse_list(const std::string& part, const std::string& expected) {
    report_.error("plant." + part, "expected " + expected);
    return false;
  }

  // Wrong ones have been reported.
  bool are_names_known() const {
    for (const char* key : {"plant.states", "plant.inputs"})
      if (values_.has(key) && values_.signals.count(key) == 0) return false;
    const int nx = values_.sizes.at(Size::nx), nu = values_.sizes.at(Size::nu);
    return static_cast<int>(states_.size()) == nx && static_cast<int>(inputs_.size()) == nu;
  }

  bool check_names() {
    bool good = true;
    for (const auto& [key, names] : {std::pair("plant.states", &states_), std::pair("plant.inputs", &inputs_)})
      for (std::size_t i = 0; i < names->size(); ++i) {
        const std::string& name = (*names)[i];
        std::string other;
        if (expression::function_of(name) || name == "pi") other = "a function or pi";
        if (names == &inputs_ && std::find(states_.begin(), states_.end(), name) != states_.end()) other = "a state";
        if (parameters_.find(name) != nullptr || parameters_.wrong.count(name) != 0) other = "a parameter";
        if (other.empty()) continue;
        good = false;
        const Node* list = value_in(plant_, names == &states_ ? "states" : "inputs");
        report_.error(entry_key(key, i), list == nullptr ? plant_->where : list->items[i].where,
                      "expected a name of its own in plant.f, found that of " + other + ", " + in_quotes(name));
      }
    return good;
  }

  // One a state, or one an output.
  bool read_formulas(const std::string& key, Trees& formulas, Names& texts) {
    const Node* list = value_in(plant_, key.substr(key.find('.') + 1));
    if (list == nullptr) return true;
    bool good = true;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const Node& node = list->items[i];
      report_.place(entry_key(key, i), node.where);
      if (node.kind != Kind::text && node.kind != Kind::number) {
        report_.error(entry_key(key, i), "expected a formula in quotes, found " + describe(node));
        good = false;
        continue;
      }
      formulas.push_back(node.kind == Kind::number ? expression::number(node.number)
                                                   : formula(entry_key(key, i), node, 0, true));
      texts.push_back(node.kind == Kind::number ? shown(node.number) : on_one_line(node.text));
      good = good && formulas.back();
    }
    return good;
  }

  // The end of the text from byte `begin` on; nullptr, and what is wrong reported, where that is no formula. The names
  // of signals are known where they are `allowed`.
  Tree formula(const std::string& key, const Node& node, std::size_t begin, bool allowed) {
    const auto refuse = [&](const expression::Fault& fault) {
      report_.error(key, places_.of(node, begin + fault.at), fault.message);
      return Tree();
    };
    const auto parsed = expression::parse(node.text.substr(begin));
    if (const auto* fault = std::get_if<expression::Fault>(&parsed))
      return refuse({fault->at, not_a_formula(node.text, *fault)});
    std::string unknown;
    const auto bound = expression::bind(std::get<Tree>(parsed), [&](const std::string& name, std::size_t at) {
      Tree tree = allowed ? signal(name, at) : nullptr;
      if (!tree) tree = meaning(parameters_)(name, at);
      if (!tree) unknown = name;
      return tree;
    });
    if (const auto* fault = std::get_if<expression::Fault>(&bound)) {
      if (parameters_.wrong.count(unknown) != 0) return nullptr;  // that has been said
      return refuse({fault->at, unknown.empty() ? fault->message
                                                : unknown_name(unknown, parameters_, allowed ? signals() : Names())});
    }
    const Tree tree = std::get<Tree>(bound);
    if (const auto fault = fault_of_constants(*tree)) return refuse(*fault);
    return tree;
  }

  Tree signal(const std::string& name, std::size_t at) const {
    const Names all = signals();
    const auto found = std::find(all.begin(), all.end(), name);
    return found == all.end() ? nullptr : expression::variable(name, static_cast<int>(found - all.begin()), at);
  }

  Names signals() const {
    Names all = states_;
    all.insert(all.end(), inputs_.begin(), inputs_.end());
    return all;
  }

  // Of the largest parts without a signal: one that has no value.
  std::optional<expression::Fault> fault_of_constants(const expression::Node& node) {
    if (node.is_constant) {
      const auto value = exact_(node);
      const auto* fault = std::get_if<expression::Fault>(&value);
      return fault == nullptr ? std::nullopt : std::optional(*fault);
    }
    for (const Tree& operand : node.operands)
      if (const auto fault = fault_of_constants(*operand)) return fault;
    return std::nullopt;
  }

  void linearise() {
    const bool runs_on_equations = values_.text("kalman.gain") == "extended" && !values_.has("lqr");
    if (!values_.has(point_key)) {
      if (!runs_on_equations)
        report_.error(point_key, "missing: where plant.f is linearised, as in { states = [0, 0], inputs = [\"?\"] }");
      return;
    }
    if (values_.tables.count(point_key) == 0) return;  // that has been said
    const std::optional<design::WantedPoint> point = wanted_point();
    if (!point) return;
    design::Plant plant;
    plant.domain = values_.text("plant.domain") == "discrete" ? design::Domain::discrete : design::Domain::continuous;
    for (const std::string& name : states_) plant.states.push_back({name, ""});
    for (const std::string& name : inputs_) plant.inputs.push_back({name, ""});
    plant.equations = values_.equations;
    design::Findings findings;
    values_.linearisation = design::linearise(plant, *point, findings);
    if (values_.linearisation) keep_point(*values_.linearisation);
    for (const design::Finding& finding : findings)
      if (finding.severity == design::Severity::error)
        report_.error(finding.key, finding.message);
      else
        report_.note(finding.key, finding.message);
  }

  // As if it stood in the file.
  void keep_point(const design::Linearisation& found) {
    values_.matrices["plant.operating_point.states"] = design::ExactMatrix(design::to_doubles(found.x));
    values_.matrices["plant.operating_point.inputs"] = design::ExactMatrix(design::to_doubles(found.u));
    values_.matrices["plant.operating_point.outputs"] = design::ExactMatrix(design::to_doubles(found.y));
  }

  std::optional<design::WantedPoint> wanted_point() {
    design::WantedPoint point;
    const bool has_states = read_values_of("states", states_, name_of(Size::nx), point);
    const bool has_inputs = read_values_of("inputs", inputs_, name_of(Size::nu), point);
    if (!read_steady(point) || !has_states || !has_inputs) return std::nullopt;
    return point;
  }

  // What is left out is 0.
  bool read_values_of(const std::string& part, const Names& names, const std::string& size,
                      design::WantedPoint& point) {
    const std::string key = std::string(point_key) + "." + part;
    const Node* list = value_in(value_in(plant_, "operating_point"), part);
    const std::string expected =
        "expected " + counted(static_cast<long>(names.size()), "number") + " (" + size + "), found ";
    if (list != nullptr && (list->kind != Kind::array || list->items.size() != names.size())) {
      report_.error(key, expected + (list->kind == Kind::array ? std::to_string(list->items.size()) : describe(*list)));
      return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < names.size(); ++i) {
      point.values.push_back(list == nullptr ? expression::number(0) : nullptr);
      point.starts.push_back(nullptr);
      if (list != nullptr)
        good = read_value(entry_key(key, i), list->items[i], point.values.back(), point.starts.back()) && good;
    }
    return good;
  }

  // A number, a formula, "?" or "? start".
  bool read_value(const std::string& key, const Node& node, Tree& value, Tree& start) {
    report_.place(key, node.where);
    if (node.kind == Kind::number && std::isfinite(node.number)) {
      value = expression::number(node.number);
      return true;
    }
    if (node.kind != Kind::text) {
      report_.error(key, "expected a number, a formula or \"?\", found " + value_in_words(node));
      return false;
    }
    const std::size_t mark = node.text.find_first_not_of(' ');
    const bool is_open = mark != node.text.npos && node.text[mark] == '?';
    const std::size_t begin = is_open ? mark + 1 : 0;
    if (is_open && node.text.find_first_not_of(' ', begin) == node.text.npos) return true;
    Tree& read = is_open ? start : value;
    read = formula(key, node, begin, false);
    return read != nullptr;
  }

  bool read_steady(design::WantedPoint& point) {
    const Node* of_point = value_in(value_in(plant_, "operating_point"), "steady");
    const Node* list = of_point != nullptr ? of_point : value_in(plant_, "steady");
    const std::string key = of_point != nullptr ? std::string(point_key) + ".steady" : "plant.steady";
    if (of_point != nullptr && values_.has("plant.steady")) {
      report_.error("plant.steady", "says the same as operating_point.steady: expected one of the two");
      return false;
    }
    point.is_steady.assign(states_.size(), list == nullptr);
    if (list == nullptr) return true;
    if (list->kind != Kind::array) {
      report_.error(key, "expected an array of names of states, found " + describe(*list));
      return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const Node& node = list->items[i];
      const auto found = std::find(states_.begin(), states_.end(), node.text);
      const bool is_state = node.kind == Kind::text && found != states_.end();
      if (is_state) point.is_steady[static_cast<std::size_t>(found - states_.begin())] = true;
      if (is_state) continue;
      good = false;
      const std::string near = node.kind == Kind::text ? nearest_word(states_, node.text) : "";
      report_.error(entry_key(key, i), node.where,
                    "expected the name of a state, found " +
                        (node.kind == Kind::text ? in_quotes(node.text) : describe(node)) +
                        (near.empty() ? "" : "; did you mean `" + near + "`?"));
    }
    return good;
  }

  const Node* plant_;
  const Parameters& parameters_;
  const FormulaPlaces& places_;
  ExactValues& exact_;
  Values& values_;
  Report& report_;
  Names states_, inputs_;
};

}  // namespace

void read_equations(const Node& document, const Parameters& parameters, const FormulaPlaces& places, ExactValues& exact,
                    Values& values, Report& report) {
  EquationsReader(document, parameters, places, exact, values, report).read();
}

}  // namespace lqg::input
