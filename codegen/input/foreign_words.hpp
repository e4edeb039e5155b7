// SPDX-License-Identifier: MIT
// Words of MATLAB, python-control and textbooks for keys of the design file.
#pragma once

#include <string>

namespace lqg::input {

// What the writer of the key `name` in the table `table` may have meant: the path of a key, or, where lqgen has none, a
// sentence.
struct ForeignWord {
  std::string path;
  std::string sentence;
};

// Both empty for a word that is not known. Capitals count for nothing but for K and L.
ForeignWord foreign_word(const std::string& table, const std::string& name);

}  // namespace lqg::input
