#include "design/loop/cost.hpp"

#include "design/equations/riccati.hpp"
#include "design/sampled/augmentation.hpp"
#include "design/sampled/noise.hpp"

namespace lqg::design {

namespace {

// [z; v] with z = [x; ξ; u[k−1]] and v = u or Δu, of x and u as they are, and of the controller's states.
RealMatrix regulated(const Problem& problem, const Compensator& controller, const RealMatrix& x,
                     const RealMatrix& u, const RealMatrix& states) {
  const RealMatrix z = above(x, states.middleRows(controller.estimates, controller.integrals));
  if (problem.regulator->input_rate.size() == 0) return above(z, u);
  const RealMatrix last = states.bottomRows(u.rows());
  return above(above(z, last), u - last);
}

// `covariance` of [z; v]; `error` of the part of x that v does not know.
SteadyCost cost_of(const Problem& problem, const Samples& samples, const Compensator& controller,
                   const RealMatrix& covariance, const RealMatrix& error) {
  const SampledCost weights = regulated_cost(problem, samples.between ? samples.between->cost : *samples.cost);
  const Index nx = samples.plant.A.rows();
  SteadyCost cost;
  cost.per_sample = trace_of_product(joint(weights.Q, weights.N, weights.R), covariance)
                    + trace_of_product(weights.Q.topLeftCorner(nx, nx), error);
  if (!samples.between) return cost;
  // E[w uᵀ] = Swv Dᵀ where the controller answers y at once; else u is older than v.
  Real between = samples.between->noise_cost;
  if (samples.between->u_noise.size() > 0)
    between += 2
               * trace_of_product(samples.between->u_noise,
                                  multiply_transpose(noise_of(problem).Swv, controller.D));
  cost.per_second = (cost.per_sample + between) / Real(problem.plant.sample_time);
  return cost;
}

}  // namespace

std::optional<SteadyCost> steady_cost(const Problem& problem, const Samples& samples,
                                      const Compensator& controller) {
  const SampledNoise& noise = *samples.noise;
  const Index nx = samples.plant.A.rows();
  const ClosedLoop loop = closed_loop(measured_plant(problem, samples.plant), controller);
  const RealMatrix disturbance = joint(noise.W, noise.Swv, noise.V);
  const std::optional<RealMatrix> states = solve_stein(loop.A.transpose(), congruence(loop.B, disturbance));
  if (!states) return std::nullopt;
  const Index all = loop.A.rows(), none = loop.D.cols();
  const auto seen = [&](const RealMatrix& one, const RealMatrix& u) {
    return regulated(problem, controller, one.topRows(nx), u, one.bottomRows(controller.A.rows()));
  };
  const RealMatrix covariance = congruence(seen(identity(all), loop.C), *states)
                                + congruence(seen(zeros(all, none), loop.D), disturbance);
  return cost_of(problem, samples, controller, covariance, zeros(nx, nx));
}

// y = e + C x̂⁻ + D u with the input that acts, so that s⁺ = (A + B Y) s + B e; E[e eᵀ] = S.
// x = x̂ + what is not correlated with anything that the controller knows.
std::optional<SteadyCost> steady_cost(const Problem& problem, const Samples& samples,
                                      const Compensator& controller, const EstimatorSolution& filter) {
  const SampledPlant& plant = samples.plant;
  const bool filtered = problem.estimator->form == Form::filter;
  const Index nx = plant.A.rows(), nu = plant.B.cols(), ns = controller.A.rows(), ny = plant.C.rows();
  const RealMatrix states = identity(ns);
  RealMatrix Y = multiply(plant.C, states.topRows(nx));
  if (!is_zero(plant.D)) Y += multiply(plant.D, filtered ? RealMatrix(states.bottomRows(nu)) : controller.C);
  const RealMatrix next = controller.A + multiply(controller.B, Y);
  const std::optional<RealMatrix> known = solve_stein(next.transpose(), congruence(controller.B, filter.S));
  if (!known) return std::nullopt;
  const RealMatrix none = zeros(ns, ny), corrected = filtered ? filter.L : zeros(nx, ny);
  const RealMatrix of_states =
      regulated(problem, controller, states.topRows(nx), controller.C + multiply(controller.D, Y), states);
  const RealMatrix of_innovation = regulated(problem, controller, corrected, controller.D, none);
  const RealMatrix covariance = congruence(of_states, *known) + congruence(of_innovation, filter.S);
  return cost_of(problem, samples, controller, covariance, filtered ? filter.P_posterior : filter.P_prior);
}

}  // namespace lqg::design
