// SPDX-License-Identifier: MIT
// From a text to its tree.
//
//     sum     = product { ("+" | "-") product }
//     product = signed  { ("*" | "/") signed }
//     signed  = { "+" | "-" } power
//     power   = atom [ "^" signed ]                  a^b^c = a^(b^c), −a^b = −(a^b)
//     atom    = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
//
// A number is written as in C: 1, 0.5, .5, 2e-3. A name has letters, digits and _, and does not begin with a digit;
// `pi` and the names of the functions are reserved.
#pragma once

#include <string>
#include <variant>

#include "expression/tree.hpp"

namespace lqg::expression {

struct Fault {
  std::size_t at = 0;  // byte of the text
  std::string message;
};

// Longer texts, and parentheses and powers that nest deeper, are refused, so that no text exhausts the stack.
constexpr std::size_t longest_text = 4000;  // bytes
constexpr int deepest_nesting = 100;

std::variant<Tree, Fault> parse(const std::string& text);

}  // namespace lqg::expression
