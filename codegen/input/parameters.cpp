// SPDX-License-Identifier: MIT
#include "input/parameters.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "design/rounding.hpp"
#include "input/keys.hpp"
#include "input/names.hpp"
#include "input/text.hpp"
#include "input/values.hpp"

namespace lqg::input {
namespace {

using expression::Measure;
using expression::Tree;

std::string key_of(const std::string& name) { return path_of("parameters", name); }

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value) ? std::optional(value)
                                                                                          : std::nullopt;
}

// A parameter before the others are known.
struct Stated {
  Parameter parameter;
  Node value;  // a number or a text
  Tree tree;   // not bound; none: wrong
  Location unit_at;
  enum class State { waits, is_being_read, read } state = State::waits;
};

// One table [parameters] while it is read.
class ParameterReader {
 public:
  ParameterReader(const FormulaPlaces& places, ExactValues& values, Report& report)
      : places_(places), values_(values), report_(report) {}

  Parameters read(const Node& table, const Settings& settings) {
    for (std::size_t i = 0; i < table.keys.size(); ++i) state(table.keys[i], table.items[i]);
    for (const Setting& setting : settings) set(setting, table.where);
    for (Stated& one : stated_) parse(one);
    for (std::size_t i = 0; i < stated_.size(); ++i) resolve(i);
    for (const Stated& one : stated_)
      if (const auto found = done_.find(one.parameter.name); found != done_.end()) result_.all.push_back(found->second);
    return result_;
  }

 private:
  void state(const Key& key, const Node& node) {
    Stated one;
    one.parameter.name = key.name;
    if (const Complaint complaint = check_parameter_name(key.name))
      return report_.error(key_of(key.name), key.where, *complaint);
    report_.place(key_of(key.name), node.where);
    const std::optional<Node> value = value_of(key.name, node, one);
    if (!value) {
      result_.wrong.insert(key.name);
      return;
    }
    one.value = *value;
    index_[key.name] = stated_.size();
    stated_.push_back(one);
  }

  // A number, a text, or { value, unit }.
  std::optional<Node> value_of(const std::string& name, const Node& node, Stated& one) {
    if (node.kind == Kind::number || node.kind == Kind::text) return node;
    const std::string expected = "expected a number, an expression in quotes, or { value = …, unit = \"…\" }, found ";
    if (node.kind != Kind::table) return refuse(name, node.where, expected + describe(node));
    std::optional<Node> value;
    for (std::size_t i = 0; i < node.keys.size(); ++i) {
      const Node& item = node.items[i];
      if (node.keys[i].name == "value" && (item.kind == Kind::number || item.kind == Kind::text))
        value = item;
      else if (node.keys[i].name == "value")
        return refuse(name, item.where, "expected a number or an expression in quotes, found " + describe(item));
      else if (node.keys[i].name != "unit")
        return refuse(name, node.keys[i].where, "expected value and unit, found " + in_quotes(node.keys[i].name));
      else if (!read_unit(name, item, one))
        return std::nullopt;
    }
    if (!value) return refuse(name, node.where, "expected value = …, found none");
    return value;
  }

  bool read_unit(const std::string& name, const Node& node, Stated& one) {
    const Complaint complaint = node.kind == Kind::text
                                    ? check_comment_text(node.text)
                                    : Complaint("expected a unit in quotes, found " + describe(node));
    if (complaint) report_.error(key_of(name) + ".unit", node.where, *complaint);
    one.parameter.unit = node.text;
    one.unit_at = node.where;
    return !complaint;
  }

  std::nullopt_t refuse(const std::string& name, Location where, const std::string& message) {
    report_.error(key_of(name), where, message);
    return std::nullopt;
  }

  void set(const Setting& setting, Location table) {
    const auto found = index_.find(setting.name);
    if (found == index_.end()) {
      if (result_.wrong.count(setting.name) != 0) return;
      std::vector<std::string> names;
      for (const Stated& one : stated_) names.push_back(one.parameter.name);
      const std::string near = nearest_word(names, setting.name);
      return report_.error("parameters", table,
                           "--set: expected the name of a parameter, found " + in_quotes(setting.name) +
                               (near.empty() ? "" : "; did you mean `" + near + "`?"));
    }
    Stated& one = stated_[found->second];
    one.parameter.is_set = true;
    const std::optional<double> number = number_in(setting.value);
    const Location where = one.value.where;
    one.value = {};
    one.value.kind = number ? Kind::number : Kind::text;
    one.value.where = where;
    one.value.number = number.value_or(0);
    one.value.text = setting.value;
  }

