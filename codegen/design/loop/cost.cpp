// SPDX-License-Identifier: MIT
#include "design/loop/cost.hpp"

#include "design/equations/refined_stein.hpp"
#include "design/equations/riccati.hpp"
#include "design/numeric/chains.hpp"
#include "design/sampled/augmentation.hpp"
#include "design/sampled/noise.hpp"

namespace lqg::design {

namespace {

// [z; v] with z = [x; ξ; u[k−1]] and v = u or Δu, of x and u as they are, and of the controller's states.
RealMatrix regulated(const Problem& problem, const Compensator& controller, const RealMatrix& x, const RealMatrix& u,
                     const RealMatrix& states) {
  const RealMatrix z = above(x, states.middleRows(controller.estimates, controller.integrals));
  if (problem.regulator->input_rate.size() == 0) return above(z, u);
  const RealMatrix last = states.bottomRows(u.rows());
  return above(above(z, last), u - last);
}

SampledCost weights_of_loop(const Problem& problem, const Samples& samples) {
  return regulated_cost(problem, samples.between ? samples.between->cost : *samples.cost);
}

// What [z; v] of this covariance costs.
Real cost_of(const Problem& problem, const Samples& samples, const RealMatrix& covariance) {
  const SampledCost weights = weights_of_loop(problem, samples);
  return trace_of_product(joint(weights.Q, weights.N, weights.R), covariance);
}

// From what a sample costs by what the controller knows, and the `error` of the part of x that it does not.
SteadyCost with_error(const Problem& problem, const Samples& samples, const Compensator& controller, const Real& known,
                      const RealMatrix& error) {
  const SampledCost weights = weights_of_loop(problem, samples);
  const Index nx = samples.plant.A.rows();
  SteadyCost cost;
  cost.per_sample = known + trace_of_product(weights.Q.topLeftCorner(nx, nx), error);
  if (!samples.between) return cost;
  // E[w uᵀ] = Swv Dᵀ where the controller answers y at once; else u is older than v.
  Real between = samples.between->noise_cost;
  if (samples.between->u_noise.size() > 0)
    between += 2 * trace_of_product(samples.between->u_noise, multiply_transpose(noise_of(problem).Swv, controller.D));
  cost.per_second = (cost.per_sample + between) / Real(problem.plant.sample_time);
  return cost;
}

}  // namespace

std::optional<SteadyCost> steady_cost(const Problem& problem, const Samples& samples, const Compensator& controller) {
  const SampledNoise& noise = *samples.noise;
  const Index nx = samples.plant.A.rows();
  const ClosedLoop loop = closed_loop(measured_plant(problem, samples.plant), controller);
  const RealMatrix disturbance = joint(noise.W, noise.Swv, noise.V);
  const Merged merged = with_equal_states_merged(loop.A, loop.B);
  const std::optional<RealMatrix> states = refined_stein(merged.A.transpose(), congruence(merged.B, disturbance));
  if (!states) return std::nullopt;
  const Index all = loop.A.rows(), none = loop.D.cols();
  const auto seen = [&](const RealMatrix& one, const RealMatrix& u) {
    return regulated(problem, controller, one.topRows(nx), u, one.bottomRows(controller.A.rows()));
  };
  const RealMatrix covariance = congruence(seen(merged.spread, multiply(loop.C, merged.spread)), *states) +
                                congruence(seen(zeros(all, none), loop.D), disturbance);
  return with_error(problem, samples, controller, cost_of(problem, samples, covariance), zeros(nx, nx));
}

namespace {

// Is X what the loop costs from any state on? Its weights are those of the samples then, and its K acts for ever.
bool is_cost_to_go(const Problem& problem, const SampledPlant& plant) {
  const Regulator& lqr = *problem.regulator;
  return lqr.cost != Cost::continuous && lqr.horizon == 0 && decay_of(problem) == 1 && is_separated(problem, plant);
}

}  // namespace

// y = e + C x̂⁻ + D u with the input that acts, so that s⁺ = (A + B Y) s + B e; E[e eᵀ] = S.
// x = x̂ + what is not correlated with anything that the controller knows.
std::optional<SteadyCost> steady_cost(const Problem& problem, const Samples& samples, const Compensator& controller,
                                      const Solution& solution) {
  const SampledPlant& plant = samples.plant;
  const EstimatorSolution& filter = *solution.estimator;
  const bool filtered = problem.estimator->form == Form::filter;
  const Index nx = plant.A.rows(), nu = plant.B.cols(), ns = controller.A.rows(), ny = plant.C.rows();
  const RealMatrix none = zeros(ns, ny), corrected = filtered ? filter.L : zeros(nx, ny);
  const RealMatrix of_innovation = regulated(problem, controller, corrected, controller.D, none);
  const RealMatrix disturbance = congruence(controller.B, filter.S);
  Real known = cost_of(problem, samples, congruence(of_innovation, filter.S));
  if (is_cost_to_go(problem, plant)) {
    known += trace_of_product(padded(solution.regulator->X, ns, ns), disturbance);
  } else {
    const RealMatrix states = identity(ns);
    RealMatrix Y = multiply(plant.C, states.topRows(nx));
    if (!is_zero(plant.D)) Y += multiply(plant.D, filtered ? RealMatrix(states.bottomRows(nu)) : controller.C);
    const RealMatrix next = controller.A + multiply(controller.B, Y);
    const std::optional<RealMatrix> covariance = solve_stein(next.transpose(), disturbance);
    if (!covariance) return std::nullopt;
    const RealMatrix of_states =
        regulated(problem, controller, states.topRows(nx), controller.C + multiply(controller.D, Y), states);
    known += cost_of(problem, samples, congruence(of_states, *covariance));
  }
  return with_error(problem, samples, controller, known, filtered ? filter.P_posterior : filter.P_prior);
}

}  // namespace lqg::design
