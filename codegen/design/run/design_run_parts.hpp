// SPDX-License-Identifier: MIT
// The halves of a run, from the problem's stages at their samples.
#pragma once

#include "design/equations/riccati.hpp"
#include "design/run/design_run.hpp"

namespace lqg::design {

// Each fills its part of `result`, or says in result.findings why there is none.
void run_regulator(const Problem& problem, const std::vector<SampledStage>& stages, const DesignRun* coarser,
                   DesignRun& result);
void run_estimator(const Problem& problem, const std::vector<SampledStage>& stages, const DesignRun* coarser,
                   DesignRun& result);

// The rows of limits that are foreseen with the law that was found.
void run_limits(const Problem& problem, const Samples& samples, DesignRun& result);

bool is_stable(const std::vector<ComplexReal>& poles);

// Keeps the condition of the worst equation.
void take_condition(const RiccatiResult& result, Solution& solution);

}  // namespace lqg::design
