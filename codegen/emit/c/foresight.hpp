// SPDX-License-Identifier: MIT
// Limits that are foreseen: the tables of the library's solver, and the law before it.
#pragma once

#include "emit/c/function_bodies.hpp"

namespace lqg::emit {

// `bodies` are those of a controller with foresight, whose `control` is the law without its limits. They get what the
// solver takes, and step makes the calls of a sample.
void add_foresight(const Controller& controller, FunctionBodies& bodies);

// NAME_law, and what NAME_control makes of it.
std::string law_function(const Controller& controller, const std::string& body);
std::string foreseeing_control_body(const Controller& controller);

// Beside the law: u is kept for the next sample by control itself.
bool keeps_input_in_control(const Controller& controller);

}  // namespace lqg::emit
