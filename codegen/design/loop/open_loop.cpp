// SPDX-License-Identifier: MIT
#include "design/loop/open_loop.hpp"

namespace lqg::design {

// u = controller.D y + controller.C s and y = C x + D u, where (controller.D)(plant.D) = 0.

OpenLoop open_at_inputs(const MeasuredPlant& plant, const Compensator& controller) {
  const Index nx = plant.A.rows(), ns = controller.A.rows();
  return {above(beside(plant.A, zeros(nx, ns)), beside(multiply(controller.B, plant.C), controller.A)),
          above(plant.B, multiply(controller.B, plant.D)), -beside(multiply(controller.D, plant.C), controller.C)};
}

OpenLoop open_at_outputs(const MeasuredPlant& plant, const Compensator& controller) {
  const Index nx = plant.A.rows(), ns = controller.A.rows();
  return {above(beside(plant.A, multiply(plant.B, controller.C)), beside(zeros(ns, nx), controller.A)),
          above(multiply(plant.B, controller.D), controller.B), -beside(plant.C, multiply(plant.D, controller.C))};
}

}  // namespace lqg::design
