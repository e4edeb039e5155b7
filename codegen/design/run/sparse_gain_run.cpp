// SPDX-License-Identifier: MIT
#include "design/run/sparse_gain_run.hpp"

#include "design/equations/sparse_gain.hpp"
#include "design/finding.hpp"
#include "design/gains/regulator.hpp"
#include "design/loop/compensator.hpp"
#include "design/loop/margins.hpp"
#include "design/numeric/modes.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"
#include "design/sampled/augmentation.hpp"

namespace lqg::design {

namespace {

// What the process noise adds to z in a sample, when it comes to reach all of it under the full gain.
RealMatrix disturbance(const Samples& samples, const RiccatiEquation& e, const RealMatrix& full) {
  const Index nz = e.A.rows();
  if (!samples.noise) return identity(nz);
  const RealMatrix W = padded(congruence(samples.plant.G, samples.noise->W), nz, nz);
  const Unreached still = unreached_sampled_modes(e.A - multiply(e.B, full), W);
  return still.dimension == 0 ? W : identity(nz);
}

void explain(const StructureProblem& problem, const StructuredGain& gain, const std::string& key, DesignRun& result) {
  if (gain.failure == StructureFailure::not_converged) {
    result.may_want_digits = true;
    return add_error(result.findings, key,
                     "the best gain of this structure is not isolated: some entry makes no difference");
  }
  const std::vector<ComplexReal> fixed = fixed_unstable_modes(problem);
  if (fixed.empty()) return add_error(result.findings, key, "no stable gain of this structure was found");
  for (const ComplexReal& mode : fixed)
    add_error(result.findings, key,
              "the mode at z = " + short_complex(mode, 1) +
                  " is moved by no gain of this structure: it cannot be stabilised");
}

// The filter's two forms as one dual problem: K = Lᵀ and X the posterior covariance, or K = L_predictorᵀ and X the
// prior one. Filter form, with w freed of what v tells of it, w', and M0 = G Swv V⁻¹:
//   e⁺ = (I − LC)((A − M0 C) e + G w') − L v.
struct DualFilter {
  RiccatiEquation equation;
  RealMatrix M0, A_free, W_free;  // of the filter form
};

DualFilter dual_filter(const Samples& samples, Form form) {
  const SampledPlant own = own_plant(samples);
  const SampledNoise& noise = *samples.noise;
  const RealMatrix cross = multiply(own.G, noise.Swv), GWG = congruence(own.G, noise.W);
  if (form == Form::predictor) return {{own.A.transpose(), own.C.transpose(), GWG, noise.V, cross}, {}, {}, {}};
  DualFilter dual;
  dual.M0 = solve(noise.V, cross.transpose())->transpose();
  dual.A_free = own.A - multiply(dual.M0, own.C);
  dual.W_free = symmetric_part(GWG - multiply_transpose(dual.M0, cross));
  dual.equation = {dual.A_free.transpose(), multiply(own.C, dual.A_free).transpose(), dual.W_free,
                   noise.V + congruence(own.C, dual.W_free), multiply_transpose(dual.W_free, own.C)};
  return dual;
}

// 1 over the variances of the full filter.
RealMatrix unit_variances(const RealMatrix& P) {
  RealMatrix weight = identity(P.rows());
  for (Index i = 0; i < P.rows(); ++i)
    if (P(i, i) > 0) weight(i, i) = 1 / P(i, i);
  return weight;
}

// All of the filter with the gain that was found; the inputs on their way have no gain and no error.
EstimatorSolution filter_with(const Samples& samples, Form form, const DualFilter& dual, const StructuredGain& found) {
  const SampledPlant own = own_plant(samples);
  const Index all = samples.plant.A.rows(), ny = own.C.rows();
  const RealMatrix gain = found.K.transpose();
  const bool filtered = form == Form::filter;
  EstimatorSolution filter;
  filter.noise = *samples.noise;
  const RealMatrix prior = filtered ? RealMatrix(congruence(dual.A_free, found.X) + dual.W_free) : found.X;
  filter.S = filter.noise.V + congruence(own.C, prior);
  const RealMatrix best = solve(filter.S, multiply(own.C, prior))->transpose();
  const RealMatrix posterior = filtered ? found.X : RealMatrix(prior - congruence(best, filter.S));
  const RealMatrix answer = identity(ny) - multiply(own.C, gain);
  filter.P_prior = padded(prior, all, all);
  filter.P_posterior = padded(posterior, all, all);
  filter.L = filtered ? padded(gain, all, ny) : zeros(all, ny);
  filter.M = padded(filtered ? multiply(dual.M0, answer) : gain, all, ny);
  filter.L_predictor = multiply(samples.plant.A, filter.L) + filter.M;
  return filter;
}

}  // namespace

void check_structure(const Problem& problem, Findings& findings) {
  if (problem.regulator && problem.regulator->structure.size() > 0) {
    const Regulator& lqr = *problem.regulator;
    const std::string key = "lqr.structure";
    if (lqr.structure.isZero(0)) add_error(findings, key, "keeps no entry: expected a 1 somewhere");
    if (lqr.cost == Cost::continuous)
      add_error(findings, key,
                "needs cost = \"sampled\" or \"discrete\": the cost of a continuous gain is not that of its loop");
    if (lqr.horizon > 0 || !problem.stages.empty())
      add_error(findings, key, "needs a gain that stays the same: no horizon, no stages");
  }
  if (!problem.estimator || problem.estimator->structure.size() == 0) return;
  const std::string key = "kalman.structure";
  if (problem.estimator->structure.isZero(0)) add_error(findings, key, "keeps no entry: expected a 1 somewhere");
  if (problem.estimator->gain != Gain::steady || !problem.stages.empty())
    add_error(findings, key, "needs gain = \"steady\" and no stages: the other gains have no structure");
}

void keep_regulator_structure(const Problem& problem, const Samples& samples, const DesignRun* coarser,
                              DesignRun& result) {
  RegulatorSolution& regulator = *result.solution.regulator;
  const RealMatrix full = regulator.K, full_X = regulator.X;
  StructureProblem structured = {
      regulator_equation(problem, samples), {}, Eigen::MatrixXd::Ones(full.rows(), full.cols())};
  structured.kept.leftCols(problem.regulator->structure.cols()) = problem.regulator->structure;
  structured.W = disturbance(samples, structured.equation, full);
  const StructuredGain found = structured_gain(structured, full, coarser ? coarser->own_law->K : RealMatrix());
  if (found.failure != StructureFailure::none) return explain(structured, found, "lqr.structure", result);
  StructureReport& report = regulator.structure.emplace();
  report.full = full;
  report.full_poles = sorted_poles(result.regulator_poles);
  report.cost_ratio = to_double(trace_of_product(found.X, structured.W) / trace_of_product(full_X, structured.W));
  regulator.K = found.K;
  regulator.X = found.X;
  result.regulator_poles = eigenvalues(regulated_loop(problem, samples.plant, found.K));
}

void keep_estimator_structure(const Problem& problem, const Samples& samples, const DesignRun* coarser,
                              DesignRun& result) {
  const Form form = problem.estimator->form;
  const bool filtered = form == Form::filter;
  const Index own = samples.own_states;
  const EstimatorSolution full = *result.solution.estimator;
  const DualFilter dual = dual_filter(samples, form);
  const auto gain_of = [&](const EstimatorSolution& filter) {
    return RealMatrix((filtered ? filter.L : filter.L_predictor).topRows(own).transpose());
  };
  const RealMatrix full_P = (filtered ? full.P_posterior : full.P_prior).topLeftCorner(own, own);
  const StructureProblem structured = {dual.equation, unit_variances(full_P), problem.estimator->structure.transpose()};
  const StructuredGain found =
      structured_gain(structured, gain_of(full), coarser ? gain_of(*coarser->solution.estimator) : RealMatrix());
  if (found.failure != StructureFailure::none) return explain(structured, found, "kalman.structure", result);
  result.solution.estimator = filter_with(samples, form, dual, found);
  StructureReport& report = result.solution.estimator->structure.emplace();
  report.full = filtered ? full.L : full.L_predictor;
  report.full_poles = sorted_poles(result.estimator_poles);
  report.cost_ratio = to_double(trace_of_product(found.X, structured.W) / trace_of_product(full_P, structured.W));
  result.full_filter = full;
  result.estimator_poles = eigenvalues(dual.equation.A - multiply(dual.equation.B, found.K));
  result.estimator_poles.resize(static_cast<std::size_t>(samples.plant.A.rows()), {Real(0), Real(0)});
}

namespace {

Margins margins_of(const Problem& problem, const Solution& solution) {
  const MeasuredPlant plant = measured_plant(problem, solution);
  const Compensator controller = compensator(problem, solution);
  const OpenLoop loop = open_at_inputs(plant, controller);
  return margins(loop, eigenvalues(loop.A - multiply(loop.B, loop.C)));
}

}  // namespace

void add_full_margins(const Problem& problem, DesignRun& run) {
  Solution& solution = run.solution;
  if (!solution.regulator) return;
  if (solution.regulator->structure) {
    Solution other = solution;
    other.regulator->K = solution.regulator->structure->full;
    solution.regulator->structure->full_margins = margins_of(problem, other);
  }
  if (run.full_filter && solution.estimator->structure) {
    Solution other = solution;
    other.estimator = run.full_filter;
    solution.estimator->structure->full_margins = margins_of(problem, other);
  }
}

}  // namespace lqg::design
