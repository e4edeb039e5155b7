// SPDX-License-Identifier: MIT
// What the values of a graph are called in C.
#pragma once

#include <string>
#include <vector>

#include "trace/graph.hpp"

namespace lqg::trace {

// The name of each node that `is_declared`, "" of the others: its own name, or its hint, or that of the value it is a
// part of among those that are needed: "law_voltage_part". Of those that want the same name the first gets it, the next
// gets "…_2"; reserved names are taken.
std::vector<std::string> names_of(const Graph& graph, const std::vector<bool>& is_needed,
                                  const std::vector<bool>& is_declared);

}  // namespace lqg::trace
