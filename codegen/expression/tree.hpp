// SPDX-License-Identifier: MIT
// A formula as a tree: numbers, names, operations, in the order of the text.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lqg::expression {

enum class Operation {
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  sqrt,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,  // atan2(y, x)
  exp,
  log,
  tanh,
  abs,
  min,
  max
};

struct Node;
using Tree = std::shared_ptr<const Node>;

// `at` is where it begins in its text, in bytes; of an operation of two operands where its sign stands.
struct Node {
  enum class Kind {
    number,  // the double that the text's number is
    pi,
    name,       // not bound yet
    variable,   // number `index` of the signals that the formula is over
    parameter,  // `name`, whose value is its one operand
    operation
  };
  Kind kind = Kind::number;
  double number = 0;
  std::string name;
  int index = -1;
  Operation operation = Operation::add;
  std::vector<Tree> operands;
  std::size_t at = 0;
  bool is_constant = true;  // nothing in it is a variable or a name
  int depth = 1;            // nodes from here to the farthest leaf
};

// Deeper trees are refused where they would be made, because everything that walks a tree calls itself.
constexpr int deepest_tree = 5000;

Tree number(double value, std::size_t at = 0);
Tree pi(std::size_t at = 0);
Tree name(const std::string& name, std::size_t at = 0);
Tree variable(const std::string& name, int index, std::size_t at = 0);
Tree parameter(const std::string& name, Tree value, std::size_t at = 0);
Tree operation(Operation operation, std::vector<Tree> operands, std::size_t at = 0);

// "sin", or "+" of an operation that is written as a sign.
const char* name_of(Operation operation);
// How many operands it has.
std::size_t operands_of(Operation operation);
// The function of that name.
std::optional<Operation> function_of(const std::string& name);
// "sqrt", "sin", … in their order.
const std::vector<std::string>& function_names();

// Larger powers are not made of products.
constexpr int largest_whole_exponent = 64;

// What `exponent` is, if it is a whole number in plain sight: a literal, its negative, or a parameter that is one. Then
// a power is made of products.
std::optional<int> whole_exponent(const Node& exponent);

}  // namespace lqg::expression
