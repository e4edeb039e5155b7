// SPDX-License-Identifier: MIT
#include "trace/expr.hpp"

namespace lqg::trace {

namespace {
thread_local Graph* in_force = nullptr;
}

Graph& graph() { return *in_force; }

Recording::Recording(Graph& graph) : before_(in_force) { in_force = &graph; }

Recording::~Recording() { in_force = before_; }

}  // namespace lqg::trace