  void parse(Stated& one) {
    if (one.value.kind == Kind::number) {
      if (std::isfinite(one.value.number))
        one.tree = expression::number(one.value.number);
      else
        refuse(one.parameter.name, one.value.where, "expected a finite number, found " + shown(one.value.number));
      return;
    }
    const auto parsed = expression::parse(one.value.text);
    if (const expression::Fault* fault = std::get_if<expression::Fault>(&parsed))
      report_at(one, {fault->at, not_a_formula(one.value.text, *fault)});
    else
      one.tree = std::get<Tree>(parsed), one.parameter.formula = one.value.text;
  }

  void report_at(const Stated& one, const expression::Fault& fault) {
    const bool is_set = one.parameter.is_set;
    report_.error(key_of(one.parameter.name), is_set ? one.value.where : places_.of(one.value, fault.at),
                  (is_set ? "--set: " : "") + fault.message);
  }

  // After all that it needs.
  void resolve(std::size_t index) {
    Stated& one = stated_[index];
    if (one.state == Stated::State::read) return;
    one.state = Stated::State::is_being_read;
    chain_.push_back(index);
    const bool is_ready = one.tree && needs_are_met(one);
    chain_.pop_back();
    one.state = Stated::State::read;
    if (!is_ready || !evaluate(one)) result_.wrong.insert(one.parameter.name);
  }

  bool needs_are_met(const Stated& one) {
    bool good = true;
    for (const std::string& name : expression::names_in(one.tree)) {
      const auto found = index_.find(name);
      if (found == index_.end()) continue;  // binding tells where it stands
      if (stated_[found->second].state == Stated::State::is_being_read)
        report_circle(found->second);
      else
        resolve(found->second);
      good = good && done_.count(name) != 0;
    }
    return good;
  }

  void report_circle(std::size_t first) {
    constexpr std::ptrdiff_t most_shown = 8;
    const auto begin = std::find(chain_.begin(), chain_.end(), first);
    std::string circle;
    for (auto at = begin; at != chain_.end() && at - begin < most_shown; ++at)
      circle += stated_[*at].parameter.name + " → ";
    if (chain_.end() - begin > most_shown) circle += "… → ";
    const Stated& one = stated_[first];
    report_at(one,
              {0, "expected a value that does not hang on itself, found the circle " + circle + one.parameter.name});
  }

  bool evaluate(Stated& one) {
    Parameter& parameter = one.parameter;
    const std::optional<Tree> bound = bind(one);
    if (!bound) return false;
    parameter.value = *bound;
    const auto value = values_(*parameter.value);
    if (const expression::Fault* fault = std::get_if<expression::Fault>(&value)) return report_at(one, *fault), false;
    parameter.number = design::to_double(std::get<design::Real>(value));
    if (!find_unit(one)) return false;
    done_[parameter.name] = parameter;
    return true;
  }

  std::optional<Tree> bind(const Stated& one) {
    std::string unknown;
    const auto bound = expression::bind(one.tree, [&](const std::string& name, std::size_t at) -> Tree {
      const auto found = done_.find(name);
      if (found != done_.end()) return expression::parameter(name, found->second.value, at);
      unknown = name;
      return nullptr;
    });
    if (const Tree* tree = std::get_if<Tree>(&bound)) return *tree;
    expression::Fault fault = std::get<expression::Fault>(bound);
    if (result_.wrong.count(unknown) != 0) return std::nullopt;
    if (!unknown.empty()) fault.message = unknown_name(unknown, known());
    report_at(one, fault);
    return std::nullopt;
  }

  // For their names.
  Parameters known() const {
    Parameters all;
    for (const Stated& one : stated_) all.all.push_back(one.parameter);
    return all;
  }

  // The one that is given; it has to be that of the formula.
  bool find_unit(Stated& one) {
    Parameter& parameter = one.parameter;
    const auto known = [this](const expression::Node& node) {
      const auto found = done_.find(node.name);
      return found == done_.end() ? Measure() : found->second.measure;
    };
    const auto measured = expression::measure_of(*parameter.value, known);
    if (const expression::Fault* fault = std::get_if<expression::Fault>(&measured))
      return report_at(one, *fault), false;
    const Measure& of_formula = std::get<Measure>(measured);
    const bool is_given = one.unit_at.line > 0;
    if (!is_given) {
      if (of_formula.kind == Measure::Kind::known) parameter.measure = of_formula;
      return true;
    }
    const std::optional<expression::Unit> unit = expression::parse_unit(parameter.unit);
    if (!unit) {
      note_unit(one);
      return true;
    }
    parameter.measure = {Measure::Kind::known, *unit};
    if (of_formula.kind != Measure::Kind::known || is_same(*unit, of_formula.unit)) return true;
    report_at(one, {0, "expected an expression in " + expression::in_words(*unit) + ", its unit, found one in " +
                           expression::in_words(of_formula.unit)});
    return false;
  }

