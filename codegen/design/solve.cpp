// SPDX-License-Identifier: MIT
#include "design/solve.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "design/checks/extended_rules.hpp"
#include "design/checks/order_rules.hpp"
#include "design/checks/representable.hpp"
#include "design/checks/requirements.hpp"
#include "design/checks/well_posed.hpp"
#include "design/loop/margins.hpp"
#include "design/loop/open_loop.hpp"
#include "design/loop/rms.hpp"
#include "design/loop/rounded_loop.hpp"
#include "design/numeric/poles.hpp"
#include "design/numeric/ziv_test.hpp"
#include "design/rounding.hpp"
#include "design/run/design_run.hpp"
#include "design/run/order_run.hpp"
#include "design/run/plausibility.hpp"
#include "design/run/sparse_gain_run.hpp"
#include "design/run/transfer_recovery.hpp"
#include "design/sampled/added_states.hpp"
#include "design/sampled/stages.hpp"
#include "design/solution_matrices.hpp"

namespace lqg::design {

namespace {

// Each run is judged by the next. 300 for what 200 digits cannot begin with and 400 need not double.
const std::array<unsigned, 5> runs = {50, 100, 200, 300, 400};

bool same(const Findings& a, const Findings& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Finding& x, const Finding& y) {
    return x.severity == y.severity && x.key == y.key && x.message == y.message;
  });
}

// The matrices and vectors of a solution in their order, as pointers.
struct Numbers {
  std::vector<const RealMatrix*> matrices;
  std::vector<const RealVector*> vectors;
  void operator()(const char*, Place, const RealMatrix& a) { matrices.push_back(&a); }
  void operator()(const char*, Place, const RealVector& a) { vectors.push_back(&a); }
};

Numbers numbers_of(const Solution& solution) {
  Numbers numbers;
  for_each_matrix(solution, [&](const char* name, Place place, const auto& a) { numbers(name, place, a); });
  return numbers;
}

// False, too, when one has more matrices: a schedule became longer.
bool matrices_pass_ziv_test(const Solution& coarse, Solution& fine, unsigned coarse_digits) {
  const Numbers before = numbers_of(coarse), after = numbers_of(fine);
  if (before.matrices.size() != after.matrices.size() || before.vectors.size() != after.vectors.size()) return false;
  std::size_t matrix = 0, vector = 0;
  bool settled = true;
  for_each_matrix(fine, [&](const char*, Place, auto& a) {
    if constexpr (std::is_same_v<decltype(a), RealMatrix&>)
      settled = passes_ziv_test(*before.matrices[matrix++], a, coarse_digits) && settled;
    else
      settled = passes_ziv_test(*before.vectors[vector++], a, coarse_digits) && settled;
  });
  return settled;
}

bool optional_passes_ziv_test(const std::optional<Real>& coarse, std::optional<Real>& fine, unsigned coarse_digits) {
  return !fine || (coarse && passes_ziv_test(*coarse, *fine, Real(0), coarse_digits));
}

bool run_passes_ziv_test(const DesignRun& coarse, DesignRun& fine, unsigned coarse_digits) {
  bool settled = matrices_pass_ziv_test(coarse.solution, fine.solution, coarse_digits);
  settled = passes_ziv_test(coarse.regulator_poles, fine.regulator_poles) && settled;
  settled = passes_ziv_test(coarse.estimator_poles, fine.estimator_poles) && settled;
  settled = passes_ziv_test(coarse.loop_poles, fine.loop_poles) && settled;
  settled = passes_ziv_test(coarse.compensator_poles, fine.compensator_poles) && settled;
  settled = optional_passes_ziv_test(coarse.full_cost, fine.full_cost, coarse_digits) && settled;
  settled = optional_passes_ziv_test(coarse.cost_per_sample, fine.cost_per_sample, coarse_digits) && settled;
  return optional_passes_ziv_test(coarse.cost_per_second, fine.cost_per_second, coarse_digits) && settled;
}

