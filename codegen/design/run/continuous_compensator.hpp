// SPDX-License-Identifier: MIT
// The compensator of a continuous cost: ż = A z + B y, u = C z around the continuous plant.
#pragma once

#include "design/loop/compensator.hpp"
#include "design/order/order_search.hpp"

namespace lqg::design {

// Of the file's plant, weights and densities.
OrderProblem continuous_order_problem(const Problem& problem);

// Over y, in which D u of the plant is.
Compensator over_outputs(const Problem& problem, const OrderedCompensator& found);

// Sampled exactly, with y held: z⁺ = e^(AT) z + ∫₀ᵀ e^(As) ds B y.
Compensator held_compensator(const Problem& problem, const Compensator& continuous);

// A second of the LQG design without sampling: tr(P Q) + tr(X L V Lᵀ). Empty where it is not known.
std::optional<Real> cost_of_continuous_lqg(const Problem& problem, const Solution& solution);

}  // namespace lqg::design
