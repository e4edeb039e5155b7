// SPDX-License-Identifier: MIT
#include "design/motion/starts.hpp"

#include <cmath>
#include <random>

#include "expression/evaluate.hpp"

namespace lqg::design {

namespace {

// All of them alike.
const double ladder[] = {0, 1, -1, 0.1, -0.1, 10, -10, 0.01, -0.01, 100, -100};
constexpr int mixed_starts = 16;

}  // namespace

std::vector<RealVector> starts_of(const WantedPoint& wanted, const RealVector& given,
                                  const std::vector<Index>& unknown) {
  std::vector<Index> open;
  RealVector first = given;
  for (const Index i : unknown) {
    const WantedPoint::Formula& start = wanted.starts[static_cast<std::size_t>(i)];
    if (start)
      first(i) = expression::Constants<Real>()(*start);
    else
      open.push_back(i);
  }
  if (open.empty()) return {first};
  std::vector<RealVector> starts;
  const bool are_many = open.size() > 8;
  for (const double value : ladder) {
    if (are_many && starts.size() >= 5) return starts;
    for (const Index i : open) first(i) = value;
    starts.push_back(first);
  }
  if (open.size() == 1) return starts;
  std::minstd_rand random(1);
  for (int k = 0; k < mixed_starts; ++k) {
    for (const Index i : open) {
      const double size = ladder[1 + random() % 10];
      first(i) = size * (1 + static_cast<double>(random() % 8) / 8);
    }
    starts.push_back(first);
  }
  return starts;
}

}  // namespace lqg::design
