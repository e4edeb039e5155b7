// The halves of a draft, from the problem's stages at their samples.
#pragma once

#include "design/draft.hpp"
#include "design/riccati.hpp"

namespace lqg::design {

// Each fills its part of `result`, or says in result.findings why there is none.
void draft_regulator(const Problem& problem, const std::vector<SampledStage>& stages, const Draft* coarser,
                     Draft& result);
void draft_estimator(const Problem& problem, const std::vector<SampledStage>& stages, const Draft* coarser,
                     Draft& result);

bool is_stable(const std::vector<ComplexReal>& poles);

// Keeps the condition of the worst equation.
void take_condition(const RiccatiResult& result, Solution& solution);

}  // namespace lqg::design
