// SPDX-License-Identifier: MIT
// A formula's value and slopes at a point, in the digits in force, and where it has none.
#pragma once

#include <string>
#include <variant>

#include "design/numeric/linear_algebra.hpp"
#include "expression/dual.hpp"
#include "expression/tree.hpp"

namespace lqg::design {

using Slope = expression::Dual<Real>;

// Why a formula has no value or no slope at a point.
struct NoSlope {
  std::size_t at = 0;  // byte of its text
  std::string reason;  // "sqrt of a negative number"
};

// What holds where two branches of abs, min or max meet. `refuse`: their slopes have to be the same.
enum class Kinks { refuse, take_a_side };

// The slopes are those over all variables: `point` has their values.
std::variant<Slope, NoSlope> slope_of(const expression::Node& formula, const RealVector& point, Kinks kinks);

// Σ |∂f/∂c| |c| over the numbers c that stand in f, those of `point` among them, each time they do: what f changes by
// at most when each of them changes by one part of itself. 0 where f has no slope. Of a point where slope_of found one.
Real size_of_terms(const expression::Node& formula, const RealVector& point);

}  // namespace lqg::design
