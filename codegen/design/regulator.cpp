#include "design/regulator.hpp"

#include "design/checks.hpp"

namespace lqg::design {

RiccatiResult solve_regulator(const Problem& problem, const Samples& samples, const RealMatrix& start) {
  const SampledCost& cost = *samples.cost;
  if (problem.regulator->cost != Cost::continuous)
    return solve_discrete_riccati({samples.plant.A, samples.plant.B, cost.Q, cost.R, cost.N}, start);
  RiccatiResult result =
      solve_continuous_riccati({real(problem.plant.A), real(problem.plant.B), cost.Q, cost.R, cost.N}, start);
  if (result.failure == RiccatiFailure::none)
    result.closed = samples.plant.A - multiply(samples.plant.B, result.K);
  return result;
}

void explain_regulator(RiccatiFailure failure, Findings& findings) {
  switch (failure) {
    case RiccatiFailure::none:
      return;
    case RiccatiFailure::not_definite:
      return add_error(findings, "lqr.R",
                       "R + BᵀXB is not positive definite: some input costs nothing and does nothing");
    case RiccatiFailure::no_start:
      return add_error(
          findings, "lqr",
          "no stabilising gain was found: the plant is too close to one that cannot be stabilised");
    case RiccatiFailure::not_converged:
      return add_error(findings, "lqr",
                       "no stabilising gain is optimal: a closed-loop pole tends to the stability limit");
    case RiccatiFailure::residual:
      return add_error(findings, "lqr", "the Riccati equation is too ill conditioned to be solved");
  }
}

}  // namespace lqg::design
