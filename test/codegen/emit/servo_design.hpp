// SPDX-License-Identifier: MIT
// Controllers whose law has a memory, made by hand: their gains are simple numbers, not optimal ones.
#pragma once

#include <functional>

#include "emit/controller.hpp"
#include "design_text.hpp"

namespace lqg_test {

lqg::design::RealMatrix matrix(std::initializer_list<std::initializer_list<double>> rows);

// Solves `design`, lets `change` write into problem and solution what the engine would have found, and makes the
// controller anew; the test fails when it is refused.
lqg::emit::Controller changed(const DesignText& design,
                              const std::function<void(lqg::design::Problem&, lqg::design::Solution&)>& change);

// Limits that a reference of 1 reaches.
DesignText limited_double_integrator();

// u = −4 x − 3 v + 2 ξ, ξ the integral of r − position: poles near −1 and −1 ± i in the s plane.
void integrate_position(lqg::design::Problem& problem, lqg::design::Solution& solution);

// The change of u is −0.4 x − 0.6 v + 0.1 ξ − 0.4 u: four poles near −1.
void weigh_changes(lqg::design::Problem& problem, lqg::design::Solution& solution);

// The position follows r by feed-forward of a gain of 4.
void track_position(lqg::design::Problem& problem, lqg::design::Solution& solution);

// Two inputs on their way behind position and speed.
void delay_input(lqg::design::Problem& problem, lqg::design::Solution& solution);

}  // namespace lqg_test
