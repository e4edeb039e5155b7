// SPDX-License-Identifier: MIT
// The secret in the address of the page.
#pragma once

#include <string>
#include <string_view>

namespace lqg::serve {

// 32 hexadecimal digits from the operating system's random source. Throws std::runtime_error where it has none.
std::string random_token();

// Takes the same time wherever they differ.
bool is_same_secret(std::string_view a, std::string_view b);

}  // namespace lqg::serve
