// SPDX-License-Identifier: MIT
// Noise that is the same on every host: no function of libm, no generator of a library.
#pragma once

#include <cstdint>

namespace lqg::simulate {

// Normal numbers as sums of twelve uniform ones, so that none is beyond ±6. The uniform ones are splitmix64's (G. L.
// Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  double uniform();  // in (−1/2, 1/2)
  double normal();   // mean 0, variance 1

 private:
  std::uint64_t state_;
};

// The seed of run `run` of many that belong to `seed`: streams of their own.
std::uint64_t seed_of_run(std::uint64_t seed, std::uint64_t run);

}  // namespace lqg::simulate
