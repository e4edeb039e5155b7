// SPDX-License-Identifier: MIT
// A place in the design file.
#pragma once

#include <string>

namespace lqg::input {

// Line and column count from 1, columns in characters. Line 0: the file as a whole.
struct Location {
  int line = 0;
  int column = 0;
};

// What is wrong at one place of the file, before any key is known.
struct Fault {
  Location where;
  std::string message;
};

}  // namespace lqg::input
