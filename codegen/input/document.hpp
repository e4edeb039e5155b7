// SPDX-License-Identifier: MIT
// A TOML text as a tree of values with their places. The one file that sees toml++ is document.cpp.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "input/location.hpp"

namespace lqg::input {

enum class Kind { text, number, boolean, date, array, table };

struct Key {
  std::string name;
  Location where;
};

struct Formula;

// `items` are an array's values, or a table's with their `keys` beside them, in the order of the file.
struct Node {
  Kind kind = Kind::table;
  Location where;
  double number = 0;  // 1 of true
  std::string text;
  std::vector<Key> keys;
  std::vector<Node> items;
  std::shared_ptr<const Formula> formula = {};  // of a number that was a text; put there by read_formulas
};

// "a string", "an array": what a message says was found.
std::string describe(const Node& node);

// The tree, or what keeps `text` from being TOML. `text` has passed check_text.
std::variant<Node, Fault> parse_toml(const std::string& text);

}  // namespace lqg::input
