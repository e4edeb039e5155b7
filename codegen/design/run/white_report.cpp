// SPDX-License-Identifier: MIT
#include "design/loop/cost.hpp"
#include "design/loop/margins.hpp"
#include "design/rounding.hpp"
#include "design/run/order_run.hpp"
#include "design/run/white_parameters.hpp"

namespace lqg::design {

namespace {

Margins margins_of(const MeasuredPlant& plant, const Compensator& controller) {
  const std::vector<ComplexReal> poles = eigenvalues(closed_loop(plant, controller).A);
  return is_stable(poles) ? rough_margins(open_at_inputs(plant, controller), poles) : Margins();
}

// Of measured states: A − B K in the mean, A₁ − B₁ K of each parameter.
double growth_of_law(const std::vector<WhiteParameter>& parameters, const SampledPlant& plant, const RealMatrix& K) {
  std::vector<RealMatrix> Phi = {plant.A - multiply(plant.B, K)};
  for (const WhiteParameter& white : parameters) Phi.push_back(white.A - multiply(white.B, K));
  return growth_of(Phi);
}

void report_law(const Problem& problem, const Samples& samples, Solution& solution) {
  WhiteReport& white = *solution.white;
  const std::vector<WhiteParameter> parameters = white_parameters(problem, samples);
  white.growth = growth_of_law(parameters, samples.plant, solution.regulator->K);
  white.growth_unaware = growth_of_law(parameters, samples.plant, white.K_unaware);
  Solution unaware = solution;
  unaware.regulator->K = white.K_unaware;
  white.margins_unaware = margins_of(measured_plant(problem, unaware), compensator(problem, unaware));
}

void report_compensator(const Problem& problem, const Samples& samples, Solution& solution) {
  WhiteReport& white = solution.white.emplace();
  const OrderProblem order = order_problem(problem, samples);
  const MeasuredPlant plant = measured_plant(problem, samples.plant);
  Solution unaware = solution;
  unaware.compensator.reset();
  const Compensator own = compensator(problem, solution), lqg = compensator(problem, unaware);
  if (const std::optional<SteadyCost> cost = steady_cost(problem, samples, own))
    white.cost_nominal = to_double(cost->per_sample);
  white.growth = growth_of(white_loop(order, plant, own).Phi);
  white.growth_unaware = growth_of(white_loop(order, plant, lqg).Phi);
  white.margins_unaware = margins_of(plant, lqg);
  if (const std::optional<Real> cost = white_cost(order, plant, lqg)) white.cost_unaware = to_double(*cost);
}

}  // namespace

void report_white_parameters(const Problem& problem, DesignRun& run) {
  if (!problem.regulator || !has_white_parameters(problem)) return;
  const Digits enough(50);
  const Samples& samples = run.stages.back().of_loop();
  if (run.solution.compensator) return report_compensator(problem, samples, run.solution);
  report_law(problem, samples, run.solution);
}

}  // namespace lqg::design
