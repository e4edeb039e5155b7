// SPDX-License-Identifier: MIT
// What limits that are foreseen are worth beside clipping, as `simulate` finds it.
#pragma once

#include <Eigen/Core>

namespace lqg::controller {

// One start, with both laws: what is limited, one column a sample.
struct WorthOfRun {
  Eigen::VectorXd x;                     // the start
  Eigen::MatrixXd clipped_u, optimal_u;  // inputs
  Eigen::MatrixXd clipped_x, optimal_x;  // states of the plant
};

// Over starts from which the law alone goes beyond a limit, 1 to 4 times. J is the cost of the design with that of the
// excess over soft limits; ratios are clipped / optimal of the starts from which both settle, and so are excesses.
struct Worth {
  int starts = 0, clipped_settle = 0, optimal_settle = 0, both_settle = 0;
  double median_ratio = 1, high_ratio = 1;        // of J; the second is the 99th percentile
  double clipped_excess = 0, optimal_excess = 0;  // over a soft limit, as a share of its range: the mean of the largest
  Eigen::VectorXd reach;                          // how far each state of the plant went where that settled, foreseen
  WorthOfRun shown;  // of a start that clipping does not survive, else of one in ten that cost it most
};

}  // namespace lqg::controller
