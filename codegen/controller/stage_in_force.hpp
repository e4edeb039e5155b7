// SPDX-License-Identifier: MIT
// What is in force in a sample of a design with stages.
#pragma once

#include "controller/controller.hpp"

namespace lqg::controller {

// The stage, by the one rule of all: the last whose `from` is not after `sample`; nullptr: before the first.
const design::StageSolution* stage_in_force(const design::Solution& solution, std::size_t sample);

// What the filter is told of: without a filter the plant of the beginning.
const design::SampledPlant& plant_at(const Controller& controller, std::size_t sample);
// nullptr: an observer, which knows of none.
const design::SampledNoise* noise_at(const Controller& controller, std::size_t sample);
// Of a filter that carries its covariance.
const design::OnlineSolution& online_at(const Controller& controller, std::size_t sample);

// What the filter runs on: of a filter that keeps z those of z, else those above, and x0 as they have it.
const design::SampledPlant& kept_plant_at(const Controller& controller, std::size_t sample);
const design::OnlineSolution& kept_online_at(const Controller& controller, std::size_t sample);
design::RealVector kept_start(const Controller& controller);

}  // namespace lqg::controller
