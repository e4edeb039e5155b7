// SPDX-License-Identifier: MIT
#include "design/order/order_search.hpp"

#include "design/order/polish.hpp"
#include "design/order/scaled_problem.hpp"
#include "design/order/search.hpp"

namespace lqg::design {

namespace {

RealMatrix theta_of(const OrderedCompensator& c) { return above(beside(c.D, c.C), beside(c.B, c.A)); }

// Θ and cost, in the units of the problem, into the result.
void take(const order::Polished& polished, const order::Units& units, Index nu, Index ny, OrderedCompensator& result) {
  result.failure = polished.failure;
  result.curvature = polished.curvature;
  result.cost = polished.cost * Real(units.cost);
  const RealMatrix Theta = order::in_units(units, polished.Theta);
  const Index order = Theta.rows() - nu;
  result.D = Theta.topLeftCorner(nu, ny);
  result.C = Theta.topRightCorner(nu, order);
  result.B = Theta.bottomLeftCorner(order, ny);
  result.A = Theta.bottomRightCorner(order, order);
}

OrderedCompensator found_by(order::OrderSearch& search, const order::ScaledProblem& scaled, Index order) {
  const order::OrderMinima found = search.minima(order);
  OrderedCompensator result;
  result.starts = found.starts;
  result.reached = found.reached;
  if (found.minima.empty()) {
    result.failure = OrderFailure::no_stabilising_compensator;
    result.discount = scaled.problem.is_continuous ? -found.ease : 1 / ((1 + found.ease) * (1 + found.ease));
    return result;
  }
  const order::Family family = order::loop_family<double>(scaled.problem, order);
  const RealMatrix Theta = real(order::balanced(family, found.minima.front()));
  take(order::polished(scaled.problem, order, Theta), scaled.units, scaled.problem.B.cols(), scaled.problem.C.rows(),
       result);
  return result;
}

}  // namespace

OrderedCompensator best_compensator(const OrderProblem& problem, int order) {
  const order::ScaledProblem scaled = order::scaled(problem);
  order::OrderSearch search(scaled.problem);
  return found_by(search, scaled, order);
}

std::vector<OrderedCompensator> best_compensators(const OrderProblem& problem, int lowest, int highest) {
  const order::ScaledProblem scaled = order::scaled(problem);
  order::OrderSearch search(scaled.problem);
  std::vector<OrderedCompensator> result;
  for (int order = lowest; order <= highest; ++order) result.push_back(found_by(search, scaled, order));
  return result;
}

OrderedCompensator polished_compensator(const OrderProblem& problem, const OrderedCompensator& start) {
  const order::ScaledProblem scaled = order::scaled(problem);
  const RealMatrix Theta = order::from_units(scaled.units, in_present_digits(theta_of(start)));
  OrderedCompensator result = start;
  take(order::polished(scaled.problem, start.A.rows(), Theta), scaled.units, problem.B.cols(), problem.C.rows(),
       result);
  return result;
}

}  // namespace lqg::design
