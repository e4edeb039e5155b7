// SPDX-License-Identifier: MIT
// What the names of a formula stand for.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "expression/parse.hpp"

namespace lqg::expression {

// What a name is: a variable or a parameter (made by variable() or parameter()), or nullptr if it is not known.
using Meaning = std::function<Tree(const std::string& name, std::size_t at)>;

// The tree with every name replaced by its meaning, or the first name that has none. A tree that would be deeper than
// deepest_tree is a fault, too.
std::variant<Tree, Fault> bind(const Tree& tree, const Meaning& meaning);

// The names in a tree that is not bound, each once, in the order of the text.
std::vector<std::string> names_in(const Tree& tree);
// The variables of a bound tree, rising.
std::vector<int> variables_in(const Tree& tree);

}  // namespace lqg::expression
