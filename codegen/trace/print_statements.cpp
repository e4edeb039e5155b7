// SPDX-License-Identifier: MIT
// The statements of a function, and where a recovery comes between them.
#include <map>

#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::trace {

// What the rest reads of the values before it, by an expression that has no statement of its own or as it is.
std::vector<bool> Printer::used_in_rest(const std::vector<int>& results_of_rest) const {
  std::vector<bool> used(uses_.size(), false);
  for (const int result : results_of_rest) used[static_cast<std::size_t>(result)] = true;
  for (std::size_t i = uses_.size(); i-- > 0;) {
    const Node& node = graph_.nodes()[i];
    const bool is_of_rest = static_cast<int>(i) >= graph_.rest();
    if (!needs(static_cast<int>(i)) || node.op == Op::resumed || !(is_of_rest || used[i])) continue;
    if (!is_of_rest && is_declared(static_cast<int>(i))) continue;
    for (const int operand : {node.a, node.b, node.c})
      if (operand >= 0) used[static_cast<std::size_t>(operand)] = true;
  }
  return used;
}

void Printer::find_variables(const std::vector<int>& results_of_rest) {
  if (is_lane()) return;
  const std::vector<bool> is_used_in_rest = used_in_rest(results_of_rest);
  for (std::size_t i = static_cast<std::size_t>(graph_.rest()); i < uses_.size(); ++i) {
    const Node& node = graph_.nodes()[i];
    if (node.op != Op::resumed || !needs(static_cast<int>(i))) continue;
    const std::size_t before = static_cast<std::size_t>(node.a);
    const Node& value = graph_.nodes()[before];
    if (value.op == Op::input && value.text == node.text && uses_[before] == 1) {
      uses_[before] = 0;
      continue;
    }
    is_variable_[i] = true;
    if (value.op == Op::constant || is_parameter(value) || is_used_in_rest[before] || is_variable_[before]) continue;
    is_variable_[before] = has_variable_of_before_[i] = true;
  }
}

std::string Printer::assignment(const Store& store) const {
  const std::string line = wrap("    " + place(store.target) + " = " + expression(store.node) + ";", 8) + "\n";
  return graph_.target().is_prover && store.target.rfind("u[", 0) == 0 ? line + "    /*@ slevel merge; */ ;\n" : line;
}

std::string Printer::statements(const std::vector<Store>& stores) const {
  return printed(0, static_cast<int>(graph_.nodes().size()), stores, "");
}

std::string Printer::statements_before_rest(const std::vector<Store>& stores) const {
  std::string variables;
  for (int node = graph_.rest(); node < static_cast<int>(uses_.size()); ++node)
    if (is_variable_[static_cast<std::size_t>(node)] && !has_variable_of_before_[static_cast<std::size_t>(node)])
      variables += declaration(node);
  return printed(0, graph_.rest(), stores, "") + (variables.empty() ? "" : "\n" + variables);
}

std::string Printer::read_again(int indent) const {
  std::string out;
  for (int node = graph_.rest(); node < static_cast<int>(uses_.size()); ++node)
    if (is_variable_[static_cast<std::size_t>(node)])
      out += std::string(static_cast<std::size_t>(indent), ' ') + name_of(node) + " = " +
             graph_.nodes()[static_cast<std::size_t>(node)].text + ";\n";
  return out;
}

std::string Printer::statements_of_rest(const std::vector<Store>& stores) const {
  std::string loads;
  for (int node = graph_.rest(); node < static_cast<int>(uses_.size()); ++node)
    if (is_read_late(node)) loads += declaration(node);
  return printed(graph_.rest(), static_cast<int>(uses_.size()), stores, loads.empty() ? "" : "\n" + loads);
}

// The nodes from `from` on, before `to`.
std::string Printer::printed(int from, int to, const std::vector<Store>& stores, std::string loads) const {
  std::multimap<int, const Store*> ready;
  for (const Store& store : stores) ready.emplace(is_declared(store.node) ? store.node : -1, &store);
  std::string blocks;
  int section = 0;
  for (int node = from; node < to; ++node) {
    const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
    if (!needs(node) || !is_declared(node) || at.op == Op::resumed) continue;
    if (at.op == Op::input) {
      loads += declaration(node);
      continue;
    }
    const std::string statement = declaration(node);
    if (!statement.empty() && at.section != section && !graph_.equation(at.section).empty())
      blocks += heading(graph_.equation(at.section));
    if (!statement.empty()) section = at.section;
    blocks += statement;
    for (auto [store, end] = ready.equal_range(node); store != end; ++store) blocks += assignment(*store->second);
  }
  std::string rest;  // a number, an input, what is there already, or an expression that needs no name
  for (const auto& [node, store] : ready) {
    const Op op = node < 0 ? Op::input : graph_.nodes()[static_cast<std::size_t>(node)].op;
    if (op == Op::input || op == Op::resumed || node < from) rest += assignment(*store);
  }
  return loads + blocks + (rest.empty() ? "" : "\n" + rest);
}

}  // namespace lqg::trace
