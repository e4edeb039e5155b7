// SPDX-License-Identifier: MIT
#include "simulate/noise.hpp"

namespace lqg::simulate {

namespace {

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

}  // namespace

std::uint64_t seed_of_run(std::uint64_t seed, std::uint64_t run) { return mixed(mixed(seed + golden) + run * golden); }

double Noise::uniform() {
  state_ += golden;
  const std::uint64_t z = mixed(state_);
  return (static_cast<double>(z >> 11) + 0.5) / 9007199254740992.0 - 0.5;
}

double Noise::normal() {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum;
}

}  // namespace lqg::simulate