// Poles, costs, margins at the inputs and root mean squares.
void describe_loop(const Problem& problem, DesignRun& run, unsigned digits) {
  Solution& solution = run.solution;
  solution.numerics.digits = digits;
  solution.loop.poles = sorted_poles(run.loop_poles);
  if (solution.regulator) solution.regulator->poles = sorted_poles(run.regulator_poles);
  if (solution.estimator) solution.estimator->poles = sorted_poles(run.estimator_poles);
  if (run.cost_per_sample) solution.loop.cost_per_sample = to_double(*run.cost_per_sample);
  if (run.cost_per_second) solution.loop.cost_per_second = to_double(*run.cost_per_second);
  if (solution.compensator) solution.compensator->poles = sorted_poles(run.compensator_poles);
  if (solution.compensator && run.full_cost) solution.compensator->full_cost = to_double(*run.full_cost);
  if (!run.has_steady_loop) return;
  report_white_parameters(problem, run);
  const Compensator controller = compensator(problem, solution);
  const MeasuredPlant plant = measured_plant(problem, solution);
  solution.loop.at_input = margins(open_at_inputs(plant, controller), run.loop_poles);
  const Samples& around = run.stages.back().of_loop();
  if (around.noise) solution.loop.rms = steady_rms(problem, around, controller);
  if (!solution.loop.rms) return;
  std::vector<double>& of_states = solution.loop.rms->x;  // no disturbance is part of the noises
  of_states.insert(of_states.begin() + problem.plant.A.rows(), static_cast<std::size_t>(disturbance_count(problem)), 0);
}

void finish(const Problem& problem, DesignRun& run, unsigned digits, Findings& findings) {
  Solution& solution = run.solution;
  findings.insert(findings.end(), run.findings.begin(), run.findings.end());
  describe_loop(problem, run, digits);
  if (run.has_steady_loop) {
    if (solution.estimator)
      solution.loop.at_output =
          margins(open_at_outputs(measured_plant(problem, solution), compensator(problem, solution)), run.loop_poles);
    add_full_margins(problem, run);
  }
  check_representable(solution, problem.code.real, findings);
  check_rounded(problem, run.stages.back(), run.loop_poles, solution, findings);
  check_requirements(problem, solution, findings);
  if (!has_error(findings)) note_implausible(run.stages.back().problem, run, findings);
}

void check_matrices(const Problem& problem, Findings& findings) {
  check_symmetry(problem, findings);
  if (!has_error(findings)) check_definiteness(problem, findings);
}

}  // namespace

bool is_well_posed(const Problem& problem, Findings& findings) {
  check_kinds(problem, findings);
  check_order_and_white(problem, findings);
  check_extended(problem, findings);
  check_structure(problem, findings);
  check_recovery(problem, findings);
  check_matrices(problem, findings);
  const std::vector<Problem> problems = problems_of_stages(problem);
  for (std::size_t i = 1; i < problems.size() && !has_error(findings); ++i) {
    Findings of_stage;
    check_matrices(problems[i], of_stage);
    for (const Finding& finding : of_stage)
      findings.push_back(
          {finding.severity, "stage",
           "from step " + std::to_string(problem.stages[i - 1].from) + " on, " + finding.key + ": " + finding.message});
  }
  return !has_error(findings);
}

namespace {

// The pole nearest to the unit circle, and how near it is.
struct Nearest {
  ComplexReal pole = {Real(0), Real(0)};
  Real distance = 1;
};

Nearest nearest_to_circle(const std::vector<ComplexReal>& poles) {
  Nearest nearest;
  for (const ComplexReal& pole : poles) {
    const Real distance = abs(1 - hypot(pole.re, pole.im));
    if (distance < nearest.distance) nearest = {pole, distance};
  }
  return nearest;
}

// Do the poles keep away from the circle as they did with fewer digits? A pole that nears it has settled as a double on
// it long before it does as a number.
bool keeps_distance(const std::vector<ComplexReal>& coarse, const std::vector<ComplexReal>& fine) {
  return nearest_to_circle(fine).distance > nearest_to_circle(coarse).distance / 2;
}

// Which poles belong to a gain that has to be stabilising; one that is held at an end need not be.
bool is_for_ever(const std::optional<Regulator>& regulator) { return has_cost(regulator) && regulator->horizon == 0; }
bool is_for_ever(const std::optional<Estimator>& estimator) {
  return has_noise(estimator) && !(estimator->gain == Gain::schedule && estimator->horizon > 0);
}

bool keeps_distance(const Problem& problem, const DesignRun& coarse, const DesignRun& fine) {
  return (!is_for_ever(problem.regulator) || keeps_distance(coarse.regulator_poles, fine.regulator_poles)) &&
         (!is_for_ever(problem.estimator) || keeps_distance(coarse.estimator_poles, fine.estimator_poles));
}

// Has a pole no place but the circle to go to? From run to run it comes nearer, as near as the digits let it.
class Tendency {
 public:
  // True when that was so twice.
  bool continues(const std::vector<ComplexReal>& coarse, const std::vector<ComplexReal>& fine) {
    const Nearest now = nearest_to_circle(fine);
    const bool nearer = now.distance < 1e-9 && now.distance < 1e-4 * nearest_to_circle(coarse).distance;
    times_ = nearer ? times_ + 1 : 0;
    limit_ = now.pole;
    return times_ >= 2;
  }
  std::string pole() const { return short_complex(limit_, 1); }

