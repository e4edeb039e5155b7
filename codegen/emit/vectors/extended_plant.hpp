// SPDX-License-Identifier: MIT
// The plant of an extended filter, as the filter knows it: for vectors.
#pragma once

#include "emit/controller.hpp"
#include "simulate/noise.hpp"
#include "step/model.hpp"

namespace lqg::emit {

// x ← the filter's own step of f + noise, y = h + noise, in double, by the same functions as the target's: the same
// bits on every host.
class ExtendedPlant {
 public:
  ExtendedPlant(const Controller& controller, std::uint64_t seed_of_noise);

  // y while u acts.
  Eigen::VectorXd measure(const Eigen::VectorXd& u);
  void advance(const Eigen::VectorXd& u);
  // x as the filter has it: in the plant's own units.
  const Eigen::VectorXd& deviation() const { return x_; }

 private:
  step::Model<double> model_;
  simulate::Noise noise_;
  Eigen::VectorXd x_;
  Eigen::MatrixXd of_outputs_;  // a square root of V
};

}  // namespace lqg::emit
