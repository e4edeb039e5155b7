// SPDX-License-Identifier: MIT
// What differs between design files, key by key.
#pragma once

#include <string>
#include <vector>

namespace lqg::view {

struct Difference {
  std::string key;                  // "lqr.Q[1]"
  std::vector<std::string> values;  // of each file, as it is written there; "–" where it has no such key
};

// In the order of the first file that has the key. Spelling is no difference: 1e3 is 1000. Of an array with many
// differences, or with another shape, one line tells how many there are. All texts are TOML.
std::vector<Difference> differences(const std::vector<std::string>& texts);

}  // namespace lqg::view
