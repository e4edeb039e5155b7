#include "design/cost.hpp"

#include "design/riccati.hpp"

namespace lqg::design {

namespace {

// The covariance of the estimate that u is made of. The innovations are white, so that
//   filter:     Σ = FΣFᵀ + ΓSΓᵀ of x̂⁻ with F = A − BK, Γ = FL + M; x̂ = x̂⁻ + L innovation has Σ + LSLᵀ
//   predictor:  the same of x̂⁻ with Γ = L_predictor
RealMatrix estimate_covariance(const SampledPlant& plant, const RealMatrix& K,
                               const EstimatorSolution& filter, Form form) {
  const RealMatrix closed = plant.A - multiply(plant.B, K);
  const bool filtered = form == Form::filter;
  const RealMatrix drive = filtered ? RealMatrix(multiply(closed, filter.L) + filter.M) : filter.L_predictor;
  const RealMatrix covariance = *solve_stein(closed.transpose(), congruence(drive, filter.S));
  return filtered ? RealMatrix(covariance + congruence(filter.L, filter.S)) : covariance;
}

// u = −Kx̂ and x − x̂ is not correlated with x̂:  tr((Q − NK − KᵀNᵀ + KᵀRK) E[x̂x̂ᵀ]) + tr(Q P).
Real cost_of(const SampledCost& cost, const RealMatrix& K, const RealMatrix& estimate,
             const RealMatrix& error) {
  const RealMatrix NK = multiply(cost.N, K);
  const RealMatrix weight = cost.Q - (NK + NK.transpose()) + transpose_congruence(K, cost.R);
  return trace_of_product(weight, estimate) + trace_of_product(cost.Q, error);
}

}  // namespace

SteadyCost steady_cost(const Problem& problem, const Samples& samples, const Solution& solution) {
  const EstimatorSolution& filter = *solution.estimator;
  const RealMatrix& K = solution.regulator->K;
  const Form form = problem.estimator->form;
  const RealMatrix estimate = estimate_covariance(solution.plant, K, filter, form);
  const RealMatrix& error = form == Form::filter ? filter.P_posterior : filter.P_prior;
  const SampledCost& weights = samples.between ? samples.between->cost : *samples.cost;
  SteadyCost cost;
  cost.per_sample = cost_of(weights, K, estimate, error);
  if (!samples.between) return cost;
  // u holds −K L v, so that E[w uᵀ] = −Swv LᵀKᵀ; in predictor form u is older than v.
  Real between = samples.between->noise_cost;
  if (form == Form::filter && samples.between->u_noise.size() > 0)
    between -= 2
               * trace_of_product(samples.between->u_noise,
                                  multiply(real(problem.estimator->Swv), multiply(K, filter.L).transpose()));
  cost.per_second = (cost.per_sample + between) / Real(problem.plant.sample_time);
  return cost;
}

}  // namespace lqg::design
