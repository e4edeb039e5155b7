// SPDX-License-Identifier: MIT
// `lqgen --orders`: what each state of a compensator is worth.
#pragma once

#include <string>

#include "design/orders.hpp"

namespace lqg::commands {

// A line for each order: its cost, and how much that is above the cost of the full order, which the last line has.
std::string table_of_orders(const design::CostsOfOrders& orders);

}  // namespace lqg::commands
