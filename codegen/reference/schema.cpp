// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "design/problem.hpp"
#include "input/matrices.hpp"
#include "input/names.hpp"
#include "input/parameters.hpp"
#include "reference/documents.hpp"
#include "reference/wording.hpp"

namespace lqg::reference {
namespace {

using input::Alternatives;
using input::KeyRule;
using input::Need;
using input::Type;
using Json = nlohmann::ordered_json;

Json array_of(const Json& items) {
  return {{"type", "array"}, {"minItems", 1}, {"maxItems", input::most_signals}, {"items", items}};
}

Json text(const char* pattern) { return {{"type", "string"}, {"pattern", pattern}}; }

Json index(int most) { return {{"type", "integer"}, {"minimum", 0}, {"maximum", most}}; }

// Strings are expressions: what is said of numbers holds for numbers alone.
Json or_expression(const Json& types, const Json& rules) {
  Json out = {{"type", types}, {"pattern", R"(^[-+*/^(),.0-9A-Za-z_ \t\r\n]+$)"}};
  out.update(rules);
  return out;
}

Json whole(int least) { return or_expression({"integer", "string"}, {{"minimum", least}}); }
Json whole(int least, int most) {
  return or_expression({"integer", "string"}, {{"minimum", least}, {"maximum", most}});
}

// JSON has no infinity: tools that turn TOML into JSON make it null.
Json number_or_infinity() { return or_expression({"number", "string", "null"}, Json::object()); }

const Json number = or_expression({"number", "string"}, Json::object());
const Json number_above_0 = or_expression({"number", "string"}, {{"exclusiveMinimum", 0}});
const Json number_from_0 = or_expression({"number", "string"}, {{"minimum", 0}});
const Json matrix = array_of(array_of(number));

Json pair_of(const Json& items) {
  Json pair = array_of(items);
  pair["minItems"] = pair["maxItems"] = 2;
  return pair;
}

Json pole() { return {{"anyOf", {number, pair_of(number)}}}; }

// A table whose keys are names of signals.
Json named(const Json& value) { return {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", value}}; }

// Rows of 0 and 1, or of names; a row of names may be empty.
Json mask() {
  Json row = array_of({{"anyOf", {{{"enum", {0, 1}}}, {{"type", "string"}}}}});
  row.erase("minItems");
  return array_of(row);
}

Json indices() {
  Json list = array_of({{"anyOf", {index(input::most_signals - 1), {{"type", "string"}}}}});
  list["uniqueItems"] = true;
  return list;
}

// A table of names, each a number or an expression, with its unit or without.
Json parameters() {
  const Json with_unit = {{"type", "object"},
                          {"required", {"value"}},
                          {"additionalProperties", false},
                          {"properties", {{"value", number}, {"unit", {{"type", "string"}}}}}};
  return {{"type", "object"},
          {"propertyNames", text("^[A-Za-z][A-Za-z0-9_]*$")},
          {"maxProperties", input::most_parameters},
          {"additionalProperties", {{"anyOf", {number, with_unit}}}}};
}

Json threshold() {
  Json any = number_or_infinity();
  any["exclusiveMinimum"] = 0;
  return any;
}

Json identifier() {
  Json any = text("^[a-z][a-z0-9_]*$");
  any["maxLength"] = input::longest_name;
  return any;
}

// What the value of a key may be.
Json value_schema(const KeyRule& rule) {
  switch (rule.type) {
    case Type::identifier: return identifier();
    case Type::line: return text(R"(^[^\\\u0000-\u001f\u007f]*$)");
    case Type::word: return {{"enum", rule.words}};
    case Type::positive: return number_above_0;
    case Type::not_negative: return number_from_0;
    case Type::real: return number;
    case Type::flag: return {{"type", "boolean"}};
    case Type::threshold: return threshold();
    case Type::amount: return {{"anyOf", {number_from_0, {{"enum", rule.words}}}}};
    case Type::whole: return whole(1);
    case Type::steps: return whole(0, design::most_steps);
    case Type::step: return whole(1, design::most_steps);
    case Type::matrix: return matrix;
    case Type::weight: return {{"anyOf", {array_of(number_from_0), matrix}}};
    case Type::mask: return mask();
    case Type::vector: return array_of(number);
    case Type::positives: return array_of(number_above_0);
    case Type::bounds: return array_of(number_or_infinity());
    case Type::counts: return array_of(whole(1));
    case Type::ranges: return named({{"anyOf", {number_above_0, pair_of(number_or_infinity())}}});
    case Type::prices: return {{"anyOf", {number_above_0, named(number_above_0)}}};
    case Type::indices: return indices();
    case Type::walks: return {{"anyOf", {indices(), {{"type", "object"}, {"additionalProperties", number_above_0}}}}};
    case Type::signal:
    case Type::entry: return {{"anyOf", {index(input::most_signals - 1), {{"type", "string"}}}}};
    case Type::poles: return array_of(pole());
    case Type::signals: return array_of(text(R"(^ *[A-Za-z][A-Za-z0-9_]* *(\[[^\[\]\\]*\] *)?$)"));
    case Type::parameters: return parameters();
    case Type::formulas: return array_of({{"anyOf", {{{"type", "string"}}, number}}});
    case Type::point: return array_of({{"anyOf", {number, {{"type", "string"}}}}});
    case Type::states: return array_of({{"type", "string"}});
    case Type::table:
    case Type::tables: break;
  }
  return Json::object();
}

Json needs(const std::string& key) { return {{"required", {key}}}; }

Json any_of(const std::vector<std::string>& keys) {
  Json out = Json::array();
  for (const std::string& key : keys) out.push_back(needs(key));
  return {{"anyOf", out}};
}

// Of several keys one, or at most one.
Json choice(const Alternatives& alternatives) {
  Json out = any_of(alternatives.keys)["anyOf"];
  if (alternatives.need == Need::optional) out.push_back({{"not", any_of(alternatives.keys)}});
  return {{"oneOf", out}};
}

// What hangs on other keys of the same table.
Json conditions(const std::string& table) {
  Json all = Json::array();
  for (const Alternatives& alternatives : input::alternatives())
    if (alternatives.table == table) all.push_back(choice(alternatives));
  if (table == "lqr") all.push_back(choice({table, {"R", "bryson"}, Need::required}));
  if (table == "limits") all.push_back(any_of({"u_min", "u_max", "u_rate", "states", "outputs", "output_rates"}));
  if (!table.empty()) return all;
  all.push_back(any_of({"lqr", "pole_placement", "kalman", "observer"}));
  all.push_back(choice({table, {"lqr", "pole_placement"}, Need::optional}));
  all.push_back(choice({table, {"kalman", "observer"}, Need::optional}));
  return all;
}

Json table_schema(const std::string& table);

std::string description(const KeyRule& rule) {
  std::string out = rule.text;
  if (!is_table(rule)) out += " " + replaced(values_of(rule), "`", "") + ".";
  const std::string absent = replaced(otherwise(rule), "`", "");
  if (absent.empty() || absent == "required") return out;
  return out + " Default: " + absent + ".";
}

Json key_schema(const KeyRule& rule) {
  Json out = {{"description", description(rule)}};
  if (!rule.words.empty() && rule.otherwise.empty()) out["default"] = rule.words.front();
  if (rule.type == Type::tables) {
    out.update({{"type", "array"}, {"minItems", 1}, {"items", table_schema(rule.path)}});
    return out;
  }
  const bool has_rules = rule.type == Type::table;
  out.update(has_rules ? table_schema(rule.path) : value_schema(rule));
  return out;
}

Json table_schema(const std::string& table) {
  Json keys = Json::object(), required = Json::array();
  for (const KeyRule& rule : input::key_rules()) {
    if (input::parent_of(rule.path) != table) continue;
    keys[name_of(rule)] = key_schema(rule);
    if (rule.need == Need::required) required.push_back(name_of(rule));
  }
  Json out = {{"type", "object"}, {"additionalProperties", false}};
  if (!required.empty()) out["required"] = required;
  if (const Json all = conditions(table); !all.empty()) out["allOf"] = all;
  out["properties"] = keys;
  return out;
}

}  // namespace

std::string schema() {
  Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "TinyLQG design file"},
              {"description", "Printed by lqgen --schema. That sizes of matrices agree is checked by lqgen alone."}};
  out.update(table_schema(""));
  return out.dump(2) + "\n";
}

}  // namespace lqg::reference
