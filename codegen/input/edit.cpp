// SPDX-License-Identifier: MIT
#include "input/edit.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "input/document.hpp"
#include "input/places.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

constexpr double fixed_from = 1e-4, fixed_to = 1e7;  // without an exponent, where the old number had none

bool has_bare_name(const Key& key) {
  return !key.name.empty() && std::all_of(key.name.begin(), key.name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

void collect(const Node& node, const std::string& key, const Places& places, std::vector<PlacedNumber>& numbers) {
  if (node.kind == Kind::number) {
    const std::size_t begin = places.byte(node.where);
    numbers.push_back({key, node.number, begin, places.length(begin)});
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (node.kind == Kind::array) collect(node.items[i], key + "[" + std::to_string(i) + "]", places, numbers);
    if (node.kind == Kind::table && has_bare_name(node.keys[i]))
      collect(node.items[i], key + (key.empty() ? "" : ".") + node.keys[i].name, places, numbers);
  }
}

std::string printed(double value, std::chars_format format) {
  char buffer[400];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format).ptr;
  return {buffer, end};
}

// "2.5e+07" as people write it: "2.5e7".
std::string with_exponent(double value) {
  std::string text = printed(value, std::chars_format::scientific);
  const std::size_t sign = text.find('e') + 1;
  if (text[sign] == '+') text.erase(sign, 1);
  const std::size_t digits = text.find_first_of("123456789", sign);
  const std::size_t first = sign + (text[sign] == '-' ? 1 : 0);
  if (digits == text.npos)
    text.erase(first, text.size() - first - 1);
  else
    text.erase(first, digits - first);
  return text;
}

// Hexadecimal, octal and binary numbers have a letter there and are whole.
bool is_in_another_base(std::string_view number) {
  return number.size() > 2 && number[0] == '0' && std::string_view("xob").find(number[1]) != std::string_view::npos;
}

std::string in_style_of(std::string_view old, double value) {
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  const bool had_exponent = !is_in_another_base(old) && old.find_first_of("eE") != old.npos;
  const double size = std::abs(value);
  if (value != 0 && (had_exponent || size < fixed_from || size >= fixed_to)) return with_exponent(value);
  std::string text = printed(value, std::chars_format::fixed);
  if (value == 0 && std::signbit(value)) return "-0.0";  // as a whole number it is 0
  if (text.find('.') == text.npos && old.find('.') != old.npos) text += ".0";
  return text;
}

// NaN is itself here, and −0 another number than 0.
bool is_same(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b);
}

std::string written(double value) { return in_style_of("", value); }

using Added = std::set<std::string>;  // keys

// The tree without its numbers, its places and what was added, for a comparison.
std::string outline(const Node& node, const std::string& path, const Added& added) {
  std::string all = std::to_string(static_cast<int>(node.kind)) + "(" + node.text + ")";
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const bool is_table = node.kind == Kind::table;
    const std::string own =
        is_table ? path + (path.empty() ? "" : ".") + node.keys[i].name : path + "[" + std::to_string(i) + "]";
    if (added.count(own) != 0) continue;
    all += (is_table ? node.keys[i].name + "=" : "") + outline(node.items[i], own, added) + ",";
  }
  return all;
}

bool differs_only_in_numbers(const std::string& before, const std::string& after, const Added& added) {
  const auto old_tree = parse_toml(before), new_tree = parse_toml(after);
  const Node* const a = std::get_if<Node>(&old_tree);
  const Node* const b = std::get_if<Node>(&new_tree);
  return a != nullptr && b != nullptr && outline(*a, "", added) == outline(*b, "", added);
}

const Node* table_at(const Node& tree, const std::string& path) {
  const std::size_t dot = path.find('.');
  const std::string name = path.substr(0, dot);
  for (std::size_t i = 0; i < tree.keys.size(); ++i) {
    if (tree.keys[i].name != name || tree.items[i].kind != Kind::table) continue;
    return dot == path.npos ? &tree.items[i] : table_at(tree.items[i], path.substr(dot + 1));
  }
  return nullptr;
}