  void note_unit(const Stated& one) {
    if (!noted_units_.insert(one.parameter.unit).second) return;
    const std::string key = key_of(one.parameter.name) + ".unit";
    report_.place(key, one.unit_at);
    report_.note(key, "the unit " + in_quotes(one.parameter.unit) +
                          " is not known, as \"V*s/rad\" would be: it is shown and not checked");
  }

  const FormulaPlaces& places_;
  ExactValues& values_;
  Report& report_;
  std::vector<Stated> stated_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::size_t> chain_;
  std::map<std::string, Parameter> done_;
  std::set<std::string> noted_units_;
  Parameters result_;
};

const Node* parameters_table(const Node& document) {
  for (std::size_t i = 0; i < document.keys.size(); ++i)
    if (document.keys[i].name == "parameters") return &document.items[i];
  return nullptr;
}

// "; did you mean `Kt`?", or nothing.
std::string near_name(const std::string& name, const Parameters& parameters, const std::vector<std::string>& others) {
  std::vector<std::string> names = others;
  for (const Parameter& parameter : parameters.all) names.push_back(parameter.name);
  const std::vector<std::string>& functions = expression::function_names();
  names.insert(names.end(), functions.begin(), functions.end());
  names.emplace_back("pi");
  const std::string near = nearest_word(names, name);
  return near.empty() ? "" : "; did you mean `" + near + "`?";
}

}  // namespace

const Parameter* Parameters::find(const std::string& name) const {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Parameter& parameter) { return parameter.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Parameters read_parameters(const Node& document, const Settings& settings, const FormulaPlaces& places,
                           ExactValues& values, Report& report) {
  const Node* table = parameters_table(document);
  Node none;
  none.where = {1, 1};
  if (table == nullptr) table = &none;
  if (table->kind != Kind::table) {
    report.error("parameters", table->where, "expected a table of numbers and expressions, found " + describe(*table));
    return {};
  }
  if (table->keys.size() > most_parameters) {
    report.error("parameters", table->where,
                 "expected at most " + std::to_string(most_parameters) + " parameters, found " +
                     std::to_string(table->keys.size()));
    return {};
  }
  return ParameterReader(places, values, report).read(*table, settings);
}

expression::Meaning meaning(const Parameters& parameters) {
  return [&parameters](const std::string& name, std::size_t at) -> Tree {
    const Parameter* parameter = parameters.find(name);
    return parameter == nullptr ? nullptr : expression::parameter(name, parameter->value, at);
  };
}

expression::MeasureOf measure_of_parameters(const Parameters& parameters) {
  return [&parameters](const expression::Node& node) {
    const Parameter* parameter = parameters.find(node.name);
    return parameter == nullptr ? Measure() : parameter->measure;
  };
}

std::string unknown_name(const std::string& name, const Parameters& parameters,
                         const std::vector<std::string>& others) {
  const std::string also = others.empty() ? "" : " a state, an input,";
  return "expected the name of" + also + " a parameter, a function or pi, found " + in_quotes(name) +
         near_name(name, parameters, others);
}

std::string not_a_formula(const std::string& text, const expression::Fault& fault) {
  return "expected a number or an expression, found " + in_quotes(text) + ": " + fault.message;
}

Tree read_formula(const std::string& key, const Node& text, const Parameters& parameters, const FormulaPlaces& places,
                  Report& report) {
  const auto parsed = expression::parse(text.text);
  if (const expression::Fault* fault = std::get_if<expression::Fault>(&parsed)) {
    report.error(key, places.of(text, fault->at), not_a_formula(text.text, *fault));
    return nullptr;
  }
  std::string unknown;
  const expression::Meaning known = meaning(parameters);
  const auto bound = expression::bind(std::get<Tree>(parsed), [&](const std::string& name, std::size_t at) {
    Tree tree = known(name, at);
    if (!tree) unknown = name;
    return tree;
  });
  if (const Tree* tree = std::get_if<Tree>(&bound)) return *tree;
  const expression::Fault& fault = std::get<expression::Fault>(bound);
  if (parameters.wrong.count(unknown) != 0) return nullptr;
  const std::string message = unknown.empty()        ? fault.message
                              : unknown == text.text ? not_a_formula(unknown, {0, "no parameter has this name"}) +
                                                           near_name(unknown, parameters, {})
                                                     : unknown_name(unknown, parameters);
  report.error(key, places.of(text, fault.at), message);
  return nullptr;
}

}  // namespace lqg::input
