// SPDX-License-Identifier: MIT
#include "design/run/transfer_recovery.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "design/checks/requirements.hpp"
#include "design/loop/compensator.hpp"
#include "design/loop/margins.hpp"
#include "design/loop/open_loop.hpp"
#include "design/numeric/digits.hpp"
#include "design/numeric/poles.hpp"
#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

const std::string recovery_key = "kalman.recovery";

bool requires_of_loop(const Requirements& require) {
  return require.gain_margin_dB || require.phase_margin_deg || require.disk_margin || require.delay_margin ||
         require.max_pole;
}

// Numbers of two digits in their order: 1, 1.1, … 9.9, 10, 11, …
class TwoDigits {
 public:
  static TwoDigits decade(int exponent) { return TwoDigits(90 * exponent); }
  // 1, 2, 5, 10, …: the one after, the one before.
  TwoDigits step_up() const { return TwoDigits(index_ + (digits() == 10 ? 10 : digits() == 20 ? 30 : 50)); }
  TwoDigits step_down() const { return TwoDigits(index_ - (digits() == 10 ? 50 : digits() == 20 ? 10 : 30)); }
  friend TwoDigits between(TwoDigits a, TwoDigits b) { return TwoDigits(a.index_ + (b.index_ - a.index_) / 2); }
  friend bool are_neighbours(TwoDigits a, TwoDigits b) { return b.index_ - a.index_ == 1; }
  // The double that the decimal reads back as.
  double value() const {
    const std::string text = std::to_string(digits()) + "e" + std::to_string(exponent() - 1);
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
  }

 private:
  explicit TwoDigits(int index) : index_(index) {}
  int exponent() const { return static_cast<int>(std::floor(index_ / 90.0)); }
  int digits() const { return 10 + index_ - 90 * exponent(); }

  int index_;
};

// The loop with one q; no margins where it is not steady.
struct Trial {
  double q = 0;
  Solution solution;  // poles, margins and cost of its loop; the filter
  bool is_steady = false;
};

// What is tried of one problem.
class Trials {
 public:
  Trials(const Problem& problem, bool rough) : problem_(problem), rough_(rough) {
    problem_.estimator->recovery = TransferRecovery();
  }

  Trial at(double q) {
    report_progress("loop transfer recovery", ++count_);
    problem_.estimator->recovery->q = q;
    DesignRun run = run_design(problem_, last_ ? &*last_ : nullptr);
    Trial trial = {q, {}, false};
    if (has_error(run.findings)) return trial;
    trial.is_steady = run.has_steady_loop;
    if (trial.is_steady) describe(run);
    trial.solution = run.solution;
    last_ = std::move(run);
    return trial;
  }

 private:
  void describe(DesignRun& run) const {
    LoopSolution& loop = run.solution.loop;
    loop.poles = sorted_poles(run.loop_poles);
    if (run.cost_per_sample) loop.cost_per_sample = to_double(*run.cost_per_sample);
    const OpenLoop open = open_at_inputs(measured_plant(problem_, run.solution), compensator(problem_, run.solution));
    loop.at_input = rough_ ? rough_margins(open, run.loop_poles) : margins(open, run.loop_poles);
  }

  Problem problem_;
  bool rough_;
  int count_ = 0;
  std::optional<DesignRun> last_;  // each begins where the last one ended
};

bool meets(const Problem& problem, const Trial& trial) {
  Findings missed;
  if (trial.is_steady) check_requirements(problem, trial.solution, missed);
  return trial.is_steady && !has_error(missed);
}

// Of what is required the share of which the loop has least; 1: all.
double least_share(const Problem& problem, const Trial& trial) {
  if (!trial.is_steady) return 0;
  const Requirements& require = problem.requirements;
  const Margins& has = trial.solution.loop.at_input;
  double least = 1;
  const auto take = [&](const std::optional<double>& wanted, const std::optional<double>& found, double unit) {
    if (wanted && found) least = std::min(least, *found * unit / *wanted);
  };
  take(require.gain_margin_dB, has.gain_dB, 1);
  take(require.phase_margin_deg, has.phase_deg, 1);
  take(require.disk_margin, has.disk, 1);
  take(require.delay_margin, has.delay_samples, problem.plant.sample_time);
  if (require.max_pole && !trial.solution.loop.poles.empty())
    least = std::min(least, *require.max_pole / std::abs(trial.solution.loop.poles.front()));
  return least;
}

