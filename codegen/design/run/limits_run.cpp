// SPDX-License-Identifier: MIT
#include <algorithm>

#include "design/limits/limited_rows.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"
#include "design/run/design_run_parts.hpp"
#include "design/sampled/added_states.hpp"
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

std::vector<int> blocks_of(const Limits& limits) {
  if (!limits.blocks.empty()) return limits.blocks;
  const bool has_single_steps = limits.u_rate.size() > 0 || limits.states.range.size() > 0 ||
                                limits.outputs.range.size() > 0 || limits.output_rates.range.size() > 0;
  return default_blocks(limits.horizon, has_single_steps);
}

bool is_limited(const SoftLimits& limits, Index i) {
  return limits.range.size() > 0 && (std::isfinite(limits.range(i, 0)) || std::isfinite(limits.range(i, 1)));
}

// Those that some input can move: at most all limits in the first sample of each block.
constexpr Index most_rows = 255;

Index limited(const SoftLimits& limits) {
  Index count = 0;
  for (Index i = 0; i < limits.range.rows(); ++i) count += is_limited(limits, i);
  return count;
}

Index most_rows_of(const Problem& problem) {
  const Limits& limits = *problem.limits;
  const Index later = static_cast<Index>(blocks_of(limits).size()) - 1;
  Index inputs = limits.u_rate.size();
  for (Index i = 0; i < limits.u_min.size(); ++i)
    inputs += std::isfinite(limits.u_min(i)) || std::isfinite(limits.u_max(i));
  return problem.plant.B.cols() +
         later * (inputs + limited(limits.states) + limited(limits.outputs) + limited(limits.output_rates));
}

// The optimum is that of one law for ever, with the cost that the law is optimal for.
void check_foreseeable(const Problem& problem, Findings& findings) {
  const auto needs = [&](bool good, const char* what) {
    if (!good) add_error(findings, "limits.horizon", what);
  };
  if (!has_cost(problem.regulator))
    return needs(false, "needs [lqr]: placed poles have no cost that could be smallest");
  const Regulator& lqr = *problem.regulator;
  needs(lqr.horizon == 0 && problem.stages.empty(),
        "needs one plant and lqr.horizon = 0: limits are foreseen with a law that is the same in every sample");
  needs(
      lqr.cost != Cost::continuous,
      "needs lqr.cost = \"sampled\" or \"discrete\": the gain of a continuous cost is optimal for no cost of samples");
  needs(lqr.structure.size() == 0, "cannot be had with lqr.structure: that gain is optimal for no cost");
  needs(!lqr.integral,
        "cannot be had with lqr.integral: while a limit keeps y from r, an integral that is foreseen winds up");
  const std::vector<Index> late = periods_of_outputs(problem.plant);
  for (const SoftLimits* of_outputs : {&problem.limits->outputs, &problem.limits->output_rates})
    for (Index i = 0; i < of_outputs->range.rows(); ++i)
      needs(!is_limited(*of_outputs, i) || late[static_cast<std::size_t>(i)] == 0,
            "foresees no limits of outputs that come late (plant.output_delay): limit the states that they measure");
  const Index rows = most_rows_of(problem);
  needs(rows <= most_rows, ("expected at most " + std::to_string(most_rows) + " limits that are looked at, found " +
                            std::to_string(rows) + ": choose a shorter horizon, or longer blocks")
                               .c_str());
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

// Libraries may leave out the names of a file.
std::string name_of_limited(const std::vector<Signal>& signals, Index i, const char* letter) {
  const std::size_t at = static_cast<std::size_t>(i);
  return at < signals.size() ? signals[at].name : letter + std::to_string(i);
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
                                name_of_limited(problem.plant.states, i, "x")));
  for (const SoftLimits* of_outputs : {&limits.outputs, &limits.output_rates})
    for (Index i = 0; i < of_outputs->range.rows(); ++i) {
      if (!is_limited(*of_outputs, i)) continue;
      out.push_back(
          quantity_of(*of_outputs, i, all.C.row(i), all.D.row(i), name_of_limited(problem.plant.outputs, i, "y")));
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

LimitedProblem limited_problem(const Problem& problem, const Samples& samples, const RegulatorSolution& regulator) {
  const Limits& limits = *problem.limits;
  const Extended all = extended(problem, samples.plant, regulator);
  const RiccatiEquation equation = regulator_equation(problem, samples);
  const Tolerances tolerances = tolerances_of(problem.code.real);
  LimitedProblem out{all.A,
                     all.B,
                     all.K,
                     equation.R + transpose_congruence(equation.B, regulator.X),
                     blocks_of(limits),
                     reals(limits.u_min),
                     reals(limits.u_max),
                     reals(limits.u_rate * problem.plant.sample_time),
                     reals(limits.u_rate_price),
                     quantities_of(problem, all),
                     Real(tolerances.violation),
                     Real(tolerances.softening)};
  out.softness = tolerances.softness;
  out.decay = decay_of(problem);
  for (const Signal& input : problem.plant.inputs) out.inputs.push_back(input.name);
  return out;
}

// Prices of states and outputs that the target cannot tell from infinite ones.
void note_prices(const Problem& problem, const LimitedRows& rows, Findings& findings) {
  const auto is_of_input = [&](const std::string& name) {
    return std::any_of(problem.plant.inputs.begin(), problem.plant.inputs.end(),
                       [&](const Signal& input) { return name == "change of " + input.name; });
  };
  std::size_t least = rows.price.size();
  for (std::size_t i = 0; i < rows.price.size(); ++i)
    if (rows.is_cheaper[i] && !is_of_input(rows.names[i]) &&
        (least == rows.price.size() || *rows.price[i] < *rows.price[least]))
      least = i;
  if (least == rows.price.size()) return;
  const std::string real = problem.code.real == Scalar::float32 ? "float" : "double";
  add_note(findings, "limits.price",
           "an excess of " + rows.names[least] + " counts with the price " +
               short_number(to_double(*rows.price[least])) + ": beyond it " + real +
               " cannot tell a soft limit from a hard one");
}

}  // namespace

void run_limits(const Problem& problem, const Samples& samples, DesignRun& result) {
  check_foreseeable(problem, result.findings);
  if (has_error(result.findings)) return;
  result.solution.foreseen = limited_rows(limited_problem(problem, samples, *result.solution.regulator));
  if (!result.solution.foreseen)
    return add_error(result.findings, "lqr.R",
                     "R + BᵀXB is not positive definite: some input costs nothing and does nothing");
  note_prices(problem, *result.solution.foreseen, result.findings);
}

}  // namespace lqg::design
