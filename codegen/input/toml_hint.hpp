// SPDX-License-Identifier: MIT
// What in a line that is not TOML is another language's.
#pragma once

#include <string>
#include <string_view>

namespace lqg::input {

// A sentence for MATLAB's matrices, arithmetic, and units in a line that the parser has refused; "" for what is none of
// these.
std::string toml_hint(std::string_view line);

}  // namespace lqg::input
