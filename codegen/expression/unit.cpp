// SPDX-License-Identifier: MIT
#include "expression/unit.hpp"

#include <boost/spirit/home/x3.hpp>
#include <charconv>
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

namespace lqg::expression {
namespace {

using Powers = std::array<double, 6>;

struct Symbol {
  std::string_view text;
  Powers powers;  // m, s, kg, A, K, mol
  double size;    // in the SI's base units
  bool has_prefixes;
};

constexpr double pi_over_180 = 0.017453292519943295;

// clang-format off
constexpr Symbol known_symbols[] = {
    {"m",    {1},                    1,                true},
    {"s",    {0, 1},                 1,                true},
    {"g",    {0, 0, 1},              1e-3,             true},
    {"A",    {0, 0, 0, 1},           1,                true},
    {"K",    {0, 0, 0, 0, 1},        1,                true},
    {"mol",  {0, 0, 0, 0, 0, 1},     1,                true},
    {"rad",  {},                     1,                true},
    {"N",    {1, -2, 1},             1,                true},
    {"Nm",   {2, -2, 1},             1,                true},
    {"V",    {2, -3, 1, -1},         1,                true},
    {"W",    {2, -3, 1},             1,                true},
    {"ohm",  {2, -3, 1, -2},         1,                true},
    {"Ohm",  {2, -3, 1, -2},         1,                true},
    {"Ω",    {2, -3, 1, -2},         1,                true},
    {"\u2126", {2, -3, 1, -2},       1,                true},   // the sign for ohm
    {"S",    {-2, 3, -1, 2},         1,                true},
    {"H",    {2, -2, 1, -2},         1,                true},
    {"F",    {-2, 4, -1, 2},         1,                true},
    {"Hz",   {0, -1},                1,                true},
    {"J",    {2, -2, 1},             1,                true},
    {"C",    {0, 1, 0, 1},           1,                true},
    {"T",    {0, -2, 1, -1},         1,                true},
    {"Wb",   {2, -2, 1, -1},         1,                true},
    {"Pa",   {-1, -2, 1},            1,                true},
    {"bar",  {-1, -2, 1},            1e5,              true},
    {"L",    {3},                    1e-3,             true},
    {"l",    {3},                    1e-3,             true},
    {"deg",  {},                     pi_over_180,      false},
    {"°",    {},                     pi_over_180,      false},
    {"min",  {0, 1},                 60,               false},
    {"h",    {0, 1},                 3600,             false},
    {"rpm",  {0, -1},                6 * pi_over_180,  false},
    {"%",    {},                     0.01,             false},
    {"°C",   {0, 0, 0, 0, 1},        1,                false},
    {"degC", {0, 0, 0, 0, 1},        1,                false}};

struct Prefix {
  std::string_view text;
  double decades;
};
constexpr Prefix prefixes[] = {{"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"µ", -6}, {"\u03bc", -6}, {"m", -3},
                               {"c", -2},  {"d", -1},  {"h", 2},  {"k", 3},  {"M", 6},  {"G", 9},       {"T", 12}};
// clang-format on

constexpr std::size_t longest_unit = 100;  // bytes
constexpr double largest_exponent = 100;

Unit unit_of(const Symbol& symbol, double decades, const std::string& text) {
  Unit unit;
  unit.powers = symbol.powers;
  unit.decades = std::log10(symbol.size) + decades;
  unit.symbols[text] = 1;
  return unit;
}

// The symbol itself before one with a prefix: "min" is a minute.
std::optional<Unit> unit_of_symbol(const std::string& text) {
  for (const Symbol& symbol : known_symbols)
    if (symbol.text == text) return unit_of(symbol, 0, text);
  for (const Prefix& prefix : prefixes) {
    if (text.compare(0, prefix.text.size(), prefix.text) != 0) continue;
    for (const Symbol& symbol : known_symbols)
      if (symbol.has_prefixes && text.compare(prefix.text.size(), std::string::npos, symbol.text) == 0)
        return unit_of(symbol, prefix.decades, text);
  }
  return std::nullopt;
}

// What has been read, as a stack of units.
struct Reading {
  std::vector<Unit> stack;
  bool is_understood = true;

  Unit pop() {
    const Unit top = stack.back();
    stack.pop_back();
    return top;
  }
};

// Its names are short, as in the grammar's description.
namespace unit_grammar {

namespace x3 = boost::spirit::x3;

// Actions on the stack of units.
struct ReadingTag;
template <class Act>
auto unit_action(Act act) {
  return [act](auto& context) { act(x3::get<ReadingTag>(context).get(), x3::_attr(context)); };
}

void raise_top(Reading& reading, double exponent) {
  reading.is_understood = reading.is_understood && std::abs(exponent) <= largest_exponent;
  reading.stack.push_back(power(reading.pop(), exponent));
}

void push_symbol(Reading& reading, const std::string& text) {
  const std::optional<Unit> unit = unit_of_symbol(text);
  reading.is_understood = reading.is_understood && unit;
  reading.stack.push_back(unit.value_or(Unit()));
}

const x3::rule<struct UnitTag> unit_rule = "unit";
const x3::rule<struct FactorTag> factor_rule = "factor";

const auto blanks = x3::omit[*x3::char_(' ')];
const auto letter = x3::char_("a-zA-Z%") | x3::lit("µ") | "\u03bc" | "Ω" | "\u2126" | "°";
const auto symbol_text = x3::raw[+letter][unit_action(
    [](Reading& reading, const auto& text) { push_symbol(reading, std::string(text.begin(), text.end())); })];
const auto pure =
    (x3::char_('1') >>
     !x3::char_("0-9."))[unit_action([](Reading& reading, const auto&) { reading.stack.emplace_back(); })];
const auto group = x3::lit('(') >> blanks >> unit_rule >> blanks >> ')';

const auto raise = unit_action([](Reading& reading, double exponent) { raise_top(reading, exponent); });
const auto raised = x3::lit('^') >> (x3::double_[raise] | (x3::lit('(') >> x3::double_[raise] >> ')'));
const auto digit_behind =
    x3::char_('2', '9')[unit_action([](Reading& reading, char digit) { raise_top(reading, digit - '0'); })];

x3::symbols<double> superscripts() {
  x3::symbols<double> table;
  const std::string digits[] = {"¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  double exponent = 0;
  for (const std::string& digit : digits) {
    ++exponent;
    table.add(digit, exponent)("⁻" + digit, -exponent);
  }
  return table;
}
const auto superscript = superscripts()[raise];

const auto power_of_atom = (symbol_text | pure | group) >> -(raised | digit_behind | superscript);
const auto halve = unit_action([](Reading& reading, const auto&) { raise_top(reading, 0.5); });
const auto factor_rule_def = (x3::lit("√") >> power_of_atom >> x3::eps[halve]) | power_of_atom;

const auto multiply = unit_action([](Reading& reading, const auto&) {
  const Unit second = reading.pop();
  reading.stack.push_back(reading.pop() * second);
});
const auto divide = unit_action([](Reading& reading, const auto&) {
  const Unit second = reading.pop();
  reading.stack.push_back(reading.pop() / second);
});
const auto over = blanks >> '/' >> blanks >> factor_rule >> x3::eps[divide];
const auto times = blanks >> (x3::lit('*') | "·" | "⋅") >> blanks >> factor_rule >> x3::eps[multiply];
const auto beside = x3::omit[+x3::char_(' ')] >> factor_rule >> x3::eps[multiply];
const auto unit_rule_def = factor_rule >> *(over | times | beside);

BOOST_SPIRIT_DEFINE(unit_rule, factor_rule)

bool read_unit(const std::string& text, Reading& reading) {
  auto at = text.begin();
  return x3::parse(at, text.end(), x3::with<ReadingTag>(std::ref(reading))[blanks >> unit_rule >> blanks]) &&
         at == text.end() && reading.is_understood;
}

}  // namespace unit_grammar

constexpr double tiny = 1e-9;

bool is_zero_power(double power) { return std::abs(power) < tiny; }

std::string with_exponent(const std::string& symbol, double exponent) {
  static const char* const marks[] = {"²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (is_zero_power(exponent - 1)) return symbol;
  if (is_zero_power(exponent - 0.5)) return "√" + symbol;
  for (int i = 2; i <= 9; ++i)
    if (is_zero_power(exponent - i)) return symbol + marks[i - 2];
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, exponent).ptr;
  return symbol + "^" + std::string(text, end);
}

std::string joined_symbols(const std::map<std::string, double>& symbols) {
  std::string above, below;
  int below_count = 0;
  for (const auto& [symbol, exponent] : symbols) {
    std::string& side = exponent > 0 ? above : below;
    side += (side.empty() ? "" : "·") + with_exponent(symbol, std::abs(exponent));
    below_count += exponent < 0;
  }
  if (above.empty()) above = "1";
  if (below_count == 0) return above;
  return above + "/" + (below_count > 1 ? "(" + below + ")" : below);
}

// In the SI's units: one with a name of its own, or the base units.
std::string in_si(const Unit& unit) {
  for (const Symbol& symbol : known_symbols)
    if (symbol.size == 1 && symbol.powers == unit.powers && symbol.text != "Hz") return std::string(symbol.text);
  static const char* const base[] = {"m", "s", "kg", "A", "K", "mol"};
  std::map<std::string, double> symbols;
  for (std::size_t i = 0; i < unit.powers.size(); ++i)
    if (!is_zero_power(unit.powers[i])) symbols[base[i]] = unit.powers[i];
  return joined_symbols(symbols);
}

}  // namespace

std::optional<Unit> parse_unit(const std::string& text) {
  if (text.find_first_not_of(' ') == text.npos || text == "-") return Unit();
  if (text.size() > longest_unit) return std::nullopt;
  Reading reading;
  if (!unit_grammar::read_unit(text, reading)) return std::nullopt;
  return reading.stack.back();
}

Unit operator*(const Unit& a, const Unit& b) {
  Unit product = a;
  product.decades += b.decades;
  for (std::size_t i = 0; i < product.powers.size(); ++i) product.powers[i] += b.powers[i];
  for (const auto& [symbol, exponent] : b.symbols) {
    const auto found = product.symbols.emplace(symbol, 0).first;
    found->second += exponent;
    if (is_zero_power(found->second)) product.symbols.erase(found);
  }
  return product;
}

Unit operator/(const Unit& a, const Unit& b) { return a * power(b, -1); }

Unit power(const Unit& unit, double exponent) {
  if (is_zero_power(exponent)) return {};
  Unit result = unit;
  result.decades *= exponent;
  for (double& power : result.powers) power *= exponent;
  for (auto& symbol : result.symbols) symbol.second *= exponent;
  return result;
}

bool is_like(const Unit& a, const Unit& b) {
  for (std::size_t i = 0; i < a.powers.size(); ++i)
    if (!is_zero_power(a.powers[i] - b.powers[i])) return false;
  return true;
}

bool is_same(const Unit& a, const Unit& b) { return is_like(a, b) && is_zero_power(a.decades - b.decades); }

bool is_pure(const Unit& unit) { return is_same(unit, {}); }

std::string in_words(const Unit& unit) {
  if (unit.symbols.empty() && is_pure(unit)) return "a pure number";
  const std::string written = joined_symbols(unit.symbols);
  if (unit.symbols.size() <= 3 || !is_zero_power(unit.decades)) return written;
  if (is_pure(unit)) return "a pure number";
  const std::string si = in_si(unit);
  return si.size() < written.size() ? si : written;
}

}  // namespace lqg::expression
