// SPDX-License-Identifier: MIT
// Matrices and vectors of a design file: their form, their entries, their shape.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "design/exact_matrix.hpp"
#include "input/document.hpp"
#include "input/keys.hpp"
#include "input/report.hpp"

namespace lqg::input {

// More states, inputs, outputs or process noises than this are refused: long before, the design takes for
// ever.
constexpr int most_signals = 256;

// Dimensions that the plant's matrices tell: 0 where there is no such matrix, −1 where it is wrong.
std::map<Size, int> measure(const std::map<std::string, const Node*>& nodes);

// "nx"
std::string name_of(Size size);

// The matrix of a key of type matrix, weight, vector or bounds, in its shape; nothing, and what is wrong
// reported, when it cannot be had. A dimension that is not known is not checked.
std::optional<design::ExactMatrix> read_matrix(const KeyRule& rule, const Node& node, const std::map<Size, int>& sizes,
                                               Report& report);

}  // namespace lqg::input
