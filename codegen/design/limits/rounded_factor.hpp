// SPDX-License-Identifier: MIT
// The factors of the active rows' G as the target has them, to the bit: they do not depend on the state.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace lqg::design {

// How a target computes: in float or double, with multiply-adds that round once (fused) or twice.
struct TargetArithmetic {
  bool is_float = false, is_fused = false;

  double round(double a) const { return is_float ? static_cast<double>(static_cast<float>(a)) : a; }
  double multiply_add(double a, double b, double c) const;       // a b + c
  double multiply_subtract(double a, double b, double c) const;  // c − a b
};

// L diag(d) Lᵀ, L with a unit diagonal: append and drop are those of src/mpc.c, operation by operation.
class RoundedFactor {
 public:
  explicit RoundedFactor(TargetArithmetic target) : target_(target) {}

  int length() const { return static_cast<int>(d_.size()); }
  double L(int i, int j) const { return L_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]; }
  double d(int j) const { return d_[static_cast<std::size_t>(j)]; }

  // column: G of the row with those before it, and with itself.
  void append(const std::vector<double>& column);
  void drop(int k);
  // G⁻¹ right, for doubles.
  Eigen::VectorXd solution(Eigen::VectorXd right) const;

 private:
  TargetArithmetic target_;
  std::vector<double> d_;
  std::vector<std::vector<double>> L_;
};

}  // namespace lqg::design
