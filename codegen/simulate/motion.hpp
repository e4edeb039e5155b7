// SPDX-License-Identifier: MIT
// A plant of equations, between two samples and at them, in double.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "design/problem.hpp"
#include "expression/tree.hpp"

namespace lqg::simulate {

// What acts on a plant from one sample to the next.
struct Held {
  Eigen::VectorXd command;     // nu, what the actuators are asked for
  Eigen::VectorXd load;        // nu, added to what they do; or empty
  Eigen::VectorXd state_load;  // nx, added to ẋ, or to x⁺ of a discrete plant; or empty
};

// An input whose actuator follows its command late: a' = (command − a)/time_constant.
struct Lag {
  int input = 0;
  double time_constant = 0;  // s
};

// States, inputs and outputs are deviations from the operating point of the plant, where it has one. All of the plant's
// functions are those of the C library: its last bits may be others on another host.
class Motion {
 public:
  // `changed`: parameters that have another value here than in the design.
  Motion(const design::Plant& plant, const std::map<std::string, double>& changed, std::vector<Lag> lags);

  // x, which is [the plant's own states; what each lagging actuator does], `time` s later; of a discrete plant a sample
  // later. All of it infinite where the plant has run away, or f has no value.
  void move(const Held& held, double time, Eigen::VectorXd& x) const;
  // h while `acting` acts.
  Eigen::VectorXd outputs(const Eigen::VectorXd& x, const Eigen::VectorXd& acting) const;

 private:
  struct Formula {
    expression::Tree tree;
    std::map<const expression::Node*, double> constants;  // the values of its largest parts without a variable
  };
  static Formula formula_of(const expression::Tree& tree, const std::map<std::string, double>& changed);
  static double value(const Formula& formula, const std::vector<double>& signals);

  std::vector<double> signals_of(const std::vector<double>& states, const Held& held) const;
  std::vector<double> in_own_units(const Eigen::VectorXd& x) const;
  void move_sample(const Held& held, Eigen::VectorXd& x) const;
  void integrate(const Held& held, double time, Eigen::VectorXd& x) const;

  bool is_continuous_;
  double sample_time_;
  std::size_t nx_, nu_;
  std::vector<double> point_, y_;  // of the operating point: states and inputs, and outputs
  std::vector<Formula> f_, h_;
  std::vector<Lag> lags_;
};

}  // namespace lqg::simulate
