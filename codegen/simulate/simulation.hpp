// SPDX-License-Identifier: MIT
// A controller at work around its plant, sample by sample: the controller that is emitted, in the target's numbers,
// with its limits, gate, faults and resets. There is no other simulation.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "controller/controller.hpp"
#include "step/model.hpp"

namespace lqg::simulate {

struct SimulationOptions {
  int samples = 0;
  std::uint64_t seed = 1;
  bool noise = true;  // w and v as the design has them (none without an estimator that has noise); false: none
  // In the plant's own units; what is not given is that of the operating point, 0 without one.
  Eigen::VectorXd x0;                         // of the sampled plant (nx), or of the plant without its delayed inputs
  Eigen::VectorXd r;                          // of the outputs named in `integral` or `track`, by rising number
  std::function<Eigen::VectorXd(int)> input;  // u of sample k, nu × 1, where there is no regulator
  std::function<void(int, Eigen::VectorXd&)>
      sensor;  // what the sensors make of y in sample k: drop-outs, outliers; none: y
};

// Column k belongs to sample k.
struct Trajectory {
  Eigen::MatrixXd x;             // nx × samples + 1: of the plant
  Eigen::MatrixXd estimate;      // nx × samples: what u was made of; x itself without a filter
  Eigen::MatrixXd u, y;          // nu × samples, ny × samples: numbers of the target; y is what the controller was told
  Eigen::VectorXd cost;          // samples: xᵀQx + uᵀRu + 2xᵀNu of `SampledCost`; 0 without one
  std::vector<unsigned> events;  // samples: a bit for each step::Event that the status told
  unsigned long resets = 0;      // how often the controller began anew
  unsigned long covariance_resets = 0;  // and P by itself

  bool has(int sample, step::Event event) const {
    return events[static_cast<std::size_t>(sample)] >> static_cast<unsigned>(event) & 1u;
  }
};

// Runs `controller` around the design's own sampled plant. The plant is in double, every sum in ascending order; the
// controller has the bits of the compiled header: the same bits on every host. As on the target, in filter form y is
// sampled while the last u acts, in predictor form while the new one does.
Trajectory simulate(const controller::Controller& controller, const SimulationOptions& options);

}  // namespace lqg::simulate

namespace lqg::design {

using simulate::SimulationOptions;
using simulate::Trajectory;

// The same of the controller that `solution` of `problem` (with its defaults) makes, in the form that code.realisation
// asks for: of "cheapest", which counts the operations of emitted code, the physical one. Throws std::invalid_argument
// with the reason where the target cannot have the design.
Trajectory simulate(const Problem& problem, const Solution& solution, const SimulationOptions& options);

}  // namespace lqg::design
