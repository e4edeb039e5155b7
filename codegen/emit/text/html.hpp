// SPDX-License-Identifier: MIT
// Text that becomes HTML.
#pragma once

#include <string>

namespace lqg::emit {

// With &, <, > and " written as entities.
std::string escaped(const std::string& text);

// How many letters a reader sees: UTF-8's continuation bytes do not count.
std::size_t letters(const std::string& text);

}  // namespace lqg::emit
