// SPDX-License-Identifier: MIT
#include "design/gains/regulator.hpp"

#include "design/finding.hpp"
#include "design/sampled/delay_reduction.hpp"

namespace lqg::design {

namespace {

RiccatiResult solve_any(const Problem& problem, const RiccatiEquation& equation, const RealMatrix& start) {
  return problem.regulator->cost == Cost::continuous ? solve_continuous_riccati(equation, start)
                                                     : solve_discrete_riccati(equation, start);
}

SteadyRegulator solve_directly(const Problem& problem, const Samples& samples, const RealMatrix& start) {
  SteadyRegulator result;
  result.riccati = solve_any(problem, regulator_equation(problem, samples), start);
  if (result.riccati.failure == RiccatiFailure::none)
    result.poles = eigenvalues(regulated_loop(problem, samples.plant, result.riccati.K));
  return result;
}

// From the law of the plant with less delay; X is what it costs.
SteadyRegulator solve_postponed(const Problem& problem, const Samples& samples, const Prediction& prediction) {
  SteadyRegulator result = solve_directly(problem, prediction.samples, RealMatrix());
  if (result.riccati.failure != RiccatiFailure::none) return result;
  const RiccatiEquation e = regulator_equation(problem, samples);
  result.riccati.K = multiply(result.riccati.K, prediction.predict);
  result.riccati.closed = e.A - multiply(e.B, result.riccati.K);
  result.poles.resize(static_cast<std::size_t>(e.A.rows()), {Real(0), Real(0)});
  const std::optional<RealMatrix> X = prediction.is_exact
                                          ? cost_after_prediction(problem, e, prediction, result.riccati.X)
                                          : solve_stein(result.riccati.closed, step_cost(e, result.riccati.K));
  if (!X) result.riccati.failure = RiccatiFailure::residual;
  if (X) result.riccati.X = *X;
  return result;
}

}  // namespace

SteadyRegulator solve_regulator(const Problem& problem, const Samples& samples, const RealMatrix& start) {
  const std::optional<Prediction> prediction = without_whole_periods(problem, samples);
  if (!prediction) return solve_directly(problem, samples, start);
  if (!prediction->is_exact && start.size() > 0) return solve_directly(problem, samples, start);
  const SteadyRegulator postponed = solve_postponed(problem, samples, *prediction);
  if (prediction->is_exact || postponed.riccati.failure != RiccatiFailure::none) return postponed;
  return solve_directly(problem, samples, postponed.riccati.X);
}

RiccatiEquation deciding_equation(const Problem& problem, const Samples& samples) {
  const std::optional<Prediction> prediction = without_whole_periods(problem, samples);
  return regulator_equation(problem, prediction ? prediction->samples : samples);
}

RealMatrix regulated_loop(const Problem& problem, const SampledPlant& plant, const RealMatrix& K) {
  const RegulatedPlant z = regulated_plant(problem, plant);
  return z.A - multiply(z.B, K);
}

void explain_regulator(RiccatiFailure failure, Findings& findings) {
  switch (failure) {
    case RiccatiFailure::none: return;
    case RiccatiFailure::not_definite:
      return add_error(findings, "lqr.R",
                       "R + BᵀXB is not positive definite: some input costs nothing and does nothing");
    case RiccatiFailure::no_start:
      return add_error(findings, "lqr",
                       "no stabilising gain was found: the plant is too close to one that cannot be stabilised");
    case RiccatiFailure::not_converged:
      return add_error(findings, "lqr",
                       "no stabilising gain is optimal: a closed-loop pole tends to the stability limit");
    case RiccatiFailure::residual:
      return add_error(findings, "lqr", "the Riccati equation is too ill conditioned to be solved");
  }
}

}  // namespace lqg::design
