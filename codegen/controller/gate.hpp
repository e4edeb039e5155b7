// How a gate opens again for an output that it leaves out, and how it narrows.
#pragma once

#include <Eigen/Core>

namespace lqg::controller {

struct Controller;

// Output by output, of the square of its threshold: in units of gate² S, never below 1.
struct Gate {
  Eigen::VectorXd start;   // at the first sample
  Eigen::VectorXd widen;   // the factor of a sample in which the output was left out
  Eigen::VectorXd narrow;  // the factor of a sample in which it was heard
};

// With a constant gain S is that of the steady state: the start covers what P0 adds to it, and `widen` what is added while
// nothing is heard, until the filter has worked it off; `narrow` is as fast as its slowest mode. With P carried S is that
// of the sample.
Gate gate_of(const Controller& controller);

}  // namespace lqg::controller
