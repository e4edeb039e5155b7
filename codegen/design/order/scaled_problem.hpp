// SPDX-License-Identifier: MIT
// The problem in units in which its states, inputs, outputs and its cost are about 1, and full-order laws for it.
#pragma once

#include "design/order/descent.hpp"
#include "design/order/order_search.hpp"

namespace lqg::design::order {

// Powers of two, so that scaling is exact: x = x_unit x_scaled and so on, J = cost_unit J_scaled.
struct Units {
  Eigen::VectorXd x, u, y;
  double cost = 1;
};

struct ScaledProblem {
  OrderProblem problem;
  Units units;
};
ScaledProblem scaled(const OrderProblem& problem);

// Θ of the LQG compensator without white parameters for weights R and V that are `inputs` and `outputs` times as large,
// in balanced coordinates, the states that matter least first. Empty where there is none.
std::optional<Matrix<double>> full_order_law(const OrderProblem& problem, double inputs, double outputs);

// The law in balanced coordinates with only the last `order` of its states.
Matrix<double> truncated(const Family& family, const Matrix<double>& law, Index order);

OrderProblem without_white(OrderProblem problem);
OrderProblem in_present_digits(const OrderProblem& problem);

RealMatrix in_units(const Units& units, const RealMatrix& Theta);    // Θ of the given problem
RealMatrix from_units(const Units& units, const RealMatrix& Theta);  // and back

}  // namespace lqg::design::order
