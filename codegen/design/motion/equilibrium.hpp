// SPDX-License-Identifier: MIT
// Where a plant is at rest.
#pragma once

#include <optional>
#include <vector>

#include "design/numeric/linear_algebra.hpp"
#include "design/problem.hpp"

namespace lqg::design {

// What has to be 0: f of each of these states, or f − x of a discrete plant.
class Rest {
 public:
  // The plant has to outlive it.
  Rest(const Plant& plant, std::vector<Index> states) : plant_(plant), states_(std::move(states)) {}

  struct At {
    RealVector value;
    RealMatrix slopes;  // over states and inputs
  };
  // Nothing where one of them has no value.
  std::optional<At> at(const RealVector& point) const;
  // What they are made of: see size_of_terms; 1 where that is 0. Of a point where they have values.
  RealVector sizes(const RealVector& point) const;
  const std::vector<Index>& states() const { return states_; }

 private:
  const Plant& plant_;
  std::vector<Index> states_;
};

// From `point` on, moving the `unknown` ones of its numbers alone, by Levenberg's and Marquardt's method: where the sum
// of squares, each in units of its size, falls no more. Nothing where there is no value at the point itself.
std::optional<RealVector> descended(const Rest& rest, RealVector point, const std::vector<Index>& unknown);

// By Gauss's and Newton's method from nearby, to all digits in force. Nothing where that takes long: where the
// equations touch 0 and do not pass through it.
std::optional<RealVector> polished(const Rest& rest, RealVector point, const std::vector<Index>& unknown);

// All of them are 0 but for the rounding of the numbers that they are made of.
bool is_at_rest(const Rest& rest, const RealVector& point);

// Those of `unknown` that can be moved, alone or together, without moving any of the equations: a set of each
// direction in which that is so.
std::vector<Index> undetermined(const Rest& rest, const RealVector& point, const std::vector<Index>& unknown);

}  // namespace lqg::design
