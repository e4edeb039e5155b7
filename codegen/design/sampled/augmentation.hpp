// SPDX-License-Identifier: MIT
// What the regulator regulates: the plant's state, and the integrals and the last input where the design has them.
#pragma once

#include "design/equations/riccati.hpp"
#include "design/finding.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

// z = [x; ξ; u[k−1]], driven by v: u, or Δu with `input_rate`.
//   ξ⁺ = ξ − T (C_i x + D_i u),   x⁺ = A x + B u,   u = u[k−1] + Δu
struct RegulatedPlant {
  RealMatrix A, B;
};

RegulatedPlant regulated_plant(const Problem& problem, const SampledPlant& plant);

// `cost` over x and u, as one over z and v: with ξᵀQ_iξ a sample (T Q_i where the cost is an integral: ξ is held) and
// Δuᵀ S Δu.
SampledCost regulated_cost(const Problem& problem, const SampledCost& cost);

// α of the pincer procedure, 1 without it: K is optimal for αA, αB. Of a continuous cost: for A + αI, 0 without it.
// (B. D. O. Anderson, J. B. Moore, "Optimal Control: Linear Quadratic Methods", 1990, section 3.5.)
Real decay_of(const Problem& problem);

// The equation that K solves: discrete over z; of cost = "continuous" the continuous one, ξ' = −(C_i x + D_i u).
RiccatiEquation regulator_equation(const Problem& problem, const Samples& samples);

// Can inputs hold these outputs anywhere: has [A − I  B; C  D] full row rank, of the rows of C and D in `outputs`? If
// not, says why under `key`.
void check_set_points(const SampledPlant& plant, const std::vector<int>& outputs, const std::string& key,
                      Findings& findings);

RealMatrix rows_of(const RealMatrix& from, const std::vector<int>& rows);

}  // namespace lqg::design