// The decade in which fictitious noise is as strong as the plant's own, beside the variances of the error.
int decade_of_noise(const EstimatorSolution& filter, const SampledPlant& plant, const RealMatrix& fictitious) {
  const RealMatrix own = congruence(plant.G, filter.noise.W);
  Real of_own, of_inputs;
  for (Index i = 0; i < own.rows(); ++i) {
    if (!(filter.P_prior(i, i) > 0)) continue;
    of_own += own(i, i) / filter.P_prior(i, i);
    of_inputs += fictitious(i, i) / filter.P_prior(i, i);
  }
  if (!(of_own > 0) || !(of_inputs > 0)) return 0;
  return static_cast<int>(std::floor(std::log10(to_double(of_own / of_inputs))));
}

// Where to begin. The noise at the inputs counts with its own unit, whatever q is.
int decade_of_noise(const Problem& problem, const Trial& without) {
  const std::optional<EstimatorSolution>& filter = without.solution.estimator;
  if (!filter) return 0;
  Problem unit = problem;
  unit.estimator->recovery = TransferRecovery{1, false};
  return decade_of_noise(*filter, final_plant(without.solution), sample_stages(unit).back().samples.fictitious);
}

// How far the gains are apart, beside their size; infinite where one has none.
double distance_of_gains(const Trial& a, const Trial& b) {
  if (!a.solution.estimator || !b.solution.estimator) return std::numeric_limits<double>::infinity();
  const RealMatrix& La = a.solution.estimator->L_predictor;
  const RealMatrix& Lb = b.solution.estimator->L_predictor;
  return to_double(largest_entry(La - Lb) / (largest_entry(La) + largest_entry(Lb)));
}

std::string percent_or_times(double ratio) {
  if (ratio >= 2) return decimal(ratio) + " times the cost";
  return decimal(100 * (ratio - 1)) + " % of cost";
}

// "disk margin 0.4535 → 0.6902, phase margin 25.1° → 38.4°, for 1.6 % of cost".
std::string change(const LoopSolution& before, const LoopSolution& after) {
  std::string out;
  const auto add = [&](const char* what, const std::optional<double>& from, const std::optional<double>& to,
                       const char* unit) {
    const auto said = [&](const std::optional<double>& value) { return value ? decimal(*value) + unit : "∞"; };
    if (from || to) out += std::string(what) + " " + said(from) + " → " + said(to) + ", ";
  };
  add("disk margin", before.at_input.disk, after.at_input.disk, "");
  add("phase margin", before.at_input.phase_deg, after.at_input.phase_deg, "°");
  if (before.cost_per_sample && after.cost_per_sample && *before.cost_per_sample > 0)
    return out + "for " + percent_or_times(*after.cost_per_sample / *before.cost_per_sample);
  return out.substr(0, out.size() - 2);
}

void explain_failure(const Problem& problem, const Trial& without, const Trial& best, Findings& findings) {
  std::string message = "no q meets [require]";
  if (!best.is_steady) return add_error(findings, recovery_key, message + ": there is no stable loop with any");
  message += best.q > 0 ? "; the best is " + decimal(best.q) : ", and none comes nearer than 0";
  if (best.q > 0 && without.is_steady) message += " (" + change(without.solution.loop, best.solution.loop) + ")";
  Findings missed;
  check_requirements(problem, best.solution, missed);
  for (const Finding& finding : missed) message += "; " + finding.key + " " + finding.message;
  add_error(findings, recovery_key, message);
}

class Search {
 public:
  explicit Search(const Problem& problem) : problem_(problem), trials_(problem, false) {}

  std::optional<double> smallest(Findings& findings) {
    without_ = best_ = trials_.at(0);
    if (meets(problem_, without_)) return 0;
    TwoDigits enough = TwoDigits::decade(decade_of_noise(problem_, without_) - 3);
    std::optional<TwoDigits> too_little;
    if (try_at(enough))
      too_little = downwards(enough);
    else
      too_little = upwards(enough);
    if (!too_little) {
      explain_failure(problem_, without_, best_, findings);
      return std::nullopt;
    }
    while (!are_neighbours(*too_little, enough)) {
      const TwoDigits middle = between(*too_little, enough);
      (try_at(middle) ? enough : *too_little) = middle;
    }
    return enough.value();
  }

 private:
  static constexpr int most_steps_up = 66, most_steps_down = 90;  // of three a decade

  bool try_at(TwoDigits q) {
    trial_ = trials_.at(q.value());
    if (least_share(problem_, trial_) > least_share(problem_, best_)) best_ = trial_;
    return meets(problem_, trial_);
  }

  // From one that is enough to the first that is not.
  std::optional<TwoDigits> downwards(TwoDigits& enough) {
    for (int i = 0; i < most_steps_down; ++i) {
      const TwoDigits less = enough.step_down();
      if (!try_at(less)) return less;
      enough = less;
    }
    return std::nullopt;
  }

