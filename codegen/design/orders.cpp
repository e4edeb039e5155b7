// SPDX-License-Identifier: MIT
#include "design/orders.hpp"

#include "design/numeric/modes.hpp"
#include "design/rounding.hpp"
#include "design/run/continuous_compensator.hpp"
#include "design/run/white_parameters.hpp"
#include "design/sampled/stages.hpp"
#include "design/solve.hpp"

namespace lqg::design {

namespace {

constexpr unsigned digits_of_orders = 50;

Problem with_some_order(Problem problem) {
  problem.compensator = Order{1};
  return problem;
}

bool has_unstable_pole(const RealMatrix& A, bool is_continuous) {
  for (const ComplexReal& pole : eigenvalues(A))
    if (is_continuous ? pole.re >= 0 : on_or_outside_circle(pole)) return true;
  return false;
}

CostOfOrder cost_of(const OrderedCompensator& found, int order, bool is_continuous) {
  CostOfOrder result;
  result.order = order, result.starts = found.starts;
  if (found.failure == OrderFailure::no_stabilising_compensator || found.failure == OrderFailure::not_converged)
    return result;
  result.cost = to_double(found.cost), result.reached = found.reached;
  result.is_unstable = has_unstable_pole(found.A, is_continuous);
  return result;
}

}  // namespace

std::optional<CostsOfOrders> costs_of_orders(const Problem& problem, Findings& findings, const Progress& progress) {
  const Digits scope(digits_of_orders);
  const Problem asked = with_some_order(problem);
  if (!is_well_posed(asked, findings)) return std::nullopt;
  const ProgressScope reporting(progress);
  CostsOfOrders result;
  result.is_per_second = asked.regulator->cost == Cost::continuous;
  const OrderProblem order = result.is_per_second ? continuous_order_problem(asked)
                                                  : order_problem(asked, sample_stages(asked).back().of_loop());
  const int most = static_cast<int>(order.A.rows());
  const std::vector<OrderedCompensator> found = best_compensators(order, 1, most);
  for (std::size_t i = 0; i < found.size(); ++i)
    result.costs.push_back(cost_of(found[i], static_cast<int>(i) + 1, result.is_per_second));
  return result;
}

}  // namespace lqg::design
