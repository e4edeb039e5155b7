// SPDX-License-Identifier: MIT
// In doubles: the minima that several starts lead to.
#pragma once

#include <map>

#include "design/order/scaled_problem.hpp"

namespace lqg::design::order {

// What the starts of one order led to.
struct OrderMinima {
  std::vector<Point> minima;  // of different costs, the best one first
  double ease = 0;            // of none: the least that a start has reached
  Matrix<double> easiest;     // there
  int starts = 0;
  int reached = 0;  // of them that ended in the best one
};

// Keeps what it has found, because the minimum of an order is a start for the next ones.
class OrderSearch {
 public:
  explicit OrderSearch(OrderProblem scaled_problem);

  // From laws of full order, truncated; from minima of order − 1 with a weak mode added; from draws; from minima of
  // order + 1, truncated.
  OrderMinima minima(Index order);

 private:
  const OrderMinima& upwards(Index order);
  void start_from_laws(const Family& family, OrderMinima& found) const;
  void start_from_below(const Family& family, OrderMinima& found);

  OrderProblem problem_;
  std::vector<Matrix<double>> laws_;
  std::map<Index, OrderMinima> upwards_;
};

}  // namespace lqg::design::order
