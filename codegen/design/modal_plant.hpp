// SPDX-License-Identifier: MIT
// The plant of a filter that carries P in the coordinates of its modes: A of blocks, C of ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// x = T z. The filter runs on this plant as it does on that of x: the same innovations, the same u, T P Tᵀ for P.
// Inputs on their way keep their coordinates. All numbers are settled: they round correctly.
struct ModalPlant {
  RealMatrix T, inverse;               // z = `inverse` x
  SampledPlant plant;                  // T⁻¹ A T, T⁻¹ B, C T, D, T⁻¹ G
  OnlineSolution online;               // of these; U0 and D0 only where P is carried in them
  RealMatrix K;                        // of the regulator, whose columns of x are K T; empty without one
  std::vector<RealMatrix> K_schedule;  // likewise
  RealMatrix z0;                       // of x0: nx × 1
  double condition = 1;                // see modal_plant
  double agreement = 0;                // digits in which A T = T Λ, Λ the blocks, and T⁻¹ T = 1
};

// Why the design's filter has no such coordinates whatever its numbers are; empty: it may have. It carries P, of one
// plant. What forbids a linear form does not forbid these: nothing is folded, limits and gates see the same numbers.
std::string no_modal_plant(const Problem& problem);

// The coordinates, or why the design cannot have them.
struct ModalPlantResult {
  std::optional<ModalPlant> modal;
  std::string obstacle;
};

// Of the plant's own states A has the blocks of modal_basis(). What freedom they leave makes the largest row of a
// block's C [1] or [1 0], as the filter takes the outputs: P Cᵀ is then a sum. Where poles of the plant come near each
// other T becomes singular. The condition says how much: ρ(|T⁻¹| |T|), the least of ‖D⁻¹ T⁻¹ E⁻¹‖ ‖E T D‖ over all
// units D and E (F. L. Bauer, "Optimally scaled matrices", Numerische Mathematik 5, 1963, 73–87). Refused beyond 1/√ε
// of the target's numbers, half of their digits, where the target would lose the plant or a variance, and where T is
// not found in half of the digits of the design. no_modal_plant() is empty; likewise below.
ModalPlantResult modal_plant(const Problem& problem, const Solution& solution);

// Replaces solution.loop.rounded, where it is there, by what becomes of the loop when the target holds the numbers of
// `modal`; errors and notes are those of check_rounded().
void check_rounded_modes(const Problem& problem, const ModalPlant& modal, Solution& solution, Findings& findings);

}  // namespace lqg::design
