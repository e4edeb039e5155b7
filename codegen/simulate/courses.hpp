// SPDX-License-Identifier: MIT
// What a scenario asks of the loop and does to it, sample by sample.
#pragma once

#include <Eigen/Core>

#include "controller/controller.hpp"
#include "design/scenario.hpp"

namespace lqg::simulate {

// Column k holds from k T until the next sample.
struct Courses {
  Eigen::MatrixXd reference;   // of the controller's references
  Eigen::MatrixXd load;        // of the inputs
  Eigen::MatrixXd state_load;  // of the plant's own states
  Eigen::MatrixXd input;       // of the inputs: u where there is no regulator
};

// At least one.
int samples_of(const controller::Controller& controller, const design::Scenario& scenario);

Courses courses_of(const controller::Controller& controller, const design::Scenario& scenario);

// The first sample that is not before `time`; instants within 10⁻⁹ of a period of one belong to it. At most `samples`.
int first_sample(double time, double sample_time, int samples);

}  // namespace lqg::simulate
