// SPDX-License-Identifier: MIT
#include "design/sampled/weights.hpp"

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

namespace {

// diag(factor/v²)
RealMatrix over_squares(const Eigen::VectorXd& largest, const Real& factor) {
  RealMatrix weight = zeros(largest.size(), largest.size());
  for (Index i = 0; i < largest.size(); ++i) {
    const Real value = largest(i);
    weight(i, i) = factor / (value * value);
  }
  return weight;
}

// Q_o, empty where no output carries a weight.
RealMatrix output_weight(const Regulator& lqr) {
  if (lqr.Q_output.size() > 0) return real(lqr.Q_output);
  return lqr.bryson ? over_squares(lqr.bryson->outputs, Real(1)) : RealMatrix();
}

}  // namespace

SampledCost stated_weights(const Problem& problem) {
  if (!has_cost(problem.regulator)) return {};
  const Regulator& lqr = *problem.regulator;
  const Index nx = problem.plant.A.rows(), nu = problem.plant.B.cols();
  SampledCost cost = {real(lqr.Q), real(lqr.R), real(lqr.N)};
  if (lqr.bryson) {
    cost.Q = over_squares(lqr.bryson->states, Real(1));
    cost.R = over_squares(lqr.bryson->inputs, Real(lqr.bryson->rho));
  }
  if (cost.Q.size() == 0) cost.Q = zeros(nx, nx);
  if (cost.N.size() == 0) cost.N = zeros(nx, nu);
  return cost;
}

SampledCost output_weights(const Problem& problem) {
  if (!has_cost(problem.regulator)) return {};
  const Index nx = problem.plant.A.rows(), nu = problem.plant.B.cols();
  const RealMatrix Q_output = output_weight(*problem.regulator);
  if (Q_output.size() == 0) return {zeros(nx, nx), zeros(nu, nu), zeros(nx, nu)};
  const RealMatrix C = real(problem.plant.C), D = real(problem.plant.D);
  return {transpose_congruence(C, Q_output), transpose_congruence(D, Q_output),
          transpose_multiply(C, multiply(Q_output, D))};
}

SampledCost weights_of(const Problem& problem) {
  const SampledCost stated = stated_weights(problem), outputs = output_weights(problem);
  return {stated.Q + outputs.Q, stated.R + outputs.R, stated.N + outputs.N};
}

}  // namespace lqg::design
