// SPDX-License-Identifier: MIT
#include "expression/bind.hpp"

#include <algorithm>
#include <utility>

namespace lqg::expression {

namespace {

// Replaces names; the first one without a meaning ends it.
class Binder {
 public:
  explicit Binder(const Meaning& meaning) : meaning_(meaning) {}

  Tree bound(const Tree& tree) {
    if (fault_ || tree->kind == Node::Kind::variable || tree->kind == Node::Kind::parameter) return tree;
    if (tree->kind == Node::Kind::name) {
      Tree meant = meaning_(tree->name, tree->at);
      if (meant) return meant;
      fault_ = Fault{tree->at, "unknown name " + tree->name};
      return tree;
    }
    if (tree->kind != Node::Kind::operation || tree->is_constant) return tree;
    std::vector<Tree> operands;
    for (const Tree& operand : tree->operands) operands.push_back(bound(operand));
    return operation(tree->operation, std::move(operands), tree->at);
  }
  const std::optional<Fault>& fault() const { return fault_; }

 private:
  const Meaning& meaning_;
  std::optional<Fault> fault_;
};

template <class Visit>
void for_each_leaf(const Node& node, const Visit& visit) {
  if (node.operands.empty()) visit(node);
  for (const Tree& operand : node.operands) for_each_leaf(*operand, visit);
}

}  // namespace

std::variant<Tree, Fault> bind(const Tree& tree, const Meaning& meaning) {
  Binder binder(meaning);
  Tree bound = binder.bound(tree);
  if (binder.fault()) return *binder.fault();
  if (bound->depth > deepest_tree) return Fault{0, "formulas within formulas, too deep"};
  return bound;
}

std::vector<std::string> names_in(const Tree& tree) {
  std::vector<std::string> names;
  for_each_leaf(*tree, [&](const Node& leaf) {
    if (leaf.kind == Node::Kind::name && std::find(names.begin(), names.end(), leaf.name) == names.end())
      names.push_back(leaf.name);
  });
  return names;
}

std::vector<int> variables_in(const Tree& tree) {
  std::vector<int> variables;
  for_each_leaf(*tree, [&](const Node& leaf) {
    if (leaf.kind == Node::Kind::variable) variables.push_back(leaf.index);
  });
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  return variables;
}

}  // namespace lqg::expression
