// SPDX-License-Identifier: MIT
// How far a state or an innovation may be before no honest one is there.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace lqg::controller {

struct Controller;

// All of them powers of two, so that scaling by one is exact; src/README.md has the derivation. Empty without a filter.
struct Bounds {
  std::vector<int> x, xi;             // |x_i| < 2^x_i, |P_ii| < 4^x_i, of what the filter keeps; |ξ_i| < 2^xi_i
  Eigen::VectorXd innovation, error;  // of each output that the filter takes; of each r − y that is integrated
};

// Of a controller whose gains are there.
Bounds bounds_of(const Controller& controller);

// Whether the law asks for finite inputs whenever x̂ is within its bounds and r is finite. Whether ξ or the last input
// are within theirs is not known before predict: a law of them may ask for anything.
bool has_finite_law(const Controller& controller);

// 2^exponents
std::vector<double> powers_of_two(const std::vector<int>& exponents);

}  // namespace lqg::controller
