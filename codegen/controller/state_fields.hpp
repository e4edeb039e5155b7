// SPDX-License-Identifier: MIT
// What the struct NAME_t holds.
#pragma once

#include <string>
#include <vector>

#include "controller/controller.hpp"

namespace lqg::controller {

// counter: unsigned; total: unsigned long; counters: an array of them
enum class Kind { reals, counter, total, counters };

struct Field {
  std::string name;
  Kind kind = Kind::reals;
  int count = 1;
  std::string dimension;  // of an array, in C
  std::string comment;
  std::vector<double> initial;  // numbers of the target; empty: 0
};

// In their order; none where the controller needs no memory.
std::vector<Field> state_fields(const Controller& controller);

// sizeof(NAME_t) on the targets
long state_bytes(const Controller& controller);

}  // namespace lqg::controller
