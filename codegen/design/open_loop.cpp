#include "design/open_loop.hpp"

#include "design/compensator.hpp"

namespace lqg::design {

OpenLoop open_loop(const Problem& problem, const Solution& solution) {
  const MeasuredPlant plant = measured_plant(problem, solution.plant);
  const Compensator controller = compensator(problem, solution);
  // u = controller.D C x + controller.C s, and y has D ū with the input that acts: controller.D D = 0.
  const Index nx = plant.A.rows(), ns = controller.A.rows();
  return {above(beside(plant.A, zeros(nx, ns)), beside(multiply(controller.B, plant.C), controller.A)),
          above(plant.B, multiply(controller.B, plant.D)),
          -beside(multiply(controller.D, plant.C), controller.C)};
}

}  // namespace lqg::design
