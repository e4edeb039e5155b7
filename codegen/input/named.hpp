// SPDX-License-Identifier: MIT
// Tables of a design file whose keys are names of signals, with or without their units.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/document.hpp"
#include "input/keys.hpp"
#include "input/report.hpp"

namespace lqg::input {

// The smallest and the largest value of each signal in `names`, infinite where the table does not name it; nothing, and
// what is wrong reported, when they cannot be had.
std::optional<Eigen::MatrixXd> read_ranges(const KeyRule& rule, const Node& node, const std::vector<std::string>& names,
                                           Report& report);

// A number > 0 of each name that is there; likewise.
std::optional<std::map<std::string, double>> read_prices(const std::string& key, const Node& node,
                                                         const std::vector<std::string>& names, Report& report);

}  // namespace lqg::input
