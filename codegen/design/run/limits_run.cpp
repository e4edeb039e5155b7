// SPDX-License-Identifier: MIT
#include "design/limits/limited_rows.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"
#include "design/run/design_run_parts.hpp"
#include "design/sampled/augmentation.hpp"

namespace lqg::design {

namespace {

// Of the numbers of the target: a violation that is none, as a share of the range; what is added to the diagonal of G
// of hard rows, and at least to that of soft ones, as a share of it. u of the sample at hand is exact either way. The
// last is 4 times what the target's solver takes for 0 (src/mpc.c).
struct Tolerances {
  double violation, softening, softness;
};
Tolerances tolerances_of(Scalar real) {
  return real == Scalar::float32 ? Tolerances{1e-4, 1e-6, 0x1p-18} : Tolerances{1e-12, 0, 0x1p-44};
}

// The optimum is that of one law for ever, with the cost that the law is optimal for.
void check_foreseeable(const Problem& problem, Findings& findings) {
  const auto needs = [&](bool good, const char* what) {
    if (!good) add_error(findings, "limits.horizon", what);
  };
  if (!has_cost(problem.regulator)) return needs(false, "needs [lqr]: placed poles have no cost that could be smallest");
  const Regulator& lqr = *problem.regulator;
  needs(lqr.horizon == 0 && problem.stages.empty(),
        "needs one plant and lqr.horizon = 0: limits are foreseen with a law that is the same in every sample");
  needs(lqr.cost != Cost::continuous,
        "needs lqr.cost = \"sampled\" or \"discrete\": the gain of a continuous cost is optimal for no cost of samples");
  needs(lqr.structure.size() == 0, "cannot be had with lqr.structure: that gain is optimal for no cost");
  needs(!lqr.integral,
        "cannot be had with lqr.integral: while a limit keeps y from r, an integral that is foreseen winds up");
}

// Of [x; u[k−1] with `input_rate`; r]: r stays, and u is kept.
struct Extended {
  RealMatrix A, B, K, C, D;
};

Extended extended(const Problem& problem, const SampledPlant& plant, const RegulatorSolution& regulator) {
  const Index nx = plant.A.rows(), nu = plant.B.cols(), last = problem.regulator->input_rate.size() > 0 ? nu : 0;
  const Index nr = regulator.Nbar.cols(), ns = nx + last + nr;
  Extended all{zeros(ns, ns), zeros(ns, nu), zeros(nu, ns), zeros(plant.C.rows(), ns), plant.D};
  all.A.topLeftCorner(nx, nx) = plant.A;
  all.A.bottomRightCorner(nr, nr) = identity(nr);
  all.B.topRows(nx) = plant.B;
  all.K.leftCols(nx + last) = regulator.K;
  if (last > 0) {
    all.B.middleRows(nx, nu) = identity(nu);
    all.K.middleCols(nx, nu) -= identity(nu);
  }
  if (nr > 0) all.K.rightCols(nr) = -regulator.Nbar;
  all.C.leftCols(nx) = plant.C;
  return all;
}

bool is_limited(const SoftLimits& limits, Index i) {
  return limits.range.size() > 0 && (std::isfinite(limits.range(i, 0)) || std::isfinite(limits.range(i, 1)));
}

LimitedQuantity quantity_of(const SoftLimits& limits, Index i, const RealMatrix& c, const RealMatrix& d,
                            const std::string& name) {
  return {c, d, false, Real(limits.range(i, 0)), Real(limits.range(i, 1)), Real(limits.price(i)), name};
}

std::vector<LimitedQuantity> quantities_of(const Problem& problem, const Extended& all) {
  const Limits& limits = *problem.limits;
  const Index ns = all.A.rows(), nu = all.B.cols();
  std::vector<LimitedQuantity> out;
  for (Index i = 0; i < limits.states.range.rows(); ++i)
    if (is_limited(limits.states, i))
      out.push_back(quantity_of(limits.states, i, identity(ns).row(i), zeros(1, nu),
                                problem.plant.states[static_cast<std::size_t>(i)].name));
  for (const SoftLimits* of_outputs : {&limits.outputs, &limits.output_rates})
    for (Index i = 0; i < of_outputs->range.rows(); ++i) {
      if (!is_limited(*of_outputs, i)) continue;
      out.push_back(quantity_of(*of_outputs, i, all.C.row(i), all.D.row(i),
                                problem.plant.outputs[static_cast<std::size_t>(i)].name));
      if (of_outputs == &limits.outputs) continue;
      out.back().is_change = true;
      out.back().low *= problem.plant.sample_time;
      out.back().high *= problem.plant.sample_time;
    }
  return out;
}

RealVector reals(const Eigen::VectorXd& values) {
  RealVector out(values.size());
  for (Index i = 0; i < values.size(); ++i) out(i) = values(i);
  return out;
}

std::vector<int> blocks_of(const Limits& limits) {
  if (!limits.blocks.empty()) return limits.blocks;
  const bool has_single_steps = limits.u_rate.size() > 0 || limits.states.range.size() > 0 ||
                                limits.outputs.range.size() > 0 || limits.output_rates.range.size() > 0;
  return default_blocks(limits.horizon, has_single_steps);
}

LimitedProblem limited_problem(const Problem& problem, const Samples& samples, const RegulatorSolution& regulator) {
  const Limits& limits = *problem.limits;
  const Extended all = extended(problem, samples.plant, regulator);
  const RiccatiEquation equation = regulator_equation(problem, samples);
  const Tolerances tolerances = tolerances_of(problem.code.real);
  LimitedProblem out{all.A, all.B, all.K, equation.R + transpose_congruence(equation.B, regulator.X),
                     blocks_of(limits), reals(limits.u_min), reals(limits.u_max),
                     reals(limits.u_rate * problem.plant.sample_time), reals(limits.u_rate_price),
                     quantities_of(problem, all), Real(tolerances.violation), Real(tolerances.softening)};
  out.softness = tolerances.softness;
  out.decay = decay_of(problem);
  for (const Signal& input : problem.plant.inputs) out.inputs.push_back(input.name);
  return out;
}

// Prices that the target cannot tell from infinite ones.
void note_prices(const LimitedRows& rows, Scalar real, Findings& findings) {
  std::optional<Real> least;
  for (std::size_t i = 0; i < rows.price.size(); ++i)
    if (rows.is_cheaper[i] && (!least || *rows.price[i] < *least)) least = rows.price[i];
  if (least)
    add_note(findings, "limits.price",
             "an excess is not as dear as asked for: with a higher price than " + short_number(to_double(*least)) + " " +
                 (real == Scalar::float32 ? "float" : "double") + " cannot tell soft limits from hard ones");
}

}  // namespace

void run_limits(const Problem& problem, const Samples& samples, DesignRun& result) {
  check_foreseeable(problem, result.findings);
  if (has_error(result.findings)) return;
  result.solution.foreseen = limited_rows(limited_problem(problem, samples, *result.solution.regulator));
  constexpr Index most_rows = 255;
  const LimitedRows* const rows = result.solution.foreseen ? &*result.solution.foreseen : nullptr;
  if (rows == nullptr)
    add_error(result.findings, "lqr.R", "R + BᵀXB is not positive definite: some input costs nothing and does nothing");
  else if (rows->G.rows() > most_rows)
    add_error(result.findings, "limits.horizon",
              "expected at most " + std::to_string(most_rows) + " limits that are looked at, found " +
                  std::to_string(rows->G.rows()) + ": choose a shorter horizon, or longer blocks");
  else
    note_prices(*rows, problem.code.real, result.findings);
}

}  // namespace lqg::design
