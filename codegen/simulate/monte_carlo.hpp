// SPDX-License-Identifier: MIT
// Many runs of a scenario, with other noises, plants and starts in each.
#pragma once

#include <functional>

#include "simulate/scenario_run.hpp"

namespace lqg::simulate {

struct MonteCarloOptions {
  int first = 0, runs = 0;  // run i is the same whatever other runs are made beside it
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::function<void(int)> progress;  // how many runs are done, now and then; from any thread, one at a time
};

// Whether a filter knows its error: the mean square of the error (or of the innovation) in units of what the filter
// believes, which is the number of its directions where the filter is right.
struct Consistency {
  double mean = 0;  // over all samples and runs
  double expected = 0;
  double low = 0, high = 0;  // within which the mean over the runs lies in 95 % of the samples
  double share_inside = 0;   // of the samples in which it does
};

struct MonteCarlo {
  std::string name;
  int first = 0;
  std::uint64_t seed = 1;
  std::vector<ScenarioNumbers> numbers;  // of each run
  std::vector<bool> failed;              // of each: lost, or misses what [require] asks of this scenario
  // Σ over the runs of min(NEES, 10⁶) 2²⁰, rounded, sample by sample, and how many runs these are; likewise NIS of the
  // samples in which no output was left out. Whole numbers: sums of parts are the sum of all. Empty without a filter
  // that knows its error.
  std::vector<std::int64_t> nees_sums, nees_counts, nis_sums, nis_counts;
  int nees_degrees = 0, nis_degrees = 0;
};

MonteCarlo monte_carlo(const controller::Controller& controller, const design::Scenario& scenario,
                       const MonteCarloOptions& options);

double share_failed(const MonteCarlo& result);
// Mean over the runs, sample by sample, of what `sums` counts; NaN where `counts` is 0.
std::vector<double> means_of(const std::vector<std::int64_t>& sums, const std::vector<std::int64_t>& counts);
std::optional<Consistency> nees_of(const MonteCarlo& result);
std::optional<Consistency> nis_of(const MonteCarlo& result);

// The number that `percent` of the runs do not exceed (nearest rank); what is not reached counts as infinite.
double percentile(std::vector<double> values, double percent);

// Number by number what so many percent of the runs, at least one, do not exceed.
ScenarioNumbers percentile_numbers(const MonteCarlo& result, double percent);

}  // namespace lqg::simulate
