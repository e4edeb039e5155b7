// SPDX-License-Identifier: MIT
// SHA-256 (FIPS 180-4), by which an emitted file names the design file it came from.
#pragma once

#include <string>

namespace lqg::emit {

// 64 hexadecimal digits.
std::string sha256(const std::string& bytes);

}  // namespace lqg::emit
