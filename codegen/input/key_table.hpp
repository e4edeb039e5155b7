// SPDX-License-Identifier: MIT
// The parts that the table of keys is put together of.
#pragma once

#include <vector>

#include "input/keys.hpp"

namespace lqg::input {

inline void append(std::vector<KeyRule>& to, const std::vector<KeyRule>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::vector<KeyRule> scenario_keys();
std::vector<KeyRule> requirement_keys();

}  // namespace lqg::input
