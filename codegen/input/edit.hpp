// SPDX-License-Identifier: MIT
// Changes numbers of a design file, or adds them, and nothing else of it: comments, layout and line ends stay byte for
// byte.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "input/location.hpp"

namespace lqg::input {

// A number as it stands in the file. `key` is that of findings: "plant.sample_time", "lqr.Q[1]", "stage[0].A[2][0]".
struct PlacedNumber {
  std::string key;
  double value = 0;
  std::size_t begin = 0, length = 0;  // bytes of the text
};

struct Change {
  std::string key;
  double value = 0;
};

// All numbers of `text` in the order of the file; none where it is not TOML. Keys that need quotes are left out: no key
// of a design file does.
std::vector<PlacedNumber> numbers_of(const std::string& text);

// The number, boolean or date that begins at `where`, as it is written.
std::string word_at(const std::string& text, Location where);

// Why a number was not set: the key ("" where it is the text as a whole), and "expected …, found …".
struct EditFailure {
  std::string key;
  std::string message;
};

// `text` with these numbers. Each is the shortest that reads back as the value, in the style of the one before:
// an exponent stays an exponent, 2.0 becomes 3.0, and 2 becomes 3. A number that is not there, "plant.delay", is added
// where its table begins: in a line of its own behind [plant], or as the first key behind a brace. The result has been
// read again: it has these values and otherwise those of `text`. A key that is no number of the file and has no such
// table, a value that is not a number, and a key that comes twice are failures.
std::variant<std::string, EditFailure> set_numbers(const std::string& text, const std::vector<Change>& changes);

}  // namespace lqg::input
