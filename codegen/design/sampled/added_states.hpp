// SPDX-License-Identifier: MIT
// States that the filter has beside the plant's: [x; d; outputs on their way; inputs on their way].
//
//   d⁺ = d + its walk            x⁺ = A x + B (u + d),  y = C x + D (u + d): d acts where u acts, at once
//   y₁⁺ = C x + D u, y₂⁺ = y₁ …  an output that is q periods late is heard as y_q
//
// No input reaches d. The regulator is therefore that of the plant without it, for u + d: at rest u and all inputs on
// their way are −d.
#pragma once

#include "design/sampled/samples.hpp"

namespace lqg::design {

bool has_added_states(const Problem& problem);

// How many there are of each kind, and of both.
Index disturbance_count(const Problem& problem);
Index late_output_count(const Problem& problem);
Index added_states(const Problem& problem);

// The periods by which each output is late.
std::vector<Index> periods_of_outputs(const Plant& plant);

// The filter's problem: plant, noise and start with the disturbances, without a regulator.
Problem with_disturbances(const Problem& problem);

// `samples` of `problem`, or of with_disturbances(problem), behind late outputs.
Samples with_late_outputs(const Problem& problem, const Samples& samples);

// What the filter knows, of `filtered` = with_disturbances(problem); with the cost of the plant's `own` samples.
Samples filter_model(const Problem& problem, const Problem& filtered, const Samples& own);

// The law, and all that is over z, of the plant's own as those over the filter's model.
void add_states_to(const Problem& problem, RegulatorSolution& regulator);

// The plant without the disturbances: what a loop is closed around.
SampledPlant without_disturbances(const Problem& problem, const SampledPlant& plant);

// The plant of the file and its cost out of those over the filter's model. C of late outputs is 0 then.
SampledPlant without_added_states(const Problem& problem, const SampledPlant& plant);
SampledCost without_added_states(const Problem& problem, const SampledCost& cost);

}  // namespace lqg::design
