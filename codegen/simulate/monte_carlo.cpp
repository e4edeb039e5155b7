// SPDX-License-Identifier: MIT
#include "simulate/monte_carlo.hpp"

#include <algorithm>
#include <atomic>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <mutex>
#include <thread>

#include "simulate/noise.hpp"
#include "simulate/prepared_scenario.hpp"
#include "simulate/scenario_requirements.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double most_counted = 1e6, scale = 0x1p20;

MatrixXd factors_around_1(const MatrixXd& like, double spread, Noise& noise) {
  MatrixXd factors(like.rows(), like.cols());
  for (Index i = 0; i < like.rows(); ++i)
    for (Index j = 0; j < like.cols(); ++j) factors(i, j) = 1 + 2 * spread * noise.uniform();
  return factors;
}

VectorXd start_of(const design::Scenario& scenario, Index nx, Noise& noise) {
  VectorXd x0 = scenario.x0.size() ? scenario.x0 : VectorXd(VectorXd::Zero(nx));
  for (Index i = 0; i < scenario.spread.x0.size(); ++i) x0(i) += scenario.spread.x0(i) * noise.normal();
  return x0;
}

// One run; what is drawn here is not what the noises of the run are drawn from.
ScenarioRun run_number(const PreparedScenario& prepared, ScenarioRunner& runner, std::uint64_t seed, int number) {
  const design::Spread& spread = prepared.scenario.spread;
  const std::uint64_t own = seed_of_run(seed, static_cast<std::uint64_t>(number));
  Noise noise(seed_of_run(own, 1));
  const TruthModel::Stage& stage = prepared.truth.stages.front();
  const Factors factors = {factors_around_1(stage.A, spread.A, noise), factors_around_1(stage.B, spread.B, noise),
                           factors_around_1(stage.C, spread.C, noise)};
  const VectorXd x0 = start_of(prepared.scenario, prepared.truth.nx, noise);
  const bool differs = spread.A > 0 || spread.B > 0 || spread.C > 0;
  return differs ? runner.run(prepared.truth.with(factors), x0, own) : runner.run(prepared.truth, x0, own);
}

std::int64_t counted(double value) {
  return static_cast<std::int64_t>(std::llround(std::min(value, most_counted) * scale));
}

bool has_failed(const PreparedScenario& prepared, const ScenarioRun& run) {
  if (run.numbers.has_diverged) return true;
  if (!is_required_in(prepared.controller.problem.requirements, prepared.scenario)) return false;
  design::Findings findings;
  check_run(prepared.controller, run, findings);
  return design::has_error(findings);
}

// Adds what a run tells; called for one run at a time.
void add_run(const PreparedScenario& prepared, const ScenarioRun& run, MonteCarlo& result) {
  if (run.nees.size() == 0) return;
  const std::size_t samples = static_cast<std::size_t>(prepared.courses.load.cols());
  for (auto* sums : {&result.nees_sums, &result.nees_counts, &result.nis_sums, &result.nis_counts})
    sums->resize(samples, 0);
  result.nees_degrees = run.nees_degrees;
  result.nis_degrees = static_cast<int>(run.y.rows());
  for (Index k = 0; k < run.nees.size(); ++k) {
    const std::size_t at = static_cast<std::size_t>(k);
    result.nees_sums[at] += counted(run.nees(k));
    ++result.nees_counts[at];
    if (run.has(k, step::Event::output_rejected) || run.has(k, step::Event::output_gated)) continue;
    result.nis_sums[at] += counted(run.nis(k));
    ++result.nis_counts[at];
  }
}

Consistency consistency(const std::vector<std::int64_t>& sums, const std::vector<std::int64_t>& counts, int degrees) {
  Consistency result;
  result.expected = degrees;
  double total = 0, runs = 0, inside = 0, samples = 0, most = 0;
  for (const std::int64_t count : counts) most = std::max(most, static_cast<double>(count));
  const auto bounds = [degrees](double count) {
    const boost::math::chi_squared distribution(count * degrees);
    return std::pair(quantile(distribution, 0.025) / count, quantile(distribution, 0.975) / count);
  };
  if (most < 1 || degrees < 1) return result;
  std::tie(result.low, result.high) = bounds(most);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double count = static_cast<double>(counts[k]);
    if (count < 1) continue;
    const double mean = static_cast<double>(sums[k]) / scale / count;
    const auto [low, high] = count == most ? std::pair(result.low, result.high) : bounds(count);
    inside += mean >= low && mean <= high;
    ++samples;
    total += static_cast<double>(sums[k]) / scale;
    runs += count;
  }
  result.mean = total / runs;
  result.share_inside = inside / samples;
  return result;
}

}  // namespace

MonteCarlo monte_carlo(const controller::Controller& controller, const design::Scenario& scenario,
                       const MonteCarloOptions& options) {
  const PreparedScenario prepared(controller, scenario, 1);
  MonteCarlo result;
  result.name = scenario.name;
  result.first = options.first;
  result.seed = options.seed;
  const std::size_t runs = static_cast<std::size_t>(options.runs);
  result.numbers.resize(runs);
  std::vector<char> failed(runs, 0);  // of vector<bool> two threads could not write neighbours
  std::atomic<std::size_t> next = 0;
  std::mutex one_at_a_time;
  int done = 0;
  const auto work = [&] {
    ScenarioRunner runner(prepared);
    for (std::size_t i = next++; i < runs; i = next++) {
      const ScenarioRun run = run_number(prepared, runner, options.seed, options.first + static_cast<int>(i));
      result.numbers[i] = run.numbers;
      failed[i] = has_failed(prepared, run);
      const std::lock_guard<std::mutex> lock(one_at_a_time);
      add_run(prepared, run, result);
      ++done;
      if (options.progress) options.progress(done);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < options.threads; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  result.failed.assign(failed.begin(), failed.end());
  return result;
}

double share_failed(const MonteCarlo& result) {
  if (result.failed.empty()) return 0;
  return static_cast<double>(std::count(result.failed.begin(), result.failed.end(), true)) /
         static_cast<double>(result.failed.size());
}

std::vector<double> means_of(const std::vector<std::int64_t>& sums, const std::vector<std::int64_t>& counts) {
  std::vector<double> means;
  for (std::size_t k = 0; k < sums.size(); ++k)
    means.push_back(counts[k] ? static_cast<double>(sums[k]) / scale / static_cast<double>(counts[k]) : std::nan(""));
  return means;
}

std::optional<Consistency> nees_of(const MonteCarlo& result) {
  if (result.nees_sums.empty()) return {};
  return consistency(result.nees_sums, result.nees_counts, result.nees_degrees);
}

std::optional<Consistency> nis_of(const MonteCarlo& result) {
  if (result.nis_sums.empty()) return {};
  return consistency(result.nis_sums, result.nis_counts, result.nis_degrees);
}

}  // namespace lqg::simulate