  // From one that is not enough to the first that is; none where more changes nothing any more.
  std::optional<TwoDigits> upwards(TwoDigits& enough) {
    constexpr double nothing = 1e-7;
    for (int i = 0; i < most_steps_up; ++i) {
      const TwoDigits less = enough;
      const Trial before = trial_;
      enough = less.step_up();
      if (try_at(enough)) return less;
      if (distance_of_gains(before, trial_) < nothing && !(distance_of_gains(without_, trial_) < 1e-3))
        return std::nullopt;
    }
    return std::nullopt;
  }

  const Problem& problem_;
  Trials trials_;
  Trial without_, best_, trial_;
};

// The q's of the table, that of the design among them.
std::vector<double> tabled(const Problem& problem, const Trial& without) {
  double middle = problem.estimator->recovery->q;
  std::vector<double> all = {middle};
  if (middle == 0) middle = TwoDigits::decade(decade_of_noise(problem, without)).value();
  for (const double factor : {0.01, 0.1, 1.0, 10.0, 100.0})
    if (middle * factor > 0 && std::isfinite(middle * factor))
      all.push_back(factor < 1 ? middle / std::round(1 / factor) : middle * factor);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (all.front() == 0) all.erase(all.begin());
  return all;
}

RecoveryPoint point_of(double q, const LoopSolution& loop) { return {q, loop.at_input, loop.cost_per_sample}; }

}  // namespace

void check_recovery(const Problem& problem, Findings& findings) {
  if (!has_noise(problem.estimator) || !problem.estimator->recovery) return;
  const Estimator& kalman = *problem.estimator;
  if (!problem.regulator)
    add_error(findings, recovery_key, "needs [lqr] or [pole_placement]: without a regulator there is no loop");
  if (kalman.gain == Gain::online)
    add_error(
        findings, recovery_key,
        "needs gain = \"steady\" or \"schedule\": a covariance that is carried with noise that is not there would "
        "not be that of the error");
  if (kalman.structure.size() > 0)
    add_error(findings, recovery_key,
              "expected this or kalman.structure: that gain is the best one for the noise itself");
  if (kalman.recovery->is_automatic && !requires_of_loop(problem.requirements))
    add_error(findings, recovery_key,
              "\"auto\" needs a margin or max_pole in [require]: without one there is nothing to meet");
  if (!(kalman.recovery->q >= 0) || std::isinf(kalman.recovery->q))
    add_error(findings, recovery_key, "expected a number ≥ 0 or \"auto\", found " + decimal(kalman.recovery->q));
}

std::optional<Problem> with_found_recovery(const Problem& problem, Findings& findings) {
  const Digits scope(50);
  const std::optional<double> q = Search(problem).smallest(findings);
  if (!q) return std::nullopt;
  Problem found = problem;
  found.estimator->recovery = TransferRecovery{*q, false};
  return found;
}

RecoveryReport recovery_report(const Problem& problem, const LoopSolution& loop) {
  const Digits scope(50);
  Trials trials(problem, true);
  const Trial without = trials.at(0);
  RecoveryReport report = {problem.estimator->recovery->q, {point_of(0, without.solution.loop)}};
  for (const double q : tabled(problem, without))
    report.points.push_back(q == report.q ? point_of(q, loop) : point_of(q, trials.at(q).solution.loop));
  return report;
}

void note_recovery(const Problem& problem, const LoopSolution& loop, bool was_found, Findings& findings) {
  const RecoveryReport& report = *loop.recovery;
  const RecoveryPoint& none = report.points.front();
  LoopSolution before;
  before.at_input = none.at_input;
  before.cost_per_sample = none.cost_per_sample;
  const std::string changes = change(before, loop);
  if (was_found && report.q == 0) return add_note(findings, recovery_key, "[require] is met without it: q = 0");
  if (was_found)
    add_note(findings, recovery_key, "the smallest q that meets [require] is " + decimal(report.q) + ": " + changes);
  const bool is_expensive =
      none.cost_per_sample && loop.cost_per_sample && *loop.cost_per_sample > 2 * *none.cost_per_sample;
  if (is_expensive && !was_found) add_note(findings, recovery_key, "this is expensive: " + changes);
  const std::optional<double>&disk = loop.at_input.disk, &disk_before = none.at_input.disk;
  if (problem.estimator->recovery->q > 0 && disk && disk_before && *disk <= *disk_before)
    add_note(findings, recovery_key,
             "the disk margin is not larger than without it (" + decimal(*disk_before) + " → " + decimal(*disk) +
                 "): zeros of the plant beyond the stability limit, a delay or too slow sampling leave nothing to "
                 "recover, or q is too small or too large");
}

}  // namespace lqg::design
