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
  bool noise = true;              // w and v as the design has them; false: none
  Eigen::VectorXd x0;             // of the sampled plant (nx), or of the plant without its delayed inputs; empty: 0
  Eigen::VectorXd r;              // the reference of the followed outputs, or empty: 0
  // u of sample k, nu × 1, where there is no regulator; none: 0.
  std::function<Eigen::VectorXd(int)> input;
};

// Column k belongs to sample k.
struct Trajectory {
  Eigen::MatrixXd x;         // nx × samples + 1
  Eigen::MatrixXd estimate;  // nx × samples: what u was made of; x itself without a filter
  Eigen::MatrixXd u, y;      // nu × samples, ny × samples
  double cost = 0;           // Σ xᵀQx + uᵀRu + 2xᵀNu in the sampled weights, where x and u carry them
};

// Runs `solution` of `problem` around its own sampled plant, in double, every sum in ascending order: the same bits
// on every host. Schedules, online covariance, stages' gains, integral, input_rate, track and limits are followed;
// the plant is that of the beginning. As on the target: in filter form y is sampled while the last u acts, in
// predictor form while the new one does.
Trajectory simulate(const Problem& problem, const Solution& solution, const SimulationOptions& options);

}  // namespace lqg::design
