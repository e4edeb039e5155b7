// SPDX-License-Identifier: MIT
// A compensator of a given order, and white parameters, in words and numbers.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

// For the header: its equations and matrices, and what is known of the optimum. Empty without a compensator.
std::string describe_compensator(const Controller& controller);

// What is known of the optimum, and its poles: lines behind an empty one and a heading; empty without a compensator.
std::string describe_optimum(const Controller& controller);

// What white parameters cost, likewise; empty without them, and of a filter alone.
std::string describe_white(const Controller& controller);

// The same as names and values.
using Facts = std::vector<std::pair<std::string, std::string>>;
Facts facts_of_optimum(const Controller& controller);
Facts facts_of_white(const Controller& controller);

// By how much its cost is above that of LQG, in percent; empty where that is not known.
std::optional<double> gap_percent(const design::CompensatorSolution& compensator);

}  // namespace lqg::emit
