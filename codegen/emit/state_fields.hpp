// What the struct NAME_t holds.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

// counter: unsigned; total: unsigned long; counters: an array of them
enum class Kind { reals, counter, total, counters };

struct Field {
  std::string name;
  Kind kind = Kind::reals;
  int count = 1;
  std::string dimension;        // of an array, in C
  std::string comment;
  std::vector<double> initial;  // numbers of the target; empty: 0
};

// In their order; none where the controller needs no memory.
std::vector<Field> state_fields(const Controller& controller);

// "{real} x[{NAME}_NX]"
std::string declaration(const Field& field);

// sizeof(NAME_t) on the targets
long state_bytes(const Controller& controller);

}  // namespace lqg::emit
