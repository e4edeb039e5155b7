// SPDX-License-Identifier: MIT
// A controller at work in a scenario of its design file, and the numbers that decide.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "controller/controller.hpp"
#include "design/scenario.hpp"
#include "step/model.hpp"

namespace lqg::simulate {

// How an output answers one step of its reference, before the next event of the scenario. Of the plant's output
// without noise, between samples too.
struct StepAnswer {
  int output = 0;
  double at = 0, from = 0, to = 0;      // s; the reference before and after
  std::optional<double> rise_time;      // s, from 10 % to 90 %; none: not reached
  std::optional<double> settling_time;  // s, to within 2 % for good; none: not reached
  double overshoot = 0;                 // share of the step, ≥ 0
};

struct ScenarioNumbers {
  // Of the samples, from the operating point; y without noise; peak: largest |·|.
  std::vector<double> rms_x, peak_x, rms_u, peak_u, rms_y, peak_y;
  std::vector<double> share_at_limits;  // of the samples, input by input
  std::vector<StepAnswer> answers;
  std::vector<unsigned long> left_out;  // samples in which an output was not used, output by output
  unsigned long resets = 0, covariance_resets = 0;
  double cost = 0;            // Σ xᵀQx + uᵀRu + 2xᵀNu
  bool has_diverged = false;  // a state has left 1e9 times its start, or is not finite: the rest is not shown
};

// Column k of a matrix belongs to sample k, at times(k).
struct ScenarioRun {
  std::string name;
  Eigen::VectorXd times;     // s
  Eigen::MatrixXd x;         // of the plant's own states (without inputs on their way)
  Eigen::MatrixXd estimate;  // as u was made of it: of these states, and of the inputs on their way; x itself without
                             // a filter
  Eigen::MatrixXd sigma;     // standard deviation of the estimate's error that the design promises; empty without noise
  Eigen::MatrixXd y;         // as the controller was told, numbers of the target
  Eigen::MatrixXd outputs;   // C x + D u without noise
  Eigen::MatrixXd u;         // as the controller asked for it, numbers of the target
  Eigen::MatrixXd r;         // of the outputs named in controller.references
  Eigen::MatrixXd innovation;     // y − C x̂ − D u; empty without a filter that keeps x̂
  Eigen::VectorXd nis;            // νᵀ S⁻¹ ν of the outputs that were used; likewise
  Eigen::VectorXd nees;           // eᵀ P⁻¹ e; empty without sigma
  int nees_degrees = 0;           // directions in which there is an error at all
  std::vector<unsigned> events;   // a bit for each step::Event that the status told
  Eigen::ArrayXX<bool> left_out;  // of each output, whether it was not used
  // Between the samples, too (of a continuous plant; else empty): several instants in each period.
  Eigen::VectorXd fine_times;
  Eigen::MatrixXd fine_x, fine_outputs;
  ScenarioNumbers numbers;

  bool has(Eigen::Index sample, step::Event event) const {
    return events[static_cast<std::size_t>(sample)] >> static_cast<unsigned>(event) & 1u;
  }
};

// Same controller, scenario and seed: the same bits on every host.
ScenarioRun run_scenario(const controller::Controller& controller, const design::Scenario& scenario,
                         std::uint64_t seed = 1);

// Those of the design file. Without any: a step of each reference and of each load, in sizes that the limits and
// weights make sensible; of an estimator alone a run with its noises.
std::vector<design::Scenario> scenarios_to_show(const controller::Controller& controller);

// Likewise, with the times and sizes of those of the same name among `others`, so that the curves of several designs
// lie over each other. Those of a design file stay as they are.
std::vector<design::Scenario> scenarios_to_show(const controller::Controller& controller,
                                                const std::vector<design::Scenario>& others);

// One scenario of each name: as long as the longest of that name, with the smallest course, which all can follow.
std::vector<design::Scenario> common_scenarios(const std::vector<std::vector<design::Scenario>>& of_designs);

}  // namespace lqg::simulate
