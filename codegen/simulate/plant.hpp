// SPDX-License-Identifier: MIT
// The plant around the controller: the design's own samples, with its noise, in double.
#pragma once

#include <vector>

#include "controller/operating_point.hpp"
#include "simulate/designed.hpp"
#include "simulate/noise.hpp"

namespace lqg::simulate {

// x⁺ = A x + B u + G w, y = C x + D u + v, stage after stage. Every sum is in ascending order: the same bits on every
// host.
class Plant {
 public:
  // x: from the operating point. All else is in the plant's own units.
  Plant(const Controller& controller, const Eigen::VectorXd& x, PlantNoise noise, std::uint64_t seed);

  // y with the u that acts while the outputs are sampled; draws the noises of this sample, the same numbers whether
  // they are wanted or not.
  Eigen::VectorXd measure(const Eigen::VectorXd& u);
  // x ← A x + B u + G w
  void advance(const Eigen::VectorXd& u);
  Eigen::VectorXd state() const { return controller::in_own_units(x_, point_.x); }
  const Eigen::VectorXd& deviation() const { return x_; }  // from the operating point
  // xᵀQx + uᵀRu + 2xᵀNu of the sampled cost in force; 0 without one
  double cost(const Eigen::VectorXd& u) const;

 private:
  struct Stage {
    std::size_t from = 0;
    Eigen::MatrixXd A, B, C, D, noise_factor;  // noise_factor: square root of the joint covariance of G w and v
    Eigen::MatrixXd Q, R, N;                   // of the cost; empty without one
  };
  static Stage stage_of(const Controller& controller, std::size_t from, PlantNoise noise);
  const Stage& stage() const;

  Noise noise_;
  controller::Point point_;
  std::vector<Stage> stages_;
  std::size_t sample_ = 0;
  Eigen::VectorXd x_, drawn_;
};

}  // namespace lqg::simulate
