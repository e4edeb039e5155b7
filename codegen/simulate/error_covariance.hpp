// SPDX-License-Identifier: MIT
// What the filter's design says of the error x − x̂, in double, beside the emitted filter.
#pragma once

#include <vector>

#include "controller/controller.hpp"

namespace lqg::simulate {

using controller::Controller;

// ν ᵀ S⁻¹ ν over the directions in which S is not 0, and how many these are. `used`: of which entries; the others count
// as not measured.
struct NormalisedSquare {
  double value = 0;
  int degrees = 0;
};
NormalisedSquare normalised_square(const Eigen::MatrixXd& S, const Eigen::VectorXd& nu, const std::vector<bool>& used);
NormalisedSquare normalised_square(const Eigen::MatrixXd& S, const Eigen::VectorXd& nu);

// P of e = x − x̂ from P0 on. Of a filter with given gains it follows the gains of each sample and the outputs that
// were used; of one that carries its covariance it is told P.
class ErrorCovariance {
 public:
  explicit ErrorCovariance(const Controller& controller);

  const Eigen::MatrixXd& P() const { return P_; }
  void set(const Eigen::MatrixXd& P) { P_ = P; }
  // C P Cᵀ + V, before the update
  Eigen::MatrixXd of_innovation(const Eigen::MatrixXd& C) const;
  // e ← (I − L C) e − L v with the gains of `gain_row`; an output that was left out has no gain.
  void update(std::size_t gain_row, const std::vector<bool>& left_out);
  // e ← A e + G w − M (C e + v), the same outputs.
  void predict();
  // The plant of this sample is in force.
  void go_to(std::size_t sample);
  void begin_anew();

 private:
  void load_gains(std::size_t gain_row);

  const Controller& controller_;
  Eigen::MatrixXd P_, before_;               // before_: P before the update
  Eigen::MatrixXd A_, C_, V_, GWG_, cross_;  // of the plant in force
  Eigen::MatrixXd L_, M_, used_L_, used_M_;  // of the gains in force
  std::size_t sample_ = 0, gain_row_ = 0;
  bool all_used_ = false, is_settled_ = false;  // settled: a sample with all outputs ends as it began
  Eigen::MatrixXd settled_after_;               // then this is P after the update
};

}  // namespace lqg::simulate
