// SPDX-License-Identifier: MIT
// Problems for compensators of a given order.
#pragma once

#include "design/order/order_search.hpp"
#include "problems.hpp"

namespace design_test {

using lqg::design::OrderProblem;

// Unit weights and noise, no cross terms.
OrderProblem unit_problem(bool is_continuous, const RealMatrix& A, const RealMatrix& B, const RealMatrix& C);

// Random, with poles within 0.8 of the origin; continuous: with real parts below −0.2.
OrderProblem stable_plant(bool is_continuous, Eigen::Index nx, Eigen::Index nu, Eigen::Index ny, std::uint64_t seed);

// Random, 2 to 4 states, one or two inputs and outputs, a spectral radius of 0.8 to 1.15.
OrderProblem unstable_plant(std::uint64_t seed);

// Two, the first one with A, B and C, the second one with B and C.
void add_white_parameters(OrderProblem& problem, std::uint64_t seed);

// The plants of order_reference.py, in decimal numbers.
OrderProblem third_order_reference(bool has_feedthrough);
OrderProblem white_reference(bool has_feedthrough);
OrderProblem moving_reference(bool is_white);

// Six masses in a chain between two walls, driven at one end, seen at the other one, every 0.5 s.
OrderProblem six_masses();

}  // namespace design_test
