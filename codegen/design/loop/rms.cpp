// SPDX-License-Identifier: MIT
#include "design/loop/rms.hpp"

#include <algorithm>

#include "design/equations/refined_stein.hpp"
#include "design/loop/six_digits.hpp"
#include "design/numeric/chains.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// The first `count` roots of the diagonal.
std::vector<double> roots(const RealMatrix& covariance, Index count) {
  std::vector<double> result;
  for (Index i = 0; i < count; ++i)
    result.push_back(six_digits(to_double(sqrt(std::max<Real>(covariance(i, i), Real(0))))));
  return result;
}

}  // namespace

std::optional<Rms> steady_rms(const Problem& problem, const Samples& samples, const Compensator& controller) {
  const Digits enough(30);
  const MeasuredPlant plant = measured_plant(problem, samples.plant);
  const ClosedLoop loop = closed_loop(plant, controller);
  const SampledNoise& noise = *samples.noise;
  const RealMatrix disturbance = in_present_digits(joint(noise.W, noise.Swv, noise.V));
  const Merged merged = with_equal_states_merged(in_present_digits(loop.A), in_present_digits(loop.B));
  const std::optional<RealMatrix> states = refined_stein(merged.A.transpose(), congruence(merged.B, disturbance));
  if (!states) return std::nullopt;
  const Index nx = plant.A.rows(), ny = plant.C.rows(), nw = noise.W.rows();
  const auto covariance = [&](const RealMatrix& of_states, const RealMatrix& of_noise) {
    return RealMatrix(congruence(multiply(in_present_digits(of_states), merged.spread), *states) +
                      congruence(in_present_digits(of_noise), disturbance));
  };
  // y = C x + D u + v of the outputs; (controller's D)(plant's D) = 0.
  const RealMatrix y_states = beside(plant.C, multiply(plant.D, controller.C));
  const RealMatrix y_noise = beside(zeros(ny, nw), identity(ny));
  const RealMatrix x_states = identity(loop.A.rows()).topRows(nx), x_noise = zeros(nx, nw + ny);
  return Rms{roots(covariance(x_states, x_noise), samples.plant.A.rows()),
             roots(covariance(loop.C, loop.D), loop.C.rows()), roots(covariance(y_states, y_noise), ny)};
}

}  // namespace lqg::design
