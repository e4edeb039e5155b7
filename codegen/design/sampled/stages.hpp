// SPDX-License-Identifier: MIT
// A problem whose plant, weights and noise change at given steps.
#pragma once

#include <vector>

#include "design/sampled/samples.hpp"

namespace lqg::design {

// From step `from` on. What the filter knows, the plant that is there and the one that the regulator was made for
// differ only where states are added.
struct SampledStage {
  int from = 0;
  Problem problem;                          // with what this stage and those before it replace
  Samples samples;                          // of the filter's model
  std::optional<Problem> filtered;          // the filter's problem, with the disturbances in its plant
  std::optional<Samples> own, surrounding;  // of the file's plant; of that plant behind its late outputs

  const Problem& of_filter() const { return filtered ? *filtered : problem; }
  const Samples& of_regulator() const { return own ? *own : samples; }
  const Samples& of_loop() const { return surrounding ? *surrounding : samples; }
};

// `problem` as it is before the first stage, and from each stage on: a stage replaces what it has, and keeps from the
// stage before what it leaves out.
std::vector<Problem> problems_of_stages(const Problem& problem);

// The first one begins at step 0; one alone without [[stage]].
std::vector<SampledStage> sample_stages(const Problem& problem);

// The stage of step k.
const SampledStage& stage_at(const std::vector<SampledStage>& stages, int k);

// The step from which on nothing changes.
inline int last_change(const std::vector<SampledStage>& stages) { return stages.back().from; }

}  // namespace lqg::design
