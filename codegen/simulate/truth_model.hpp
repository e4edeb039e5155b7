// SPDX-License-Identifier: MIT
// The plant of a scenario as data: perhaps another one than the design's, with actuators that are not ideal, with
// loads; continuous where the design's is, so that it is known between the samples, too.
#pragma once

#include <memory>
#include <vector>

#include "controller/controller.hpp"
#include "design/scenario.hpp"
#include "simulate/courses.hpp"
#include "simulate/motion.hpp"
#include "simulate/period.hpp"

namespace lqg::simulate {

// What A, B and C are multiplied by in one run of many, entry by entry; empty: 1.
struct Factors {
  Eigen::MatrixXd A, B, C;
};

// x = [the plant's own states; what an actuator with a lag does, input by input].
// h, held from sample to sample: [what the actuators are asked for; loads of inputs; loads of states].
struct TruthModel {
  // Over a time within a period.
  struct Move {
    double time = 0;  // s
    Period period;
  };
  struct Stage {
    std::size_t from = 0;
    Eigen::MatrixXd A, B, C, D;    // as the design file has them for this stage
    std::vector<Move> moves;       // one for each of `TruthModel::times`
    Eigen::MatrixXd noise_factor;  // of [G w of the own states; v]
    Eigen::MatrixXd Q, R, N;       // of the cost; empty without one
  };

  const controller::Controller* controller = nullptr;
  const design::Scenario* scenario = nullptr;
  const Courses* courses = nullptr;
  Eigen::Index nx = 0, nu = 0, ny = 0;
  double T = 0;  // s
  bool is_continuous = false;
  bool has_loads = false;        // of any kind: h has those parts
  int late = 0;                  // whole periods until an input acts,
  double part = 0;               // and s of the next one
  Eigen::VectorXd output_delay;  // s, of the design and of the scenario together
  Eigen::Index added = 0;        // states of the filter beside those of the plant and the inputs on their way
  int designed_delay = 0;        // periods, rounded up, as the cost of the design has it
  std::vector<double> instants;  // s after a sample, of what is shown between
  std::vector<double> times;     // s, over which the state is moved
  std::vector<int> lagged;       // inputs whose actuator has a lag
  std::vector<Stage> stages;
  std::shared_ptr<const Motion> motion;  // of a plant of equations: what moves and is measured in place of A, B, C, D

  const Stage& stage_at(int sample) const;
  // The same plant with other entries.
  TruthModel with(const Factors& factors) const;
};

// What is left of a time beyond whole periods, in s; 0 where it is within 10⁻⁹ of whole ones.
double within_period(double time, double sample_time);

// `instants`: how many of equal distance in a period are shown, the sample itself among them; 1 for a plant that is
// not continuous.
TruthModel truth_model(const controller::Controller& controller, const design::Scenario& scenario,
                       const Courses& courses, int instants);

}  // namespace lqg::simulate
