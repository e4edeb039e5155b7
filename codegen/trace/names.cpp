// SPDX-License-Identifier: MIT
#include "trace/names.hpp"

#include <set>

namespace lqg::trace {

namespace {

std::string own_name(const Node& node) { return node.name.empty() ? node.hint : node.name; }

// Of each node that has no name of its own: the name of the first value that is made of it, or "".
std::vector<std::string> names_of_wholes(const Graph& graph, const std::vector<bool>& is_needed) {
  std::vector<std::string> wholes(graph.nodes().size());
  for (std::size_t i = wholes.size(); i-- > 0;) {  // a node stands before what is made of it; the first one writes last
    if (!is_needed[i]) continue;
    const Node& node = graph.nodes()[i];
    const std::string own = own_name(node), name = own.empty() ? wholes[i] : own;
    for (const int operand : {node.a, node.b, node.c})
      if (operand >= 0 && !name.empty()) wholes[static_cast<std::size_t>(operand)] = name;
  }
  return wholes;
}

class Namer {
 public:
  explicit Namer(const std::set<std::string>& taken) : taken_(taken) {}

  std::string unique(const std::string& wanted, const char* joint) {
    std::string name = wanted;
    for (int i = 2; !taken_.insert(name).second; ++i) name = wanted + joint + std::to_string(i);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace

std::vector<std::string> names_of(const Graph& graph, const std::vector<bool>& is_needed,
                                  const std::vector<bool>& is_declared) {
  const std::vector<std::string> wholes = names_of_wholes(graph, is_needed);
  std::vector<std::string> names(graph.nodes().size());
  Namer namer(graph.reserved());
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_declared[i]) continue;
    const std::string own = own_name(graph.nodes()[i]);
    names[i] =
        !own.empty() ? namer.unique(own, "_") : namer.unique((wholes[i].empty() ? "result" : wholes[i]) + "_part", "");
  }
  return names;
}

}  // namespace lqg::trace
