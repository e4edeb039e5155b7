// SPDX-License-Identifier: MIT
#include "design/run/continuous_compensator.hpp"

#include "design/equations/sampling.hpp"
#include "design/sampled/noise.hpp"
#include "design/sampled/weights.hpp"

namespace lqg::design {

OrderProblem continuous_order_problem(const Problem& problem) {
  const SampledCost cost = weights_of(problem);
  const SampledNoise noise = noise_of(problem);
  const RealMatrix G = real(problem.plant.G);
  OrderProblem result;
  result.is_continuous = true;
  result.A = real(problem.plant.A), result.B = real(problem.plant.B), result.C = real(problem.plant.C);
  result.Q = cost.Q, result.N = cost.N, result.R = cost.R;
  result.W = congruence(G, noise.W), result.Swv = multiply(G, noise.Swv), result.V = noise.V;
  return result;
}

Compensator over_outputs(const Problem& problem, const OrderedCompensator& found) {
  const RealMatrix D = real(problem.plant.D);
  Compensator result = {found.A, found.B, found.C, zeros(found.C.rows(), D.rows()), found.A.rows(), 0};
  if (!is_zero(D)) result.A -= multiply(result.B, multiply(D, result.C));
  return result;
}

Compensator held_compensator(const Problem& problem, const Compensator& continuous) {
  const SampledPeriod period =
      sample(HeldPlant{continuous.A, continuous.B, RealMatrix(), RealMatrix()}, Real(problem.plant.sample_time));
  return {period.A, period.B, continuous.C, continuous.D, continuous.estimates, 0};
}

std::optional<Real> cost_of_continuous_lqg(const Problem& problem, const Solution& solution) {
  const EstimatorSolution& filter = *solution.estimator;
  if (filter.P_continuous.size() == 0 || solution.regulator->X.size() == 0) return std::nullopt;
  const RealMatrix innovation = congruence(filter.L_continuous, noise_of(problem).V);
  return Real(trace_of_product(weights_of(problem).Q, filter.P_continuous) +
              trace_of_product(solution.regulator->X, innovation));
}

}  // namespace lqg::design
