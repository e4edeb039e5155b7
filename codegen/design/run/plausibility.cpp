// SPDX-License-Identifier: MIT
#include "design/run/plausibility.hpp"

#include <algorithm>
#include <cmath>

#include "design/loop/compensator.hpp"
#include "design/loop/open_loop.hpp"
#include "design/numeric/digits.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"
#include "design/sampled/added_states.hpp"
#include "design/sampled/augmentation.hpp"
#include "design/sampled/reference.hpp"
#include "design/sampled/weights.hpp"

namespace lqg::design {

namespace {

Real size_of(const ComplexReal& pole) { return hypot(pole.re, pole.im); }

// A sampled mode has a negative z only where it oscillates faster than the samples, and then it comes in pairs.
void note_domain(const Problem& problem, Findings& findings) {
  if (problem.plant.domain == Domain::continuous) return;
  for (const ComplexReal& z : eigenvalues(real(problem.plant.A)))
    if (z.im.is_zero() && z.re < -1)
      add_note(findings, "plant.domain",
               "the plant's mode at z = " + short_complex(z, 1) +
                   " grows and changes its sign with every sample, as no plant does that was sampled: is A that of a "
                   "continuous plant?");
}

// s of a plant that changes much within a sample: beyond half a turn, unless it is over then, or more than e-fold.
bool is_too_fast(const ComplexReal& s, double sample_time) {
  const double turns = std::abs(to_double(s.im)) * sample_time / std::acos(-1.0);
  const double growth = to_double(s.re) * sample_time;
  return growth > 1 || (turns > 1 && growth > std::log(0.01));
}

void note_fast_modes(const Problem& problem, Findings& findings) {
  if (problem.plant.domain == Domain::discrete) return;
  for (const ComplexReal& s : eigenvalues(real(problem.plant.A)))
    if (s.im >= 0 && is_too_fast(s, problem.plant.sample_time))
      add_note(
          findings, "plant.sample_time",
          "the plant's mode at s = " + short_complex(s, 1) +
              (s.re * problem.plant.sample_time > 1 ? " grows more than e-fold" : " turns more than half a circle") +
              " within a sample: sample faster, or look at the units of the time");
}

// Of the poles that are not those of inputs on their way.
void note_settling(const Problem& problem, const DesignRun& run, Findings& findings) {
  Real slowest = 0;
  for (const ComplexReal& pole : run.regulator_poles) slowest = std::max<Real>(slowest, size_of(pole));
  if (has_cost(problem.regulator) && problem.regulator->horizon == 0 && slowest < 0.01)
    add_note(findings, problem.regulator->settling_time ? "lqr.settling_time" : "plant.sample_time",
             "the regulator settles to 1 % within one sample (its slowest pole has |z| = " +
                 short_number(to_double(slowest)) +
                 "): it is asked for more than these samples can do; look at Q beside R, and at the units of the time");
  Real fastest = 0;
  for (const ComplexReal& pole : run.loop_poles)
    fastest = std::max<Real>(
        fastest, size_of(pole).is_zero() ? Real(1) : Real(hypot(log(size_of(pole)), atan2(pole.im, pole.re))));
  if (!run.loop_poles.empty() && fastest < 1e-3)
    add_note(findings, "plant.sample_time",
             "the fastest pole of the loop takes " + short_number(std::round(to_double(1 / fastest))) +
                 " samples for its time constant, where 10 to 100 are enough: look at the units of the time");
}

// u acts a sample later than the design knows.
bool is_stable_when_late(const OpenLoop& loop) {
  const Index n = loop.A.rows(), nu = loop.B.cols();
  if (n > 100) return true;  // its poles would take as long as the rest of the design
  const RealMatrix late = above(beside(loop.A, loop.B), beside(-loop.C, zeros(nu, nu)));
  const Digits enough(std::max(50u, Real::default_precision() / 2));
  for (const ComplexReal& pole : eigenvalues(in_present_digits(late)))
    if (!(size_of(pole) < 1)) return false;
  return true;
}

std::string key_of_law(const Problem& problem) { return has_cost(problem.regulator) ? "lqr" : "pole_placement"; }

void note_margins(const Problem& problem, const DesignRun& run, Findings& findings) {
  if (!run.has_steady_loop) return;
  const Margins& margins = run.solution.loop.at_input;
  const std::string end = ": look at the weights, the plant's units and plant.delay";
  const OpenLoop loop = open_at_inputs(measured_plant(problem, run.solution), compensator(problem, run.solution));
  if (!is_stable_when_late(loop))
    add_note(
        findings, key_of_law(problem),
        "the loop is unstable when u comes one sample later than the design says" +
            (margins.phase_deg ? " (its phase margin is " + short_number(*margins.phase_deg) + "°)" : std::string()) +
            end);
  if (margins.gain_dB && *margins.gain_dB < 1)
    add_note(findings, key_of_law(problem),
             "an error of " + short_number(100 * (std::pow(10, *margins.gain_dB / 20) - 1)) +
                 " % in the gain of an input makes the loop unstable (its gain margin is " +
                 short_number(*margins.gain_dB) + " dB)" + end);
}

// |z| by falling size.
std::vector<double> sizes(const std::vector<ComplexReal>& poles) {
  std::vector<double> all;
  for (const ComplexReal& pole : poles) all.push_back(to_double(size_of(pole)));
  std::sort(all.rbegin(), all.rend());
  return all;
}

void note_idle_regulator(const Problem& problem, const DesignRun& run, Findings& findings) {
  if (!has_cost(problem.regulator) || problem.regulator->horizon > 0 || problem.regulator->integral) return;
  if (problem.regulator->input_rate.size() > 0 || is_zero(run.solution.regulator->K)) return;
  const std::vector<double> alone = sizes(eigenvalues(run.stages.back().of_regulator().plant.A));
  const std::vector<double> closed = sizes(run.regulator_poles);
  for (std::size_t i = 0; i < alone.size(); ++i)
    if (!(std::abs(alone[i] - closed[i]) < 1e-6 * std::abs(1 - alone[i]))) return;
  add_note(findings, "lqr.R",
           "the regulator moves no pole of the plant by a millionth of its distance from the unit circle: look at Q "
           "beside R, and at the units of B");
}

// Libraries may leave out the names of a file.
std::string name_of(const std::vector<Signal>& signals, Index i, const char* letter) {
  const std::size_t at = static_cast<std::size_t>(i);
  return at < signals.size() ? signals[at].name : letter + std::to_string(i);
}

std::string name_of_input(const Problem& problem, Index i) { return name_of(problem.plant.inputs, i, "u"); }

// R beside BᵀXB, what a unit of the input comes to cost by the states. R = 0 is meant.
void note_free_inputs(const Problem& problem, const DesignRun& run, Findings& findings) {
  const Regulator& lqr = *problem.regulator;
  if (!has_cost(problem.regulator) || lqr.horizon > 0 || lqr.cost == Cost::continuous) return;
  if (lqr.input_rate.size() > 0) return;
  const RealMatrix by_states =
      transpose_congruence(regulated_plant(problem, run.stages.back().of_regulator().plant).B, run.own_law->X);
  const RealMatrix R = weights_of(problem).R;
  const Real period = lqr.cost == Cost::sampled ? Real(problem.plant.sample_time) : Real(1);
  for (Index i = 0; i < R.rows(); ++i) {
    const Real share = by_states(i, i).is_zero() ? Real(1) : Real(period * R(i, i) / by_states(i, i));
    if (share > 0 && share < 1e-9)
      add_note(
          findings, "lqr.R",
          "the weight of " + name_of_input(problem, i) + " is " + short_number(to_double(share)) +
              " of what it costs by way of the states, as good as none: look at Q beside R, and at the units of B");
  }
}

// The nearer limit of an input.
double reach_of(const Limits& limits, Index i) {
  return std::min(std::abs(limits.u_min(i)), std::abs(limits.u_max(i)));
}

std::string key_of_limit(const Limits& limits, Index i) {
  const bool is_upper = std::abs(limits.u_max(i)) <= std::abs(limits.u_min(i));
  return std::string(is_upper ? "limits.u_max" : "limits.u_min") + "[" + std::to_string(i) + "]";
}

// Where limits are counted from, if not from 0.
const char* from_point(const Problem& problem) {
  return problem.plant.operating_point ? " from the operating point" : "";
}

void note_noise_at_limits(const Problem& problem, const DesignRun& run, Findings& findings) {
  if (!run.solution.loop.rms) return;
  const std::vector<double>& rms = run.solution.loop.rms->u;
  for (std::size_t j = 0; j < rms.size(); ++j) {
    const Index i = static_cast<Index>(j);
    if (rms[j] > reach_of(*problem.limits, i) / 2)
      add_note(findings, key_of_limit(*problem.limits, i),
               "the noises alone move " + name_of_input(problem, i) + " by " + short_number(rms[j]) +
                   " rms, and it is limited to " + short_number(reach_of(*problem.limits, i)) + from_point(problem) +
                   ": the loop is at its limits without end; look at the noises, and at R");
  }
}

// What of the inputs a reference of 1 asks for: held for ever, with as many inputs as outputs that have one, and at
// once.
struct Asked {
  RealMatrix held, at_once;
};

Asked asked_by_reference(const Problem& problem, const Solution& solution) {
  const std::vector<int> outputs = reference_outputs(problem);
  const SampledPlant plant = without_disturbances(problem, final_plant(solution));
  const Index nx = plant.A.rows(), nu = plant.B.cols(), nr = static_cast<Index>(outputs.size());
  Asked asked = {solution.regulator->Nu, solution.regulator->Nbar};
  if (nr != nu) return asked;
  const RealMatrix at_rest =
      above(beside(plant.A - identity(nx), plant.B), beside(rows_of(plant.C, outputs), rows_of(plant.D, outputs)));
  const std::optional<RealMatrix> point = solve(at_rest, above(zeros(nx, nr), identity(nr)));
  if (point) asked.held = point->bottomRows(nu);
  return asked;
}

void note_reference(const Problem& problem, const RealMatrix& asked, const std::string& when, const std::string& look,
                    Findings& findings) {
  const std::vector<int> outputs = reference_outputs(problem);
  for (Index i = 0; i < asked.rows(); ++i)
    for (Index j = 0; j < asked.cols(); ++j) {
      const double size = std::abs(to_double(asked(i, j))), reach = reach_of(*problem.limits, i);
      if (!(size > reach)) continue;
      const int output = outputs[static_cast<std::size_t>(j)];
      add_note(findings, key_of_limit(*problem.limits, i),
               (problem.plant.operating_point ? "a change by 1 of the reference for " : "a reference of 1 for ") +
                   name_of(problem.plant.outputs, output, "y") + when + short_number(size) + " of " +
                   name_of_input(problem, i) + ", which is limited to " + short_number(reach) + from_point(problem) +
                   ": " + look);
    }
}

void note_reference_beyond_limits(const Problem& problem, const DesignRun& run, Findings& findings) {
  const Asked asked = asked_by_reference(problem, run.solution);
  const std::size_t before = findings.size();
  note_reference(problem, asked.held, " takes for ever ",
                 "it is never reached; look at the units of B and of the outputs", findings);
  if (findings.size() == before)
    note_reference(problem, asked.at_once, " asks at once for ", "smaller steps, or a ramp, leave the loop linear",
                   findings);
}

// A loop that dies out more than a tenth slower or faster than the design says.
void note_rounded_poles(const DesignRun& run, Findings& findings) {
  const LoopSolution& loop = run.solution.loop;
  if (!loop.rounded || loop.poles.empty() || loop.rounded->poles.empty()) return;
  Real slowest = 0;
  for (const ComplexReal& pole : run.loop_poles) slowest = std::max<Real>(slowest, size_of(pole));
  const double distance = to_double(1 - slowest), rounded = 1 - std::abs(loop.rounded->poles.front());
  if (distance > 1e-15 && std::abs(rounded - distance) > 0.1 * distance)
    add_note(findings, "code.real",
             "rounding to the target's numbers moves the slowest pole from |z| = 1 - " + short_number(distance) +
                 " to 1 - " + short_number(rounded) + ": choose longer samples, or other units of the states");
}

}  // namespace

void note_implausible(const Problem& problem, const DesignRun& run, Findings& findings) {
  const Digits enough(std::max(50u, run.solution.numerics.digits / 2));
  note_domain(problem, findings);
  note_fast_modes(problem, findings);
  if (!problem.regulator) return;
  note_settling(problem, run, findings);
  note_margins(problem, run, findings);
  note_idle_regulator(problem, run, findings);
  note_free_inputs(problem, run, findings);
  note_rounded_poles(run, findings);
  if (!problem.limits) return;
  note_noise_at_limits(problem, run, findings);
  note_reference_beyond_limits(problem, run, findings);
}

}  // namespace lqg::design
