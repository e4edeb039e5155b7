// SPDX-License-Identifier: MIT
// Lists of a design file that are no vectors: indices, and poles.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <optional>
#include <vector>

#include "input/document.hpp"
#include "input/keys.hpp"
#include "input/report.hpp"

namespace lqg::input {

// Different whole numbers from 0 to below the size of the rule's rows, each of them or the name that stands there in
// `names` (of outputs; empty: not known); nothing, and what is wrong reported, when they cannot be had.
std::optional<std::vector<int>> read_indices(const KeyRule& rule, const Node& node, const std::map<Size, int>& sizes,
                                             const std::vector<std::string>& names, Report& report);

// Indices of signals, and beside each its size where the file gives sizes; else none.
struct Walks {
  std::vector<int> indices;
  Eigen::VectorXd sizes;
};

// An array as read_indices has it, or a table of a number > 0 for each name.
std::optional<Walks> read_walks(const KeyRule& rule, const Node& node, const std::map<Size, int>& sizes,
                                const std::vector<std::string>& names, Report& report);

// One of them. Of a key whose signals are not known (`names` is empty) any whole number ≥ 0.
std::optional<int> read_signal_index(const KeyRule& rule, const Node& node, const std::vector<std::string>& names,
                                     Report& report);

// Whole numbers ≥ 1.
std::optional<std::vector<int>> read_counts(const std::string& key, const Node& node, Report& report);

// Numbers, and [re, im] with their conjugates somewhere in the list; in the result these stand side by side,
// the positive imaginary part first.
std::optional<std::vector<std::complex<double>>> read_poles(const std::string& key, const Node& node, Report& report);

}  // namespace lqg::input
