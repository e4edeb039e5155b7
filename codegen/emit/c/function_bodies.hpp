// SPDX-License-Identifier: MIT
// What stands between the braces of the emitted functions, in either style.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

// Everything of the header that depends on the style.
struct FunctionBodies {
  std::string includes;   // #include lines and checks of options
  std::string constants;  // definitions that the functions need
  std::string options;    // of the compiler, for the functions
  std::string helpers;    // functions that the others call
  std::string init, recover, weigh, update, control, predict;
  std::string step;                        // empty: it makes the calls of a sample
  std::vector<std::string> updates_alone;  // of each output that can_update_alone
  bool resets = false;                     // they call NAME_reset, or NAME_recover where P is carried
};

// #error where the library is compiled with other numbers.
std::string options_check(const Controller& controller);

// What predict does to the counters at its end.
std::string advance_counters(const Controller& controller);

// The update by one output alone where there is no other.
std::string only_update_body(const Controller& controller);

// What all straight-line code begins with: includes, options, init.
FunctionBodies straight_line_bodies(const Controller& controller);

FunctionBodies unrolled_bodies(const Controller& controller);
FunctionBodies shared_bodies(const Controller& controller);
FunctionBodies products_bodies(const Controller& controller);
FunctionBodies compact_bodies(const Controller& controller);

// Of gains that change from sample to sample, the entries that do; the others are numbers in the code.
std::string gain_tables(const Controller& controller);

}  // namespace lqg::emit
