// SPDX-License-Identifier: MIT
#include "simulate/period.hpp"

#include <cmath>

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double largest_row_sum(const MatrixXd& M) {
  double most = 0;
  for (Index i = 0; i < M.rows(); ++i) {
    double sum = 0;
    for (Index j = 0; j < M.cols(); ++j) sum += std::abs(M(i, j));
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace

MatrixXd ordered_product(const MatrixXd& M, const MatrixXd& N) {
  MatrixXd out = MatrixXd::Zero(M.rows(), N.cols());
  for (Index i = 0; i < M.rows(); ++i)
    for (Index j = 0; j < N.cols(); ++j) {
      double sum = 0;
      for (Index k = 0; k < M.cols(); ++k) sum += M(i, k) * N(k, j);
      out(i, j) = sum;
    }
  return out;
}

VectorXd ordered_image(const MatrixXd& M, const VectorXd& x) {
  VectorXd out = VectorXd::Zero(M.rows());
  add_product(M, x, out);
  return out;
}

double ordered_dot(const VectorXd& a, const VectorXd& b) {
  double sum = 0;
  for (Index i = 0; i < a.size(); ++i) sum += a(i) * b(i);
  return sum;
}

void add_product(const MatrixXd& M, const VectorXd& x, VectorXd& out) {
  for (Index i = 0; i < M.rows(); ++i) {
    double sum = 0;
    for (Index j = 0; j < M.cols(); ++j) sum += M(i, j) * x(j);
    out(i) += sum;
  }
}

Period period_of(const MatrixXd& A, const MatrixXd& B, double time) {
  constexpr int terms = 18;  // of a step whose norm is at most 1/2: 2⁻¹⁹/19! < 2⁻⁷⁵
  int doublings = 0;
  double step = time;
  for (const double norm = largest_row_sum(A); norm * std::abs(step) > 0.5; ++doublings) step /= 2;
  // e^(As) − I − As …, from the last term on: Φ = I + A Ψ, Γ = Ψ B with Ψ = ∫ e^(Aσ) dσ.
  const MatrixXd identity = MatrixXd::Identity(A.rows(), A.rows());
  MatrixXd Psi = identity * step;
  for (int k = terms; k > 1; --k) Psi = identity * step + ordered_product(A, Psi) * (step / k);
  Period result = {identity + ordered_product(A, Psi), ordered_product(Psi, B)};
  for (; doublings > 0; --doublings) {
    result.B = ordered_product(result.A, result.B) + result.B;
    result.A = ordered_product(result.A, result.A);
  }
  return result;
}

}  // namespace lqg::simulate
