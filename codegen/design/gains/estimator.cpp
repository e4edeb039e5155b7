// SPDX-License-Identifier: MIT
#include "design/gains/estimator.hpp"

#include "design/equations/refined_stein.hpp"
#include "design/finding.hpp"
#include "design/numeric/factor.hpp"
#include "design/sampled/noise.hpp"

namespace lqg::design {

namespace {

// What the gain takes for noise of the plant's own states.
RealMatrix noise_of_gain(const Samples& samples) {
  const RealMatrix noise = congruence(own_plant(samples).G, samples.noise->W);
  const Index nx = samples.own_states;
  return samples.fictitious.size() > 0 ? RealMatrix(noise + samples.fictitious.topLeftCorner(nx, nx)) : noise;
}

}  // namespace

RiccatiResult solve_estimator(const Samples& samples, const RealMatrix& start) {
  const SampledPlant plant = own_plant(samples);
  const SampledNoise& noise = *samples.noise;
  const Index nx = samples.own_states, all = samples.plant.A.rows();
  RiccatiResult result = solve_discrete_riccati(
      {plant.A.transpose(), plant.C.transpose(), noise_of_gain(samples), noise.V, multiply(plant.G, noise.Swv)},
      start.size() > 0 ? RealMatrix(start.topLeftCorner(nx, nx)) : start);
  // The inputs on their way are known: no error.
  if (result.failure == RiccatiFailure::none) result.X = padded(result.X, all, all);
  return result;
}

RiccatiResult solve_continuous_estimator(const Problem& problem, const RealMatrix& start) {
  const SampledNoise noise = noise_of(problem);
  const RealMatrix G = real(problem.plant.G);
  RealMatrix of_states = congruence(G, noise.W);
  const RealMatrix B = real(problem.plant.B);
  if (problem.estimator->recovery) of_states += Real(problem.estimator->recovery->q) * multiply_transpose(B, B);
  return solve_continuous_riccati({real(problem.plant.A).transpose(), real(problem.plant.C).transpose(), of_states,
                                   noise.V, multiply(G, noise.Swv)},
                                  start);
}

EstimatorSolution filter_of(const Samples& samples, const RealMatrix& P_prior) {
  const SampledPlant& plant = samples.plant;
  const SampledNoise& noise = *samples.noise;
  EstimatorSolution filter;
  filter.noise = noise;
  filter.fictitious = samples.fictitious;
  filter.P_prior = P_prior;
  filter.S = noise.V + congruence(plant.C, P_prior);
  const RealMatrix CP = multiply(plant.C, P_prior), Swv_G = multiply(plant.G, noise.Swv).transpose();
  const RealMatrix gains = *solve(filter.S, beside(CP, Swv_G));
  filter.L = gains.leftCols(plant.A.rows()).transpose();
  filter.M = gains.rightCols(plant.A.rows()).transpose();
  filter.L_predictor = multiply(plant.A, filter.L) + filter.M;
  filter.P_posterior = P_prior - congruence(filter.L, filter.S);
  return filter;
}

RealMatrix next_error(const Samples& samples, const RealMatrix& L_predictor, const RealMatrix& P_prior) {
  const SampledPlant& plant = samples.plant;
  const SampledNoise& noise = *samples.noise;
  return congruence(plant.A - multiply(L_predictor, plant.C), P_prior) +
         congruence(beside(plant.G, -L_predictor), joint(noise.W, noise.Swv, noise.V));
}

void set_error(const Samples& samples, const RealMatrix& P_prior, EstimatorSolution& filter) {
  const RealMatrix& C = samples.plant.C;
  filter.P_prior = P_prior;
  filter.S = filter.noise.V + congruence(C, P_prior);
  filter.P_posterior =
      congruence(identity(P_prior.rows()) - multiply(filter.L, C), P_prior) + congruence(filter.L, filter.noise.V);
}

std::optional<RealMatrix> steady_error(const Samples& samples, const RealMatrix& L_predictor) {
  const SampledPlant own = own_plant(samples);
  const SampledNoise& noise = *samples.noise;
  const Index nx = samples.own_states, all = samples.plant.A.rows();
  const RealMatrix gain = L_predictor.topRows(nx);
  const RealMatrix driven = congruence(beside(own.G, -gain), joint(noise.W, noise.Swv, noise.V));
  const std::optional<RealMatrix> P = refined_stein((own.A - multiply(gain, own.C)).transpose(), driven);
  return P ? std::optional(padded(*P, all, all)) : std::nullopt;
}

namespace {

// W = G diag(w) Gᵀ without the columns that carry nothing.
void factor_process_noise(OnlineSolution& online) {
  const Factors factors = upper_factors(online.W);
  std::vector<Index> kept;
  for (Index j = 0; j < factors.d.size(); ++j)
    if (!factors.d(j).is_zero()) kept.push_back(j);
  const Index nq = static_cast<Index>(kept.size());
  online.G = zeros(online.W.rows(), nq);
  online.w = RealVector(nq);
  for (Index q = 0; q < nq; ++q) {
    online.G.col(q) = factors.U.col(kept[static_cast<std::size_t>(q)]);
    online.w(q) = factors.d(kept[static_cast<std::size_t>(q)]);
  }
}

}  // namespace

OnlineSolution online_filter(const Estimator& estimator, const Samples& samples) {
  const SampledPlant& plant = samples.plant;
  const SampledNoise& noise = *samples.noise;
  OnlineSolution online;
  const Factors V = lower_factors(noise.V);  // V = U diag(V) Uᵀ, E = U⁻¹
  online.V = V.d;
  online.E = *solve(V.U, identity(V.U.rows()));
  online.C = multiply(online.E, plant.C);
  online.D = multiply(online.E, plant.D);
  online.M = multiply_transpose(multiply(plant.G, noise.Swv), online.E);
  for (Index j = 0; j < online.M.cols(); ++j) online.M.col(j) /= online.V(j);
  online.A_free = plant.A - multiply(online.M, online.C);
  online.W = congruence(plant.G, noise.W) - congruence(online.M, RealMatrix(online.V.asDiagonal()));
  factor_process_noise(online);
  online.P0 = initial_covariance(estimator, samples);
  const Factors P0 = upper_factors(online.P0);
  online.U0 = P0.U;
  online.D0 = P0.d;
  return online;
}

void explain_estimator(RiccatiFailure failure, Findings& findings) {
  switch (failure) {
    case RiccatiFailure::none: return;
    case RiccatiFailure::not_definite:
      return add_error(findings, "kalman.measurement_noise",
                       "the innovation covariance CPCᵀ + V is not positive definite");
    case RiccatiFailure::no_start:
      return add_error(findings, "kalman",
                       "no stable filter was found: the plant is too close to one that is not detectable");
    case RiccatiFailure::not_converged:
      return add_error(findings, "kalman",
                       "no stable filter is optimal: a pole of the filter tends to the stability limit");
    case RiccatiFailure::residual:
      return add_error(findings, "kalman", "the Riccati equation is too ill conditioned to be solved");
  }
}

}  // namespace lqg::design
