// SPDX-License-Identifier: MIT
// The design in words and numbers, for the header's first comment and for the terminal: lines, each part behind an
// empty one and its heading; empty where the design has no such part.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string describe_point(const Controller& controller);  // the operating point; describe_plant has it, too
std::string describe_plant(const Controller& controller);
std::string describe_regulator(const Controller& controller);
std::string describe_estimator(const Controller& controller);  // describe_gains among it
std::string describe_gains(const Controller& controller);      // of the filter, and its poles
std::string describe_linear_form(const Controller& controller);
std::string describe_modes(const Controller& controller);  // of a filter that keeps z
std::string describe_loop(const Controller& controller);
std::string describe_rms(const Controller& controller);
std::string describe_poles(const Controller& controller);  // of the loop, in z and s
std::string describe_forms(const Controller& controller);
std::string describe_cost(const Controller& controller);

}  // namespace lqg::emit
