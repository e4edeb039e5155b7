// SPDX-License-Identifier: MIT
#include "expression/tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace lqg::expression {

namespace {

struct Described {
  Operation operation;
  const char* name;
  std::size_t operands;
  bool is_function;
};

constexpr std::array<Described, 20> described = {
    {{Operation::negate, "-", 1, false},   {Operation::add, "+", 2, false},      {Operation::subtract, "-", 2, false},
     {Operation::multiply, "*", 2, false}, {Operation::divide, "/", 2, false},   {Operation::power, "^", 2, false},
     {Operation::sqrt, "sqrt", 1, true},   {Operation::sin, "sin", 1, true},     {Operation::cos, "cos", 1, true},
     {Operation::tan, "tan", 1, true},     {Operation::asin, "asin", 1, true},   {Operation::acos, "acos", 1, true},
     {Operation::atan, "atan", 1, true},   {Operation::atan2, "atan2", 2, true}, {Operation::exp, "exp", 1, true},
     {Operation::log, "log", 1, true},     {Operation::tanh, "tanh", 1, true},   {Operation::abs, "abs", 1, true},
     {Operation::min, "min", 2, true},     {Operation::max, "max", 2, true}}};

const Described& of(Operation operation) { return described[static_cast<std::size_t>(operation)]; }

Tree made(Node node) { return std::make_shared<const Node>(std::move(node)); }

Node leaf(Node::Kind kind, std::size_t at) {
  Node node;
  node.kind = kind;
  node.at = at;
  return node;
}

}  // namespace

Tree number(double value, std::size_t at) {
  Node node = leaf(Node::Kind::number, at);
  node.number = value;
  return made(std::move(node));
}

Tree pi(std::size_t at) { return made(leaf(Node::Kind::pi, at)); }

Tree name(const std::string& name, std::size_t at) {
  Node node = leaf(Node::Kind::name, at);
  node.name = name;
  node.is_constant = false;
  return made(std::move(node));
}

Tree variable(const std::string& name, int index, std::size_t at) {
  Node node = leaf(Node::Kind::variable, at);
  node.name = name;
  node.index = index;
  node.is_constant = false;
  return made(std::move(node));
}

Tree parameter(const std::string& name, Tree value, std::size_t at) {
  Node node = leaf(Node::Kind::parameter, at);
  node.name = name;
  node.is_constant = value->is_constant;
  node.depth = value->depth + 1;
  node.operands = {std::move(value)};
  return made(std::move(node));
}

Tree operation(Operation operation, std::vector<Tree> operands, std::size_t at) {
  Node node = leaf(Node::Kind::operation, at);
  node.operation = operation;
  for (const Tree& operand : operands) {
    node.is_constant = node.is_constant && operand->is_constant;
    node.depth = std::max(node.depth, operand->depth + 1);
  }
  node.operands = std::move(operands);
  return made(std::move(node));
}

const char* name_of(Operation operation) { return of(operation).name; }

std::size_t operands_of(Operation operation) { return of(operation).operands; }

std::optional<Operation> function_of(const std::string& name) {
  for (const Described& one : described)
    if (one.is_function && name == one.name) return one.operation;
  return std::nullopt;
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Described& one : described)
      if (one.is_function) all.emplace_back(one.name);
    return all;
  }();
  return names;
}

std::optional<int> whole_exponent(const Node& exponent) {
  switch (exponent.kind) {
    case Node::Kind::number: {
      const bool is_whole =
          std::abs(exponent.number) <= largest_whole_exponent && std::trunc(exponent.number) == exponent.number;
      return is_whole ? std::optional<int>(static_cast<int>(exponent.number)) : std::nullopt;
    }
    case Node::Kind::parameter: return whole_exponent(*exponent.operands[0]);
    case Node::Kind::operation: {
      if (exponent.operation != Operation::negate) return std::nullopt;
      const std::optional<int> positive = whole_exponent(*exponent.operands[0]);
      return positive ? std::optional<int>(-*positive) : std::nullopt;
    }
    default: return std::nullopt;
  }
}

}  // namespace lqg::expression
