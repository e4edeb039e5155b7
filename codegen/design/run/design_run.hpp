// SPDX-License-Identifier: MIT
// One run of the whole design in the digits in force.
#pragma once

#include "design/equations/placement.hpp"
#include "design/finding.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/order/order_search.hpp"
#include "design/sampled/stages.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// What the numbers of a Solution are before Ziv's test has passed. Its poles, costs and margins are still empty.
struct DesignRun {
  Solution solution;
  std::vector<SampledStage> stages;  // what it is of
  std::vector<ComplexReal> regulator_poles, estimator_poles, loop_poles;
  std::optional<RegulatorSolution> own_law;                           // over the plant's own states alone
  std::optional<PlacementChoice> regulator_choice, estimator_choice;  // of placed poles
  RealMatrix filter_riccati;                                          // the solution that the steady gain is made of
  std::optional<EstimatorSolution> full_filter;                       // without the structure that its gain has
  std::optional<Real> cost_per_sample, cost_per_second;
  std::optional<OrderedCompensator> ordered;   // as the search left it
  RealMatrix compensator_form;                 // from its z to that of the solution
  std::vector<ComplexReal> compensator_poles;  // by itself
  std::optional<Real> full_cost;               // of LQG without white parameters, per sample or second
  RealMatrix unaware_riccati;                  // X of a regulator alone without white parameters
  bool has_steady_loop = false;                // stable, with margins
  Findings findings;                           // with an error: the rest is not complete
  bool may_want_digits = false;                // the error may be one of too few digits
};

// `coarser` is a run with fewer digits and without errors to start from, or null.
DesignRun run_design(const Problem& problem, const DesignRun* coarser);

}  // namespace lqg::design
