// SPDX-License-Identifier: MIT
// The controller as one linear system in numbers z of its own: fewer operations than x̂ takes.
#pragma once

#include <string>

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// z⁺ = A z + B y,  u = C z + D y.  T z is s = [x̂⁻; u[k−1] where the filter form needs it for D], so that all that the
// physical form knows can be had from z. All numbers are settled: they round correctly.
struct LinearForm {
  RealMatrix A, B, C, D;
  RealMatrix T;                // s = T z
  RealMatrix expected;         // C x̂⁻ + D u = `expected` z: what the outputs should be
  RealMatrix estimate, heard;  // x̂ = `estimate` z + `heard` y, of which u = −K x̂ is made
  RealMatrix of_state, keep;   // z of a state x that is set by hand: `of_state` x + `keep` z; without u[k−1] no keep
  RealMatrix z0;               // of x0, nothing applied yet
  double condition = 1;        // by how much the answers of its modes cancel, see modal_form
};

// Why the design has no such form; empty: it has. There is one system for ever with constant gains of a regulator and
// an estimator, without limits, gate and stages, and without a law that remembers or follows a reference. And its own
// poles must be stable: it does not hear when u is not applied as it is, and what comes of that has to die out.
std::string no_linear_form(const Problem& problem, const Solution& solution);

// A form, or why the design cannot have it.
struct LinearFormResult {
  std::optional<LinearForm> form;
  std::string obstacle;
};

// z = s: A, B, C, D of the compensator multiplied out. no_linear_form() is empty; likewise below.
LinearFormResult folded_form(const Problem& problem, const Solution& solution);

// A has the blocks of modal_basis(). What freedom they leave makes the largest row of a block's C [1] or [1 0]: this
// part of u takes no multiplication. Where poles come near each other their modes become large and cancel. The
// condition says by how much: with the Euclidean norms of answers to an impulse of y_j,
//   (Σ ‖part of a mode in u_i‖ + |D_ij|) / ‖u_i‖,
// for the worst i and j, likewise for x̂. Refused beyond 1/√ε of the target's numbers, half of their digits.
LinearFormResult modal_form(const Problem& problem, const Solution& solution);

// Replaces solution.loop.rounded by what becomes of the loop when the target holds the numbers of `form`; errors and
// notes are those of check_rounded().
void check_rounded_form(const Problem& problem, const LinearForm& form, Solution& solution, Findings& findings);

}  // namespace lqg::design
