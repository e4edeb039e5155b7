// SPDX-License-Identifier: MIT
// Design files for the tests, put together and solved.
#pragma once

#include <Eigen/Core>
#include <string>

#include "../random.hpp"
#include "emit/controller.hpp"

namespace lqg_test {

// The keys of a design file; a matrix without entries and an empty text are left out of it.
struct DesignText {
  std::string name = "loop", brief = "a loop of the tests";
  std::string domain = "discrete";
  double sample_time = 0.1;
  Eigen::MatrixXd A, B, C, D, G;
  std::string states, inputs, outputs;  // as in the file: ["position [m]", "speed [m/s]"]
  Eigen::MatrixXd Q, R, N;              // [lqr] when Q has entries
  std::string cost;
  Eigen::MatrixXd W, V, Swv, P0, x0;  // [kalman] when W has entries
  std::string noise, gain, form, covariance;
  Eigen::VectorXd u_min, u_max;
  std::string real = "float", arithmetic = "plain", style = "unrolled";
};

std::string toml(const DesignText& design);

// Parsed and solved; the test fails with all findings when the design is refused.
lqg::emit::Controller controller_of(const std::string& toml);
inline lqg::emit::Controller controller_of(const DesignText& design) { return controller_of(toml(design)); }

// Position and speed of a mass on which a force acts: nothing to go wrong.
DesignText double_integrator();

// `count` of them that know nothing of each other, in one design.
DesignText double_integrators(int count);

// A plant with nx states and a Kalman filter and a regulator for it, everything by chance: domains, costs, noises,
// forms, D, cross noise, correlated V, limits, precision and arithmetic.
DesignText random_design(Random& random, int nx);

}  // namespace lqg_test
