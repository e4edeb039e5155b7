// SPDX-License-Identifier: MIT
// Sizes that the figures of a controller are made of, in bytes or numbers.
#pragma once

#include "controller/controller.hpp"

namespace lqg::emit {

inline long bytes_of_real(const Controller& controller) { return controller.target.is_double ? 8 : 4; }

// What a target keeps of a symmetric n × n matrix.
inline long triangle(long n) { return n * (n + 1) / 2; }

// A stack keeps its pointer at multiples of 8 bytes.
inline long aligned(long bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace lqg::emit
