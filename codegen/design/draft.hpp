// One run of the whole design in the digits in force.
#pragma once

#include "design/linear_algebra.hpp"
#include "design/placement.hpp"
#include "design/solution.hpp"
#include "design/stages.hpp"

namespace lqg::design {

// What the numbers of a Solution are before they are settled. Its poles, costs and margins are still empty.
struct Draft {
  Solution solution;
  std::vector<SampledStage> stages;  // what it was drafted from
  std::vector<ComplexReal> regulator_poles, estimator_poles, loop_poles;
  std::optional<PlacementChoice> regulator_choice, estimator_choice;  // of placed poles
  std::optional<EstimatorSolution> full_filter;  // without the structure that its gain has
  std::optional<Real> cost_per_sample, cost_per_second;
  bool has_steady_loop = false;  // stable, with margins
  Findings findings;             // with an error: the rest is not complete
  bool may_want_digits = false;  // the error may be one of too few digits
};

// `coarser` is a run with fewer digits and without errors to start from, or null.
Draft draft(const Problem& problem, const Draft* coarser);

}  // namespace lqg::design
