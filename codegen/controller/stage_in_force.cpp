// SPDX-License-Identifier: MIT
#include "controller/stage_in_force.hpp"

namespace lqg::controller {

const design::StageSolution* stage_in_force(const design::Solution& solution, std::size_t sample) {
  const design::StageSolution* found = nullptr;
  for (const design::StageSolution& stage : solution.stages)
    if (static_cast<std::size_t>(stage.from) <= sample) found = &stage;
  return found;
}

const design::SampledPlant& plant_at(const Controller& controller, std::size_t sample) {
  const design::StageSolution* stage = controller.has.filter ? stage_in_force(controller.solution, sample) : nullptr;
  return stage ? stage->plant : controller.solution.plant;
}

const design::SampledNoise* noise_at(const Controller& controller, std::size_t sample) {
  const design::StageSolution* stage = stage_in_force(controller.solution, sample);
  const std::optional<design::SampledNoise>& noise = stage && stage->noise ? stage->noise : controller.solution.noise;
  return noise ? &*noise : nullptr;
}

const design::OnlineSolution& online_at(const Controller& controller, std::size_t sample) {
  const design::StageSolution* stage = stage_in_force(controller.solution, sample);
  return stage && stage->online ? *stage->online : *controller.solution.online;
}

const design::SampledPlant& kept_plant_at(const Controller& controller, std::size_t sample) {
  return controller.modal ? controller.modal->plant : plant_at(controller, sample);
}

const design::OnlineSolution& kept_online_at(const Controller& controller, std::size_t sample) {
  return controller.modal ? controller.modal->online : online_at(controller, sample);
}

design::RealVector kept_start(const Controller& controller) {
  if (controller.modal) return controller.modal->z0;
  return controller.x0.unaryExpr([](double value) { return design::Real(value); });
}

}  // namespace lqg::controller
