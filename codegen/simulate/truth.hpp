// SPDX-License-Identifier: MIT
// One run of a scenario's plant.
#pragma once

#include <Eigen/Core>

#include "controller/operating_point.hpp"
#include "simulate/noise.hpp"
#include "simulate/truth_model.hpp"

namespace lqg::simulate {

// Sample after sample: `ask` and `measure`, in the order of the controller's form, then `advance`.
class Truth {
 public:
  // The noises are drawn from `noise`, the same numbers whether they are wanted or not.
  Truth(const TruthModel& model, const Eigen::VectorXd& x0, Noise& noise);

  // The controller's u of this sample goes to the actuators.
  void ask(const Eigen::VectorXd& u);
  // What the sensors say of y while the last u acts that was asked for and is not late.
  Eigen::VectorXd measure();
  // C x + D u of the last measure, without noise and sensors.
  const Eigen::VectorXd& outputs() const { return outputs_; }
  Eigen::VectorXd state() const { return x_.head(model_.nx); }
  // The same with the inputs on their way as the design has them, the oldest first.
  Eigen::VectorXd designed_state() const;
  // xᵀQx + uᵀRu + 2xᵀNu of the u of this sample; 0 without a cost.
  double cost() const;
  // Between this sample and the next: state and outputs `time` s from now, one of the model's instants.
  Eigen::VectorXd state_after(double time) const { return moved(k_, time).head(model_.nx); }
  Eigen::VectorXd outputs_after(double time) const { return outputs_in(k_, time); }
  void advance();

 private:
  Eigen::VectorXd moved(int period, double time) const;
  Held held_of(int asked, int period) const;
  void move(const TruthModel::Stage& stage, int asked, int period, double time, Eigen::VectorXd& x) const;
  Eigen::VectorXd outputs_in(int period, double time) const;
  Eigen::VectorXd outputs_at(int sample) const;
  Eigen::VectorXd outputs_of(const Eigen::VectorXd& x, int asked, int period) const;
  double late_output(Eigen::Index output) const;
  double asked_for(int input, int sample) const;

  Eigen::Index place(int sample) const { return sample % commands_.cols(); }

  const TruthModel& model_;
  Noise& noise_;
  controller::Point point_;  // sensors and actuators are in the plant's own units
  int k_ = 0;
  bool has_asked_ = false;  // in this sample
  Eigen::VectorXd x0_, x_, drawn_, outputs_;
  // A column for each of the last samples, sample k at k modulo their number.
  Eigen::MatrixXd states_;    // x at the sample
  Eigen::MatrixXd commands_;  // what the actuators can make of u, without their lag
  Eigen::MatrixXd inputs_;    // u
};

}  // namespace lqg::simulate
