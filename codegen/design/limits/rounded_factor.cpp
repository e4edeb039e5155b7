// SPDX-License-Identifier: MIT
#include "design/limits/rounded_factor.hpp"

#include <cmath>
#include <utility>

namespace lqg::design {

// A double holds the product of two floats, and rounding it to float after a double is as good as at once (53 ≥ 2·24 +
// 2 digits); a fused float needs its own.
double TargetArithmetic::multiply_add(double a, double b, double c) const {
  if (!is_fused) return round(round(a * b) + c);
  return is_float ? static_cast<double>(std::fma(static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)))
                  : std::fma(a, b, c);
}

double TargetArithmetic::multiply_subtract(double a, double b, double c) const { return multiply_add(-a, b, c); }

void RoundedFactor::append(const std::vector<double>& column) {
  const std::size_t n = d_.size();
  std::vector<double> product, last;
  double d = column[n];
  for (std::size_t j = 0; j < n; ++j) {
    double g = column[j];
    for (std::size_t i = 0; i < j; ++i) g = target_.multiply_subtract(L_[j][i], product[i], g);
    product.push_back(g);
    last.push_back(target_.round(g / d_[j]));
    d = target_.multiply_subtract(last.back(), g, d);
  }
  L_.push_back(std::move(last));
  d_.push_back(d);
}

void RoundedFactor::drop(int slot) {
  const std::size_t n = d_.size(), k = static_cast<std::size_t>(slot);
  std::vector<double> p(n), beta(n);
  double alpha = d_[k];
  for (std::size_t i = k + 1; i < n; ++i) {
    std::vector<double>& row = L_[i];
    double rest = row[k];
    for (std::size_t j = k + 1; j < i; ++j) {
      rest = target_.multiply_subtract(p[j], row[j], rest);
      row[j] = target_.multiply_add(beta[j], rest, row[j]);
    }
    const double part = target_.round(alpha * rest), d = target_.multiply_add(part, rest, d_[i]);
    p[i] = rest;
    beta[i] = d > 0 ? target_.round(part / d) : 0;
    if (d > 0) alpha = target_.round(target_.round(alpha * d_[i]) / d);
    d_[i] = d;
    row.erase(row.begin() + slot);
  }
  d_.erase(d_.begin() + slot);
  L_.erase(L_.begin() + slot);
}

Eigen::VectorXd RoundedFactor::solution(Eigen::VectorXd right) const {
  for (int k = 0; k < length(); ++k)
    for (int j = 0; j < k; ++j) right(k) -= L(k, j) * right(j);
  for (int j = 0; j < length(); ++j) right(j) /= d(j);
  for (int j = length(); j-- > 1;)
    for (int i = 0; i < j; ++i) right(i) -= L(j, i) * right(j);
  return right;
}

}  // namespace lqg::design
