// SPDX-License-Identifier: MIT
// The active rows on a path of the target's solver of limits, and how far its rounding may lead.
#pragma once

#include <vector>

#include "design/limits/rounded_factor.hpp"

namespace lqg::design {

inline constexpr double double_unit = 0x1p-53;  // half of the last place of 1

enum class LimitSide : signed char { none, low, high };

// In the order of src/mpc.c. The inverse of their G is in doubles; each number brings the largest error it may have.
class ActiveRows {
 public:
  ActiveRows(const Eigen::MatrixXd& G, bool is_float);

  int length() const { return static_cast<int>(rows_.size()); }
  int row(int k) const { return rows_[static_cast<std::size_t>(k)]; }
  // 1 at the low limit, where the multiplier is ≥ 0, −1 at the high one.
  double sign(int k) const { return signs_[static_cast<std::size_t>(k)]; }

  void append(int row, LimitSide side);
  void drop(int k);

  // Whether all errors have a bound, and the target's last pivot is above `negligible`, a share of G_ii.
  bool is_regular(double negligible) const;

  const Eigen::MatrixXd& inverse() const { return inverse_; }
  const Eigen::MatrixXd& inverse_error() const { return inverse_error_; }  // entry by entry, at most
  // The multipliers m that the target finds miss the limits by at most residual() |m|, and what is lost in limit − f.
  const Eigen::MatrixXd& residual() const { return residual_; }

 private:
  std::vector<double> column_of(int row) const;
  void refresh();
  void set_inverse();
  Eigen::MatrixXd residual_of(const RoundedFactor& factor) const;
  double G(int i, int j) const { return (*G_)(row(i), row(j)); }

  const Eigen::MatrixXd* G_;
  double unit_;
  std::vector<int> rows_;
  std::vector<double> signs_;
  RoundedFactor plain_, fused_;
  Eigen::MatrixXd inverse_, inverse_error_, residual_;
  bool has_bounds_ = true;
};

}  // namespace lqg::design
