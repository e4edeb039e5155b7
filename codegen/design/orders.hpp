// SPDX-License-Identifier: MIT
// What each state of a compensator is worth: the least cost of each order.
#pragma once

#include <optional>
#include <vector>

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/progress.hpp"

namespace lqg::design {

struct CostOfOrder {
  int order = 0;
  std::optional<double> cost;  // empty: no compensator of that order was found that stabilises the plant
  int starts = 0, reached = 0;
  bool is_unstable = false;  // by itself
};

struct CostsOfOrders {
  bool is_per_second = false;      // of a continuous cost
  std::vector<CostOfOrder> costs;  // of order 1, 2, … to that of the plant
};

// Whatever compensator.order is. Needs [lqr] and [kalman]; empty, with errors in `findings`, where the problem is none
// that a compensator can be designed for.
std::optional<CostsOfOrders> costs_of_orders(const Problem& problem, Findings& findings, const Progress& progress = {});

}  // namespace lqg::design
