// SPDX-License-Identifier: MIT
// How the values of a sample are called in C: by the names that the design has for its signals.
#pragma once

#include <set>
#include <string>

#include "emit/controller.hpp"
#include "step/model.hpp"

namespace lqg::emit {

// "_pitch_rate" of a state, an input or an output, "_21" of an entry, "_P_00": what stands behind what the value is.
std::string suffix_of(const Controller& controller, const step::Place& place);

// "_0", "_31", "_3_11": row and column behind the name of a matrix with up to `size` rows.
std::string index_suffix(int i, int j, int size);

// What is something else inside the functions of a header: parameters, functions, tables.
std::set<std::string> reserved_names(const Controller& controller);

}  // namespace lqg::emit
