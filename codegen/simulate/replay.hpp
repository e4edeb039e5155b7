// SPDX-License-Identifier: MIT
// The emitted filter over a log of a real plant.
#pragma once

#include <string>
#include <vector>

#include "controller/controller.hpp"
#include "step/model.hpp"

namespace lqg::simulate {

// Column k belongs to sample k. NaN: the output is missing.
struct Log {
  Eigen::VectorXd times;  // s
  Eigen::MatrixXd y, u;   // what was measured, and what was applied
  Eigen::MatrixXd r;      // of the controller's references
};

struct ReplayRun {
  Eigen::VectorXd times;
  Eigen::MatrixXd y, u;        // of the log, numbers of the target
  Eigen::MatrixXd law;         // the u that the controller would have given; empty without a regulator
  Eigen::MatrixXd estimate;    // of the plant's own states, as u is made of them
  Eigen::MatrixXd sigma;       // their standard deviation; empty beside an observer
  Eigen::MatrixXd innovation;  // y − C x̂ − D u
  Eigen::VectorXd nis;         // νᵀ S⁻¹ ν of the outputs that were used; empty beside an observer
  std::vector<unsigned> events;
  std::vector<unsigned long> left_out;  // samples, output by output
  unsigned long resets = 0, covariance_resets = 0;
};

// Why this controller has no filter that could be told of u; empty where it has.
std::string no_replay(const controller::Controller& controller);

ReplayRun replay(const controller::Controller& controller, const Log& log);

}  // namespace lqg::simulate
