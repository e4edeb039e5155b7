// SPDX-License-Identifier: MIT
// Traced functions as the bodies of C functions.
#pragma once

#include <initializer_list>
#include <string>

#include "emit/recorded/traced.hpp"

namespace lqg::emit {

// `parameters` that the body does not need are said to be unused; `last` stands behind its statements.
std::string body(const Controller& controller, const TracedFunction& function,
                 std::initializer_list<const char*> parameters, const std::string& last = "");

// The end of a body that has a status already: the statements, and the answer where what they find is not sound.
std::string end_of_body(const Controller& controller, const TracedFunction& function);

// The body of recover: P begins anew.
std::string recover_body(const Controller& controller);

// The body of weigh: whether an output is used whose innovation is not as expected.
std::string weigh_body(const Controller& controller);

// The statements alone, which end with their stores.
std::string statements(const TracedFunction& function);

// Statements that set bit i of `lost` for each output that a partial update leaves out.
std::string collect_lost(const TracedFunction& function);

// "{0.5f, 1.0f}"
std::string initializer(const std::vector<double>& values, bool is_double);

// The body of init: all fields of the state, in their order.
std::string initial_state(const Controller& controller);

}  // namespace lqg::emit
