// SPDX-License-Identifier: MIT
// How a gate opens again for an output that it leaves out, and how it narrows.
#pragma once

#include <Eigen/Core>

#include "design/problem.hpp"

namespace lqg::controller {

struct Controller;

// An innovation beyond `sigma` of its standard deviations leaves its output out: kalman.gate or, where there is none,
// kalman.spike, by which a single absurd value of any size costs nothing. The rest is output by output, of the square
// of the threshold: in units of sigma² S, never below 1.
struct Gate {
  double sigma = 0;        // 0: all that is believable is let in
  Eigen::VectorXd start;   // at the first sample
  Eigen::VectorXd widen;   // the factor of a sample in which the output was left out
  Eigen::VectorXd narrow;  // the factor of a sample in which it was heard
};

// With a constant gain S is that of the steady state: the start covers what P0 adds to it, and `widen` what is added
// while nothing is heard, until the filter has worked it off; `narrow` is as fast as its slowest mode. With P carried S
// is that of the sample.
Gate gate_of(const Controller& controller);

// The sigma of a file: the smaller one of kalman.gate and kalman.spike; 0 where both are off.
double sigma_of(const design::Estimator& estimator);

// The key that it is of.
const char* key_of_sigma(const design::Estimator& estimator);

// Nobody has asked for it: it is left out where there are no variances to compare with.
bool is_default(const design::Estimator& estimator);

}  // namespace lqg::controller
