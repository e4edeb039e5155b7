// SPDX-License-Identifier: MIT
#include "design/sampled/noise.hpp"

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

namespace {

// √(2τ), or ones where the matrix is a density already.
RealVector roots_of(const Eigen::VectorXd& correlation_time, Index size) {
  RealVector roots = RealVector::Constant(size, Real(1));
  for (Index i = 0; i < correlation_time.size(); ++i) roots(i) = sqrt(2 * Real(correlation_time(i)));
  return roots;
}

RealMatrix scaled(const RealVector& left, const RealMatrix& a, const RealVector& right) {
  RealMatrix result = a;
  for (Index j = 0; j < a.cols(); ++j)
    for (Index i = 0; i < a.rows(); ++i) result(i, j) *= left(i) * right(j);
  return result;
}

// diag(√(2τ)) M diag(√(2τ)); on the diagonal 2τ itself, without the rounding of a root.
RealMatrix density_of(const ExactMatrix& variance, const Eigen::VectorXd& correlation_time) {
  const RealVector roots = roots_of(correlation_time, variance.rows());
  const RealMatrix given = real(variance);
  RealMatrix density = scaled(roots, given, roots);
  for (Index i = 0; i < correlation_time.size(); ++i) density(i, i) = 2 * Real(correlation_time(i)) * given(i, i);
  return density;
}

}  // namespace

SampledNoise noise_of(const Problem& problem) {
  if (!has_noise(problem.estimator)) return {};
  const Estimator& kalman = *problem.estimator;
  const Index nw = kalman.W.rows(), ny = kalman.V.rows();
  SampledNoise noise;
  noise.W = density_of(kalman.W, kalman.process_correlation_time);
  noise.V = density_of(kalman.V, kalman.measurement_correlation_time);
  noise.Swv = scaled(roots_of(kalman.process_correlation_time, nw), real(kalman.Swv),
                     roots_of(kalman.measurement_correlation_time, ny));
  if (problem.plant.H.isZero(0)) return noise;
  const RealMatrix H = real(problem.plant.H), HS = multiply(H, noise.Swv);
  noise.V += congruence(H, noise.W) + HS + HS.transpose();
  noise.Swv += multiply_transpose(noise.W, H);
  return noise;
}

}  // namespace lqg::design