 private:
  int times_ = 0;
  ComplexReal limit_ = {Real(0), Real(0)};
};

struct Tendencies {
  Tendency regulator, estimator;
};

// Refuses what no digits can settle: a solution that is not stabilising.
void check_tendencies(const Problem& problem, const DesignRun& coarse, const DesignRun& fine, Tendencies& tendencies,
                      Findings& findings) {
  const std::string limit = " on the stability limit: that mode carries no ";
  if (is_for_ever(problem.regulator) && tendencies.regulator.continues(coarse.regulator_poles, fine.regulator_poles))
    add_error(findings, "lqr.Q",
              "a closed-loop pole tends to z = " + tendencies.regulator.pole() + limit +
                  "weight, and no stabilising gain is optimal");
  if (is_for_ever(problem.estimator) && tendencies.estimator.continues(coarse.estimator_poles, fine.estimator_poles))
    add_error(findings, "kalman.process_noise",
              "a pole of the filter tends to z = " + tendencies.estimator.pole() + limit +
                  "noise, and no stable steady filter is optimal");
}

}  // namespace

namespace {

bool has_recovery(const Problem& problem) { return has_noise(problem.estimator) && problem.estimator->recovery; }

bool has_recovery_to_find(const Problem& problem) {
  return has_recovery(problem) && problem.estimator->recovery->is_automatic;
}

std::optional<Solution> solve_well_posed(const Problem& problem, Findings& findings) {
  std::optional<DesignRun> coarse;
  unsigned coarse_digits = 0;
  Tendencies tendencies;
  for (const unsigned digits : runs) {
    const Digits scope(digits);
    const bool has_start = coarse && !has_error(coarse->findings);
    DesignRun fine = run_design(problem, has_start ? &*coarse : nullptr);
    const bool failed = has_error(fine.findings);
    const bool refused = coarse && failed && !fine.may_want_digits && same(coarse->findings, fine.findings);
    if (refused || (failed && digits == runs.back())) {
      for (Finding finding : fine.findings) {
        if (fine.may_want_digits) finding.message += " (or " + std::to_string(digits) + " digits are too few to tell)";
        findings.push_back(finding);
      }
      return std::nullopt;
    }
    if (has_start && !failed && keeps_distance(problem, *coarse, fine) &&
        run_passes_ziv_test(*coarse, fine, coarse_digits)) {
      finish(problem, fine, digits, findings);
      if (has_error(findings)) return std::nullopt;
      return fine.solution;
    }
    if (has_start && !failed) check_tendencies(problem, *coarse, fine, tendencies, findings);
    if (has_error(findings)) return std::nullopt;
    coarse = std::move(fine);
    coarse_digits = digits;
  }
  add_error(findings, "design",
            "the problem is so ill conditioned that " + std::to_string(runs.back()) + " digits do not settle it");
  return std::nullopt;
}

}  // namespace

std::optional<Solution> solve(const Problem& problem, Findings& findings, const Progress& progress) {
  const ProgressScope reporting(progress);
  {
    const Digits scope(runs.front());
    if (!is_well_posed(problem, findings)) return std::nullopt;
  }
  const bool searches = has_recovery_to_find(problem);
  const std::optional<Problem> found = searches ? with_found_recovery(problem, findings) : problem;
  if (!found) return std::nullopt;
  std::optional<Solution> solution = solve_well_posed(*found, findings);
  if (!solution || !has_recovery(*found)) return solution;
  solution->loop.recovery = recovery_report(*found, solution->loop);
  note_recovery(*found, solution->loop, searches, findings);
  return solution;
}

Problem without_requirements(Problem problem) {
  const Requirements all = std::exchange(problem.requirements, Requirements());
  if (!has_recovery_to_find(problem)) return problem;
  Requirements& kept = problem.requirements;
  kept.gain_margin_dB = all.gain_margin_dB;
  kept.phase_margin_deg = all.phase_margin_deg;
  kept.disk_margin = all.disk_margin;
  kept.delay_margin = all.delay_margin;
  kept.max_pole = all.max_pole;
  return problem;
}

std::optional<Solution> first_look(const Problem& problem) {
  const Digits scope(runs.front());
  Findings findings;
  if (!is_well_posed(problem, findings)) return std::nullopt;
  const std::optional<Problem> found = has_recovery_to_find(problem) ? with_found_recovery(problem, findings) : problem;
  if (!found) return std::nullopt;
  DesignRun run = run_design(*found, nullptr);
  if (has_error(run.findings)) return std::nullopt;
  describe_loop(*found, run, runs.front());
  check_representable(run.solution, problem.code.real, findings);
  if (has_error(findings)) return std::nullopt;
  return run.solution;
}

}  // namespace lqg::design