// `text` with one more number; nothing where its table has no header and no brace of its own.
std::optional<std::string> with_number(const std::string& text, const std::string& key, double value) {
  const std::size_t dot = key.rfind('.');
  const auto document = parse_toml(text);
  const Node* const tree = std::get_if<Node>(&document);
  const Node* const table = tree == nullptr || dot == key.npos ? nullptr : table_at(*tree, key.substr(0, dot));
  if (table == nullptr || table->keys.empty()) return std::nullopt;
  const std::size_t begin = Places(text).byte(table->where);
  const std::string assignment = key.substr(dot + 1) + " = " + in_style_of("", value);
  std::string result = text;
  if (text[begin] == '{') return result.insert(begin + 1, " " + assignment + ",");
  if (text[begin] != '[' || text[begin + 1] == '[') return std::nullopt;
  const std::size_t end = text.find('\n', begin);
  if (end == text.npos) return std::nullopt;
  return result.insert(end + 1, assignment + (text[end - 1] == '\r' ? "\r\n" : "\n"));
}

// Whether `text` has the numbers of `before`, but those of `changes`, and besides the added ones.
bool has_become(const std::string& text, const std::vector<PlacedNumber>& before,
                const std::map<std::string, double>& changes, const Added& added) {
  std::vector<PlacedNumber> after = numbers_of(text);
  std::size_t found = 0;
  const auto is_added = [&](const PlacedNumber& number) {
    const bool is_new = added.count(number.key) != 0;
    found += is_new && is_same(number.value, changes.at(number.key));
    return is_new;
  };
  after.erase(std::remove_if(after.begin(), after.end(), is_added), after.end());
  if (found != added.size()) return false;
  return std::equal(before.begin(), before.end(), after.begin(), after.end(), [&](const auto& a, const auto& b) {
    const auto changed = changes.find(a.key);
    return a.key == b.key && is_same(b.value, changed == changes.end() ? a.value : changed->second);
  });
}

}  // namespace

std::vector<PlacedNumber> numbers_of(const std::string& text) {
  if (!check_text(text).empty()) return {};
  const auto document = parse_toml(text);
  const Node* const tree = std::get_if<Node>(&document);
  if (tree == nullptr) return {};
  std::vector<PlacedNumber> numbers;
  collect(*tree, "", Places(text), numbers);
  std::stable_sort(numbers.begin(), numbers.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return numbers;
}

std::string word_at(const std::string& text, Location where) {
  const Places places(text);
  const std::size_t begin = places.byte(where);
  return text.substr(begin, places.length(begin));
}

std::variant<std::string, EditFailure> set_numbers(const std::string& text, const std::vector<Change>& changes) {
  const std::vector<PlacedNumber> numbers = numbers_of(text);
  std::map<std::string, double> wanted;
  Added added;
  for (const Change& change : changes) {
    const auto has_key = [&](const PlacedNumber& number) { return number.key == change.key; };
    if (std::none_of(numbers.begin(), numbers.end(), has_key)) added.insert(change.key);
    if (std::isnan(change.value)) return EditFailure{change.key, "expected a number, found nan"};
    if (!wanted.emplace(change.key, change.value).second)
      return EditFailure{change.key, "expected one new value, found two"};
  }
  std::string result = text;
  for (auto number = numbers.rbegin(); number != numbers.rend(); ++number) {
    const auto change = wanted.find(number->key);
    if (change == wanted.end() || is_same(change->second, number->value)) continue;
    const std::string old = text.substr(number->begin, number->length);
    result.replace(number->begin, number->length, in_style_of(old, change->second));
  }
  for (const std::string& key : added) {
    const std::optional<std::string> longer = with_number(result, key, wanted.at(key));
    if (!longer) return EditFailure{key, "expected a number of the file, or a table to add it to, found neither"};
    result = *longer;
  }
  if (!has_become(result, numbers, wanted, added) || !differs_only_in_numbers(text, result, added)) {
    const std::string first = changes.empty() ? "" : changes.front().key;
    const std::string value = changes.empty() ? "" : written(changes.front().value);
    return EditFailure{first, "expected a file that can be changed at this key to " + value +
                                  ", found that another value changes, too: edit the file by hand"};
  }
  return result;
}

}  // namespace lqg::input
