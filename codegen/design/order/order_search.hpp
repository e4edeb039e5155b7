// SPDX-License-Identifier: MIT
// The compensator of a given order with the least cost, also under white parameters.
#pragma once

#include <vector>

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

// What one white parameter γ adds to the plant: A + γ A₁, B + γ B₁, C + γ C₁ with E γ = 0, E γ² = 1, in each sample
// (second of a continuous plant: intensity) independent of all others.
// Where a compensator has feed-through, products of B₁ and C₁ enter: these γ are taken to be normal, E γ⁴ = 3.
struct WhiteParameter {
  RealMatrix A, B, C;  // nx × nx, nx × nu, ny × nx
};

// x⁺ = A x + B u + w, y = C x + v  (continuous: ẋ);  E[w wᵀ] = W, E[w vᵀ] = Swv, E[v vᵀ] = V;
// J = lim E[xᵀQx + 2xᵀNu + uᵀRu]. A feed-through of the plant is not in it: the compensator knows u.
struct OrderProblem {
  bool is_continuous = false;
  bool has_feedthrough = false;  // u = C z + D y (filter form, discrete only) instead of u = C z
  RealMatrix A, B, C;
  RealMatrix Q, N, R;
  RealMatrix W, Swv, V;
  std::vector<WhiteParameter> white;
};

enum class OrderFailure {
  none,
  no_stabilising_compensator,  // of that order was found
  not_converged,               // in the digits in force
  // The curvature off the orbit of similarities is not positive: most often, a lower order costs as little. Then the
  // matrices and the cost are those of a minimum in doubles.
  not_strict,
};

// z⁺ = A z + B y, u = C z + D y (D is 0 without feedthrough), in coordinates of no meaning.
struct OrderedCompensator {
  OrderFailure failure = OrderFailure::none;
  RealMatrix A, B, C, D;
  Real cost;             // J: a sample, or a second
  int starts = 0;        // that were tried
  int reached = 0;       // starts that ended in this minimum
  double curvature = 0;  // the smallest one off the orbit, relative to the largest
  double discount = 1;   // on failure: the largest g < 1 (continuous: −alpha) with which a compensator was found
};

// The best of several starts found in double, polished in the digits in force. Deterministic. Order 0 is a constant
// gain, u = D y, or without feed-through u = 0.
OrderedCompensator best_compensator(const OrderProblem& problem, int order);

// The same from a compensator that is near it already (the result of a coarser run).
OrderedCompensator polished_compensator(const OrderProblem& problem, const OrderedCompensator& start);

// best_compensator for each order from `lowest` to `highest`, in less time than one after the other.
std::vector<OrderedCompensator> best_compensators(const OrderProblem& problem, int lowest, int highest);

// u = −K x under white parameters: X = Q + E[AᵀXA] − (E[AᵀXB] + N)(R + E[BᵀXB])⁻¹(…)ᵀ (discrete only).
struct WhiteRegulator {
  bool exists = false;  // the plant can be stabilised in the mean square
  // By how much the second moments grow a sample, the spectral radius of their map: the least over all K, or where that
  // is below 1, of some K.
  double growth = 0;
  RealMatrix X, K;
};
WhiteRegulator white_regulator(const OrderProblem& problem);

}  // namespace lqg::design
