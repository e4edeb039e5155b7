// SPDX-License-Identifier: MIT
#include "design/run/order_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "design/loop/cost.hpp"
#include "design/numeric/modes.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"
#include "design/run/compensator_form.hpp"
#include "design/run/continuous_compensator.hpp"
#include "design/run/white_parameters.hpp"
#include "design/sampled/augmentation.hpp"

namespace lqg::design {

namespace {

// Where the reader is led to: to the order, or to what makes the plant uncertain.
std::string key_of(const Problem& problem) {
  if (problem.compensator) return "compensator.order";
  if (!problem.uncertain.empty()) return "uncertain";
  return problem.plant.jitter > 0 ? "plant.jitter" : "plant.dropout";
}

// With as many digits as tell it from 1.
std::string factor(double growth) {
  char text[32];
  for (int digits = 5; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, growth);
    if (std::string(text) != "1") break;
  }
  return text;
}

void explain(const Problem& problem, const OrderProblem& order, int states, const OrderedCompensator& found,
             DesignRun& result) {
  const std::string which = "a compensator of " + std::to_string(states) + (states == 1 ? " state" : " states");
  const auto refuse = [&](const std::string& why) { add_error(result.findings, key_of(problem), why); };
  switch (found.failure) {
    case OrderFailure::none: return;
    case OrderFailure::no_stabilising_compensator:
      return refuse("expected a plant that " + which + " stabilises" +
                    (order.white.empty() ? "" : " in the mean square") + ", and none was found: " +
                    (order.is_continuous
                         ? "the best one reached leaves the loop stable only with all poles moved by " +
                               decimal(std::abs(found.discount)) + " 1/s to the left"
                         : "the best one reached does so where each sample multiplies second moments by " +
                               decimal(found.discount)) +
                    (order.white.empty() ? "; a larger order may do" : "; less uncertainty may do"));
    case OrderFailure::not_converged:
      result.may_want_digits = true;
      return refuse("the equations of " + which + " did not converge");
    case OrderFailure::not_strict:
      return refuse(which +
                    " of the least cost is not isolated: another one, or one with fewer states, costs the same");
  }
}

int order_of(const Problem& problem, const OrderProblem& order) {
  return problem.compensator ? problem.compensator->order : static_cast<int>(order.A.rows());
}

// The order problem's compensator does not find D u in y.
Compensator over_outputs_of_samples(const OrderedCompensator& found, const MeasuredPlant& plant) {
  Compensator controller = {found.A, found.B, found.C, found.D, found.A.rows(), 0};
  if (controller.D.size() == 0) controller.D = zeros(controller.C.rows(), plant.C.rows());
  if (!is_zero(plant.D)) controller.A -= multiply(controller.B, multiply(plant.D, controller.C));
  return controller;
}

bool is_flat(const OrderedCompensator& found) {
  return found.failure == OrderFailure::not_strict || found.failure == OrderFailure::not_converged;
}

// Where nobody asked for that order: the largest one whose minimum is isolated, if states beyond it change nothing that
// can be told.
OrderedCompensator with_fewer_states(const OrderProblem& order, const OrderedCompensator& full) {
  const int most = static_cast<int>(order.A.rows());
  const std::vector<OrderedCompensator> found = best_compensators(order, 1, most - 1);
  for (auto of = found.rbegin(); of != found.rend(); ++of)
    if (of->failure == OrderFailure::none) return *of;
  return full;
}

OrderedCompensator found_compensator(const Problem& problem, const OrderProblem& order, const DesignRun* coarser) {
  if (coarser && coarser->ordered) return polished_compensator(order, *coarser->ordered);
  const OrderedCompensator found = best_compensator(order, order_of(problem, order));
  return !problem.compensator && is_flat(found) ? with_fewer_states(order, found) : found;
}

void note_fewer_states(const Problem& problem, const OrderProblem& order, Index states, Findings& findings) {
  if (problem.compensator || states == order.A.rows()) return;
  add_note(findings, key_of(problem),
           "the compensator has " + std::to_string(states) + " states, not " + std::to_string(order.A.rows()) +
               ": with more of them the cost is too flat for a minimum that can be told from its neighbours");
}

void note_unstable(const std::vector<ComplexReal>& poles, Findings& findings) {
  for (const ComplexReal& pole : poles)
    if (on_or_outside_circle(pole))
      return add_note(findings, "compensator.order",
                      "the compensator by itself is unstable, with a pole at z = " + short_complex(pole, 1) +
                          ": only the plant's answers keep it in bounds, so start it with the plant, and reset it "
                          "where u does not reach the plant");
}

// `controller` in coordinates of no meaning, around the sampled plant.
void take_compensator(const Problem& problem, const Samples& samples, const OrderProblem& order,
                      const Compensator& controller, const OrderedCompensator& found, DesignRun& result) {
  const std::optional<CompensatorForm> form =
      in_estimates(order, measured_plant(problem, samples.plant), samples.plant.A.rows(), controller);
  if (!form) {
    result.may_want_digits = true;
    return add_error(result.findings, key_of(problem), "the loop is too near to being unstable");
  }
  CompensatorSolution& solution = result.solution.compensator.emplace();
  take_form(*form, solution);
  result.compensator_form = form->to;
  solution.cost = found.cost;
  solution.starts = found.starts, solution.reached = found.reached, solution.curvature = found.curvature;
  result.compensator_poles = eigenvalues(solution.A);
  note_unstable(result.compensator_poles, result.findings);
}

void run_sampled(const Problem& problem, const Samples& samples, const OrderProblem& order,
                 const OrderedCompensator& found, DesignRun& result) {
  if (const std::optional<SteadyCost> full = steady_cost(problem, samples, compensator(problem, result.solution)))
    result.full_cost = full->per_sample;
  const Compensator controller = over_outputs_of_samples(found, measured_plant(problem, samples.plant));
  take_compensator(problem, samples, order, controller, found, result);
  result.cost_per_sample = found.cost;
  if (samples.between)
    result.cost_per_second = (found.cost + samples.between->noise_cost) / Real(problem.plant.sample_time);
}

// The continuous one in the coordinates of the one that is emitted.
void run_held(const Problem& problem, const Samples& samples, const OrderedCompensator& found, DesignRun& result) {
  result.full_cost = cost_of_continuous_lqg(problem, result.solution);
  const Compensator continuous = over_outputs(problem, found), held = held_compensator(problem, continuous);
  if (!is_stable(eigenvalues(closed_loop(measured_plant(problem, samples.plant), held).A)))
    return add_error(result.findings, "lqr.cost",
                     "the continuous compensator, sampled exactly, does not stabilise the sampled plant: expected a "
                     "shorter plant.sample_time, or \"sampled\"");
  take_compensator(problem, samples, order_problem(problem, samples), held, found, result);
  if (has_error(result.findings)) return;
  const std::optional<SteadyCost> sampled = steady_cost(problem, samples, held);
  CompensatorSolution& solution = *result.solution.compensator;
  const RealMatrix &to = result.compensator_form, back = *solve(to, identity(to.rows()));
  solution.A_continuous = multiply(to, multiply(continuous.A, back));
  solution.B_continuous = multiply(to, continuous.B);
  solution.C_continuous = multiply(continuous.C, back);
  result.cost_per_second = found.cost;
  if (!sampled) return;
  result.cost_per_sample = sampled->per_sample;
  if (sampled->per_second) solution.held_cost_per_second = to_double(*sampled->per_second);
}

}  // namespace

