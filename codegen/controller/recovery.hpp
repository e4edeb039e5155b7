// SPDX-License-Identifier: MIT
// In how many samples a controller is back to normal after a fault.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace lqg::controller {

struct Controller;

// After one fault that ends: a flipped bit of the state, a spike, a drop-out.
struct Recovery {
  long samples = 0;  // until every state is `within` of what it would be without the fault; 0: no number can be said
  Eigen::VectorXd
      within;  // nx: the standard deviation of the estimate in the steady state, or what is rounding beside its scale
  std::vector<int> lasting;  // states that no noise reaches and that do not die out: what a fault leaves there stays
};

// Of a controller with a filter, whose gains, bounds and gate are there. It is the sum of
//   what the gate needs to let everything in again, and an error as large as a bound to die out in the filter;
//   where P is carried, what an error dies out in once more: P settles first; where gains are scheduled, their samples;
//   where u has limits, the first once more: as long as u was wrong it may be at its limit on the way back;
//   what the closed loop needs to bring back a plant that was driven as far as a bound.
// All in the steady state, of the last stage. It is rounded up to two digits.
Recovery recovery_of(const Controller& controller);

}  // namespace lqg::controller
