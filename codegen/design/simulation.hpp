// A design at work: plant, filter and regulator, sample by sample, with noise from a seed.
#pragma once

#include <cstdint>
#include <functional>

#include "design/solution.hpp"

namespace lqg::design {

// Normal numbers, the same on every host: the sum of twelve uniform ones less six, so that none is beyond ±6. The
// uniform ones are splitmix64's (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
// OOPSLA 2014).
class NoiseSource {
 public:
  explicit NoiseSource(std::uint64_t seed) : state_(seed) {}
  double uniform();  // in (0, 1)
  double normal();   // mean 0, variance 1

 private:
  std::uint64_t state_;
};

struct SimulationOptions {
  int samples = 0;
  std::uint64_t seed = 1;
  bool noise = true;   // w and v as the design has them (none without an estimator that has noise); false: none
  Eigen::VectorXd x0;  // of the sampled plant (nx), or of the plant without its delayed inputs; empty: 0
  Eigen::VectorXd r;   // of the outputs named in `integral` or `track`, by rising number; empty: 0
  std::function<Eigen::VectorXd(int)> input;  // u of sample k, nu × 1, where there is no regulator; none: 0
};

// Column k belongs to sample k.
struct Trajectory {
  Eigen::MatrixXd x;         // nx × samples + 1
  Eigen::MatrixXd estimate;  // nx × samples: what u was made of; x itself without a filter
  Eigen::MatrixXd u, y;      // nu × samples, ny × samples
  Eigen::VectorXd cost;      // samples: xᵀQx + uᵀRu + 2xᵀNu of `SampledCost`; 0 without one
};

// Runs `solution` of `problem` (with its defaults) around its own sampled plant, in double, every sum in ascending
// order: the same bits on every host.
//   x⁺ = A x + B u + G w,  y = C x + D u + v,  u = −K [x̂; ξ; u[k−1]] + Nbar r,  ξ⁺ = ξ + T (r − y)
// Schedules, stages, covariance on line, `input_rate` and limits are followed; the target's gate and what it does
// with ξ when u is limited are not. As on the target, in filter form y is sampled while the last u acts, in predictor
// form while the new one does.
Trajectory simulate(const Problem& problem, const Solution& solution, const SimulationOptions& options);

}  // namespace lqg::design
