// SPDX-License-Identifier: MIT
// A minimum in all digits, from one in doubles.
#pragma once

#include "design/order/descent.hpp"

namespace lqg::design::order {

struct Polished {
  OrderFailure failure = OrderFailure::none;
  RealMatrix Theta;
  Real cost;
  double curvature = 0;  // the smallest one across the orbit, relative to the largest
};

// Θ ← Θ − H⁺ ∂J/∂Θ with the gradient in all digits. H⁺ is the inverse of the Hessian on what is orthogonal to the orbit
// of similarities; it is kept in doubles, so that each step brings about as many digits as it has. Where that is not
// enough, it is taken in more digits. The problem in units of its own (see scaled_problem.hpp), Θ near a minimum.
Polished polished(const OrderProblem& problem, Index order, const RealMatrix& Theta);

}  // namespace lqg::design::order
