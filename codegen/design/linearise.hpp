// SPDX-License-Identifier: MIT
// From the equations of a plant to its matrices about an operating point.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/real.hpp"

namespace lqg::design {

// Where a plant is linearised, in its own units; formulas without variables.
struct WantedPoint {
  using Formula = std::shared_ptr<const expression::Node>;
  std::vector<Formula> values;  // of the nx states, then of the nu inputs; none: to be found
  std::vector<Formula> starts;  // where looking for it begins; none: anywhere. As many as values
  std::vector<bool> is_steady;  // nx: ẋ of that state has to be 0, or x⁺ to be x
};

// In many digits, more than any run of the design has.
struct Linearisation {
  RealMatrix A, B, C, D;
  RealVector x, u, y;
};

// Nothing, and why, where f is not 0 at the point or cannot be, where what is to be found is not determined, and where
// f or h has no slope. Of `plant` the domain, the names and the equations are read.
std::optional<Linearisation> linearise(const Plant& plant, const WantedPoint& point, Findings& findings);

}  // namespace lqg::design
