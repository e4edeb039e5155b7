// SPDX-License-Identifier: MIT
// Chance for the tests: the same on every host, as the standard fixes the generator.
#pragma once

#include <cstdint>
#include <cstring>
#include <random>

namespace lqg_test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  std::uint64_t bits() { return bits_(); }
  int below(int count) { return static_cast<int>(bits_() % static_cast<std::uint64_t>(count)); }
  int between(int least, int most) { return least + below(most - least + 1); }
  bool one_in(int count) { return below(count) == 0; }
  // In [−1, 1).
  double uniform() { return static_cast<double>(bits_() >> 11) / 4503599627370496.0 - 1; }
  // Mean 0, variance 1.
  double normal() {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += uniform() / 2;
    return sum;
  }
  // Any bit pattern: subnormal, huge, infinite, NaN.
  template <class T>
  T pattern() {
    const std::uint64_t bits = bits_();
    T value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace lqg_test
