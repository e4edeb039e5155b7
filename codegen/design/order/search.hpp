// SPDX-License-Identifier: MIT
// In doubles: the best minimum that several starts lead to.
#pragma once

#include <map>

#include "design/order/scaled_problem.hpp"

namespace lqg::design::order {

struct OrderBest {
  Point point;           // stable where there is a minimum
  double ease = 0;       // else the least that a start has reached
  Matrix<double> Theta;  // that one's
  int starts = 0, reached = 0;
};

// Keeps what it has found, because the minimum of an order is a start for the next ones.
class OrderSearch {
 public:
  explicit OrderSearch(const OrderProblem& scaled_problem);

  // From laws of full order, truncated; from the best of order − 1 with a weak mode added; from the best of order + 1,
  // truncated.
  OrderBest best(Index order);

 private:
  struct Ends;

  const OrderBest& upwards(Index order);
  void try_start(const Family& family, const Matrix<double>& Theta, Ends& ends) const;
  void start_from_laws(const Family& family, Ends& ends) const;
  void start_from_below(const Family& family, Ends& ends);

  OrderProblem problem_;
  std::vector<Matrix<double>> laws_;
  std::map<Index, OrderBest> upwards_;
};

}  // namespace lqg::design::order
