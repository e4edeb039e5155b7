// What the design's noises make of u.
#pragma once

#include "design/loop/compensator.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

// √E[uᵢ²] of a stable loop around the plant of `samples`, which have a noise; in double, to a few digits.
Eigen::VectorXd rms_of_inputs(const Problem& problem, const Samples& samples, const Compensator& controller);

}  // namespace lqg::design
