// SPDX-License-Identifier: MIT
// What a law needs to foresee limits: how the limited quantities follow from the state and from what is added to the
// law, in many digits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/numeric/linear_algebra.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// z = c x + d u, or its change since the sample before, in every block's first sample within [low, high] in units of z;
// infinite where there is none. With a price p the excess e adds p e² to J, without one there is none.
struct LimitedQuantity {
  RealMatrix c, d;  // 1 × nx, 1 × nu
  bool is_change = false;
  Real low, high;
  std::optional<Real> price;
  std::string name = {};
};

// x⁺ = A x + B u, u = −K x + v; J = x₀ᵀXx₀ + Σ vᵀ weight v, weight = R + BᵀXB. v is held over each block of samples and
// 0 after the last. u is limited in every block's first sample: its size hard; its change hard in the first sample of
// all, where the target narrows the size by it, and at `step_price` later.
struct LimitedProblem {
  RealMatrix A, B, K, weight;
  std::vector<int> blocks;  // lengths, ≥ 1
  RealVector u_min, u_max;  // nu, infinite where there is none
  RealVector u_step;        // nu, largest |u[k] − u[k−1]|, infinite where there is none; or empty
  RealVector step_price;    // nu, > 0; not looked at without u_step
  std::vector<LimitedQuantity> quantities;
  Real tolerance;     // of a limit, as a share of its range
  Real softening;     // on the diagonal of G of hard rows, as a share of it
  Real softness = 0;  // likewise of soft rows, at least: with less the target takes them for rows that others make up
  Real decay = 1;     // α: J = x₀ᵀXx₀ + Σ α²ᵏ vᵀ weight v
  std::vector<std::string> inputs = {};  // names, or none
};

// The lengths of blocks of a horizon in samples: single steps where changes or quantities are limited, else 1, 1, 2,
// 4, 4, 8, 8 … and what is left.
std::vector<int> default_blocks(int horizon, bool has_single_steps);

// In the digits in force. Empty where `weight` is not positive definite.
std::optional<LimitedRows> limited_rows(const LimitedProblem& problem);

// Whether each number is settled beside one of a run with fewer digits; see ziv_test.hpp.
bool passes_ziv_test(const LimitedRows& coarse, LimitedRows& fine, unsigned coarse_digits);

}  // namespace lqg::design