void run_white_law(const Problem& problem, const Samples& samples, const RealMatrix& unaware, DesignRun& result) {
  const RiccatiEquation e = regulator_equation(problem, samples);
  const Index nx = e.A.rows();
  OrderProblem order;
  order.A = e.A, order.B = e.B, order.C = zeros(0, nx);
  order.Q = e.Q, order.N = e.N, order.R = e.R;
  order.W = zeros(nx, nx), order.Swv = zeros(nx, 0), order.V = zeros(0, 0);
  for (const WhiteParameter& white : white_parameters(problem, samples))
    order.white.push_back({white.A, white.B, zeros(0, nx)});
  const WhiteRegulator found = white_regulator(order);
  if (!found.exists)
    return add_error(result.findings, key_of(problem),
                     "expected a plant that can be stabilised in the mean square: whatever the law, its second "
                     "moments grow by a factor of " +
                         factor(found.growth) + " in a sample; less uncertainty may do");
  result.solution.regulator->K = found.K;
  result.solution.regulator->X = found.X;
  result.regulator_poles = eigenvalues(e.A - multiply(e.B, found.K));
  result.solution.white.emplace().K_unaware = unaware;
}

void add_noise_of_white_parameters(const Problem& problem, Samples& samples, Findings& findings) {
  const SampledPlant& plant = samples.plant;
  SampledNoise& noise = *samples.noise;
  const std::vector<WhiteParameter> parameters = white_parameters(problem, samples);
  RealMatrix W = congruence(plant.G, noise.W), Swv = multiply(plant.G, noise.Swv);
  std::vector<RealMatrix> Phi = {plant.A};
  for (const WhiteParameter& white : parameters) Phi.push_back(white.A);
  const double growth = growth_of(Phi);
  if (!(growth < 1))
    return add_error(findings, key_of(problem),
                     "expected a plant whose state has bounded second moments, which are noise to a filter alone: they "
                     "grow by a factor of " +
                         factor(growth) + " in a sample");
  const std::optional<RealMatrix> X = steady_second_moments(Phi, W);
  if (!X)
    return add_error(findings, key_of(problem), "the second moments of the state are too near to having no bound");
  for (const WhiteParameter& white : parameters) {
    W += congruence(white.A, *X);
    Swv += multiply(white.A, multiply_transpose(*X, white.C));
    noise.V += congruence(white.C, *X);
  }
  noise.W = W, noise.Swv = Swv;
  samples.plant.G = identity(plant.A.rows());
}

void run_compensator(const Problem& problem, const Samples& samples, const DesignRun* coarser, DesignRun& result) {
  const bool is_continuous = problem.regulator->cost == Cost::continuous;
  const OrderProblem order = is_continuous ? continuous_order_problem(problem) : order_problem(problem, samples);
  const OrderedCompensator found = found_compensator(problem, order, coarser);
  if (found.failure != OrderFailure::none) return explain(problem, order, order_of(problem, order), found, result);
  result.ordered = found;
  note_fewer_states(problem, order, found.A.rows(), result.findings);
  if (is_continuous) return run_held(problem, samples, found, result);
  run_sampled(problem, samples, order, found, result);
}

}  // namespace lqg::design
