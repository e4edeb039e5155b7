// SPDX-License-Identifier: MIT
#include "simulate/plant.hpp"

#include "controller/stage_in_force.hpp"
#include "design/rounding.hpp"
#include "simulate/period.hpp"

namespace lqg::simulate {

using Eigen::Index;
using Eigen::VectorXd;

Plant::Stage Plant::stage_of(const Controller& controller, std::size_t from, PlantNoise noise) {
  const design::StageSolution* stage = controller::stage_in_force(controller.solution, from);
  const design::SampledPlant& plant = stage ? stage->plant : controller.solution.plant;
  Stage result;
  result.from = from;
  result.A = design::to_doubles(plant.A);
  result.B = design::to_doubles(plant.B);
  result.C = design::to_doubles(plant.C);
  result.D = design::to_doubles(plant.D);
  result.noise_factor = noise_factor(controller, from, noise);
  if (const design::SampledCost* cost = sampled_cost(controller, from)) {
    result.Q = design::to_doubles(cost->Q);
    result.R = design::to_doubles(cost->R);
    result.N = design::to_doubles(cost->N);
  }
  return result;
}

Plant::Plant(const Controller& controller, const VectorXd& x, PlantNoise noise, std::uint64_t seed)
    : noise_(seed), point_(controller::stated_point(controller)), x_(x) {
  stages_.push_back(stage_of(controller, 0, noise));
  for (const design::StageSolution& stage : controller.solution.stages)
    stages_.push_back(stage_of(controller, static_cast<std::size_t>(stage.from), noise));
}

const Plant::Stage& Plant::stage() const {
  std::size_t at = 0;
  while (at + 1 < stages_.size() && stages_[at + 1].from <= sample_) ++at;
  return stages_[at];
}

VectorXd Plant::measure(const VectorXd& u) {
  const Stage& now = stage();
  VectorXd white(now.noise_factor.rows());
  for (Index i = 0; i < white.size(); ++i) white(i) = noise_.normal();
  drawn_ = ordered_image(now.noise_factor, white);
  const VectorXd acting = controller::as_deviations(u, point_.u);
  return controller::in_own_units(ordered_image(now.C, x_) + ordered_image(now.D, acting) + drawn_.tail(now.C.rows()),
                                  point_.y);
}

void Plant::advance(const VectorXd& u) {
  const Stage& now = stage();
  const VectorXd acting = controller::as_deviations(u, point_.u);
  x_ = ordered_image(now.A, x_) + ordered_image(now.B, acting) + drawn_.head(now.A.rows());
  ++sample_;
}

double Plant::cost(const VectorXd& u) const {
  const Stage& now = stage();
  if (now.Q.size() == 0) return 0;
  const VectorXd acting = controller::as_deviations(u, point_.u);
  return ordered_dot(x_, ordered_image(now.Q, x_) + 2 * ordered_image(now.N, acting)) +
         ordered_dot(acting, ordered_image(now.R, acting));
}

}  // namespace lqg::simulate
