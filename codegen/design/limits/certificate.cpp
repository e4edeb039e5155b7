// SPDX-License-Identifier: MIT
#include "design/limits/certificate.hpp"

#include <algorithm>

#include "design/limits/certificate_search.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// In which of these parts of u[k−1] each narrowed limit is constant or moves with it.
std::vector<double> parts(const LimitNumbers& numbers, const CertifiedBox& box, Index i) {
  const double low = numbers.low(i), high = numbers.high(i), step = numbers.u_step(i);
  std::vector<double> ends{box.u_low(i), box.u_high(i)};
  for (const double end : {low - step, low + step, high - step, high + step})
    if (end > box.u_low(i) && end < box.u_high(i)) ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  return ends;
}

void certify_part(const LimitNumbers& numbers, const CertificateEffort& effort, const VectorXd& low,
                  const VectorXd& high, CertifiedChanges& result) {
  const VectorXd centre = 0.5 * low + 0.5 * high;
  const VectorXd half_width = (1 + 0x1p-51) * (high - centre).cwiseMax(centre - low);
  certificate::Search(numbers, effort, centre, half_width, result).search();
}

// All parts of u_i[k−1] and of the inputs after it.
void certify_parts(const LimitNumbers& numbers, const CertifiedBox& box, const CertificateEffort& effort, Index i,
                   VectorXd& low, VectorXd& high, CertifiedChanges& result) {
  if (i == numbers.u_step.size()) return certify_part(numbers, effort, low, high, result);
  const std::vector<double> ends = parts(numbers, box, i);
  for (std::size_t part = 1; part < ends.size(); ++part) {
    low(numbers.law.cols() + i) = ends[part - 1];
    high(numbers.law.cols() + i) = ends[part];
    certify_parts(numbers, box, effort, i + 1, low, high, result);
  }
}

template <class Derived>
MatrixXd in_numbers_of(Scalar real, const Eigen::MatrixBase<Derived>& values) {
  if (real == Scalar::float64) return to_doubles(values);
  return to_floats(values).template cast<double>();
}

}  // namespace

LimitNumbers limit_numbers(const RealMatrix& law, const LimitedRows& rows, const RealVector& u_step, Scalar real) {
  LimitNumbers numbers;
  numbers.law = in_numbers_of(real, law);
  numbers.F = in_numbers_of(real, rows.F);
  numbers.G = in_numbers_of(real, rows.G);
  numbers.scale = in_numbers_of(real, rows.scale);
  numbers.low = in_numbers_of(real, rows.low);
  numbers.high = in_numbers_of(real, rows.high);
  numbers.tolerance = in_numbers_of(real, rows.tolerance);
  numbers.u_step = in_numbers_of(real, u_step);
  numbers.real = real;
  return numbers;
}

CertifiedChanges certify_changes(const LimitNumbers& numbers, const CertifiedBox& box,
                                 const CertificateEffort& effort) {
  const Index nx = numbers.law.cols(), moved = numbers.u_step.size();
  VectorXd low(nx + moved), high(nx + moved);
  low.head(nx) = box.low;
  high.head(nx) = box.high;
  CertifiedChanges result;
  certify_parts(numbers, box, effort, 0, low, high, result);
  return result;
}

}  // namespace lqg::design
