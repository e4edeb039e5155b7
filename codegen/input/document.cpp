// SPDX-License-Identifier: MIT
#include "input/document.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "input/toml_hint.hpp"

// toml++ 3.3.0 runs into its own assertions on `[ = 1`: here they are always on, and are exceptions. That
// holds only for a parser that is compiled here, not for one in a shared library.
namespace {
struct ParserAssertion {};
[[noreturn]] void throw_assertion() { throw ParserAssertion(); }
}  // namespace
#undef NDEBUG
#define TOML_ASSERT(condition)           \
  do {                                   \
    if (!(condition)) throw_assertion(); \
  } while (false)
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#define TOML_MAX_NESTED_VALUES 32
#define TOML_ENABLE_FORMATTERS 0
#ifdef __cpp_lib_to_chars
#define TOML_FLOAT_CHARCONV 1  // correctly rounded whatever the locale; refuses what a double cannot hold
#endif
#include <toml++/toml.h>

namespace lqg::input {
namespace {

Location location(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

Node convert(const toml::node& node);

void convert_table(const toml::table& table, Node& result) {
  std::vector<std::pair<Key, const toml::node*>> members;
  for (const auto& [key, value] : table)
    members.push_back({{std::string(key.str()), location(key.source().begin)}, &value});
  std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.where.line, a.first.where.column) < std::pair(b.first.where.line, b.first.where.column);
  });
  for (const auto& [key, value] : members) {
    result.keys.push_back(key);
    result.items.push_back(convert(*value));
  }
}

Node convert(const toml::node& node) {
  Node result;
  result.where = location(node.source().begin);
  switch (node.type()) {
    case toml::node_type::table: convert_table(*node.as_table(), result); break;
    case toml::node_type::array:
      result.kind = Kind::array;
      for (const toml::node& item : *node.as_array()) result.items.push_back(convert(item));
      break;
    case toml::node_type::string:
      result.kind = Kind::text;
      result.text = node.as_string()->get();
      break;
    case toml::node_type::integer:
      result.kind = Kind::number;
      result.number = static_cast<double>(node.as_integer()->get());
      break;
    case toml::node_type::floating_point:
      result.kind = Kind::number;
      result.number = node.as_floating_point()->get();
      break;
    case toml::node_type::boolean:
      result.kind = Kind::boolean;
      result.number = node.as_boolean()->get() ? 1 : 0;
      break;
    default: result.kind = Kind::date; break;
  }
  return result;
}

bool trips_assertion(std::string_view text) {
  try {
    (void)toml::parse(text);
  } catch (const ParserAssertion&) {
    return true;
  } catch (const toml::parse_error&) {
  }
  return false;
}

// The parser reads from left to right: the shortest beginning of the text that trips it ends with the
// culprit.
Fault find_assertion(const std::string& text) {
  std::size_t passes = 0;
  std::size_t trips = text.size();
  while (trips - passes > 1) {
    const std::size_t middle = passes + (trips - passes) / 2;
    (trips_assertion(std::string_view(text).substr(0, middle)) ? trips : passes) = middle;
  }
  const std::string_view before = std::string_view(text).substr(0, passes);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
  const auto column = 1 + std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start), before.end(),
                                        [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; });
  return {{static_cast<int>(line), static_cast<int>(column)}, "not TOML: unexpected `" + text.substr(passes, 1) + "`"};
}

std::string_view line_of(std::string_view text, int line) {
  for (; line > 1 && text.find('\n') != text.npos; --line) text.remove_prefix(text.find('\n') + 1);
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::string describe(const Node& node) {
  switch (node.kind) {
    case Kind::text: return "a string";
    case Kind::number: return "a number";
    case Kind::boolean: return "a boolean";
    case Kind::date: return "a date or time";
    case Kind::array: return node.items.empty() ? "an empty array" : "an array";
    case Kind::table: return "a table";
  }
  return "nothing";
}

std::variant<Node, Fault> parse_toml(const std::string& text) {
  constexpr std::string_view noise = "Error while parsing ";
  try {
    return convert(toml::parse(text));
  } catch (const toml::parse_error& error) {
    const std::string hint = toml_hint(line_of(text, location(error.source().begin).line));
    if (!hint.empty()) return Fault{location(error.source().begin), "not TOML: " + hint};
    std::string_view reason = error.description();
    if (reason.rfind(noise, 0) == 0) reason.remove_prefix(noise.size());
    return Fault{location(error.source().begin), "not TOML: " + std::string(reason)};
  } catch (const ParserAssertion&) {
    return find_assertion(text);
  }
}

}  // namespace lqg::input
