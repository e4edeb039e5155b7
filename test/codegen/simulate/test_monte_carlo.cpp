// SPDX-License-Identifier: MIT
// Many runs of a scenario, and a filter over a log.
#include <cmath>
#include <cstring>

#include <unity.h>

#include "../emit/design_text.hpp"
#include "emit/report/scenario_tables.hpp"
#include "simulate/monte_carlo.hpp"
#include "simulate/replay.hpp"

using namespace lqg;
using controller::Controller;
using simulate::MonteCarlo;
using simulate::MonteCarloOptions;

namespace {

// x⁺ = 0.9 x + u + w, y = x + v: a start that is as uncertain as the filter believes.
std::string walker(const std::string& scenario, const std::string& gain = "steady") {
  return R"(
name = "walker"
[plant]
domain = "discrete"
sample_time = 0.1
A = [[0.9, 0.2], [0, 0.8]]
B = [[0], [1]]
C = [[1, 0]]
[lqr]
Q = [1, 0.1]
R = [1]
track = [0]
[kalman]
process_noise = [0.01, 0.04]
measurement_noise = [0.25]
initial_covariance = [4, 1]
gain = ")" +
         gain + R"("
[code]
real = "double"
[[scenario]]
name = "walk"
duration = 5
reference = [{ output = 0, value = 1, at = 1 }]
)" + scenario;
}

const char* const honest = "spread = { x0 = [2, 1] }\n";

MonteCarlo runs_of(const Controller& controller, int runs, unsigned threads, int first = 0) {
  MonteCarloOptions options;
  options.first = first, options.runs = runs, options.threads = threads, options.seed = 7;
  return simulate::monte_carlo(controller, controller.problem.scenarios[0], options);
}

void test_the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
  const Controller controller =
      lqg_test::controller_of(walker("spread = { A = 0.1, B = 0.1, C = 0.1, x0 = [2, 1] }\n"));
  const MonteCarlo one = runs_of(controller, 50, 1);
  const std::string text = emit::csv(controller, one);
  for (const unsigned threads : {2u, 5u}) {
    const MonteCarlo several = runs_of(controller, 50, threads);
    TEST_ASSERT_EQUAL_STRING(text.c_str(), emit::csv(controller, several).c_str());
    TEST_ASSERT_TRUE(one.nees_sums == several.nees_sums && one.nis_sums == several.nis_sums);
  }
}

void test_runs_that_are_shared_out_are_those_of_the_whole() {
  const Controller controller = lqg_test::controller_of(walker(honest));
  const std::string whole = emit::csv(controller, runs_of(controller, 30, 2));
  std::string parts = emit::csv(controller, runs_of(controller, 10, 1));
  for (const int first : {10, 20}) {
    const std::string part = emit::csv(controller, runs_of(controller, 10, 1, first));
    parts += part.substr(part.find('\n') + 1);
  }
  TEST_ASSERT_EQUAL_STRING(whole.c_str(), parts.c_str());
}

// The mean over the runs is χ²: 95 of 100 samples are within its bounds. 50 samples that are related: 0.8 at least.
void test_a_filter_that_is_right_knows_its_error() {
  for (const char* gain : {"online", "schedule"}) {
    const Controller controller = lqg_test::controller_of(walker(honest, gain));
    const MonteCarlo result = runs_of(controller, 2000, 2);
    const auto nees = simulate::nees_of(result), nis = simulate::nis_of(result);
    TEST_ASSERT_TRUE(nees && nis);
    TEST_ASSERT_TRUE_MESSAGE(nees->share_inside > 0.8, std::to_string(nees->share_inside).c_str());
    TEST_ASSERT_TRUE_MESSAGE(nis->share_inside > 0.8, std::to_string(nis->share_inside).c_str());
    TEST_ASSERT_TRUE(nees->expected == 2 && nis->expected == 1);
    TEST_ASSERT_TRUE(nees->low > 1.9 && nees->low < 2 && nees->high > 2 && nees->high < 2.1);
  }
}

// Its gain is made for noise that is not there: eight times the variance at the input.
void test_a_filter_with_recovery_knows_its_error() {
  for (const char* gain : {"steady\"\nrecovery = 0.32 #", "schedule\"\nrecovery = 0.32 #"}) {
    const MonteCarlo result = runs_of(lqg_test::controller_of(walker(honest, gain)), 2000, 2);
    for (const auto& found : {simulate::nees_of(result), simulate::nis_of(result)}) {
      TEST_ASSERT_TRUE(found);
      TEST_ASSERT_TRUE_MESSAGE(found->share_inside > 0.8, std::to_string(found->share_inside).c_str());
    }
  }
}

void test_a_filter_with_a_wrong_plant_is_found_out() {
  const Controller controller = lqg_test::controller_of(
      walker("spread = { x0 = [2, 1] }\nplant = { scale = [{ matrix = \"B\", factor = 3 }] }\n", "online"));
  const MonteCarlo result = runs_of(controller, 500, 2);
  TEST_ASSERT_TRUE(simulate::nees_of(result)->share_inside < 0.5);
  TEST_ASSERT_TRUE(simulate::nees_of(result)->mean > 3);
}

void test_a_run_that_misses_a_requirement_has_failed() {
  const std::string text = walker("noise = false\nspread = { B = 0.9 }\n[require]\novershoot = 0.05\n");
  lqg_test::controller_of(walker("noise = false\n"));
  const Controller controller = lqg_test::controller_of(text);
  const MonteCarlo result = runs_of(controller, 200, 2);
  int beyond = 0;
  for (const simulate::ScenarioNumbers& numbers : result.numbers) beyond += numbers.answers[0].overshoot > 0.05;
  TEST_ASSERT_TRUE(beyond > 0 && beyond < 200);
  TEST_ASSERT_TRUE(simulate::share_failed(result) == beyond / 200.0);
}

// Nearest rank: of 1 … 100 the 5th, 50th and 95th.
void test_percentiles_are_numbers_of_runs() {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  TEST_ASSERT_TRUE(simulate::percentile(values, 5) == 5);
  TEST_ASSERT_TRUE(simulate::percentile(values, 50) == 50);
  TEST_ASSERT_TRUE(simulate::percentile(values, 95) == 95);
  TEST_ASSERT_TRUE(simulate::percentile({3}, 5) == 3);
}

// The log of a run gives the estimates of that run, bit for bit, drop-outs too.
void test_the_log_of_a_run_gives_the_estimates_of_the_run() {
  for (const char* gain : {"steady", "schedule", "online"}) {
    const Controller controller = lqg_test::controller_of(walker(
        "dropout = [{ output = 0, from = 2, until = 2.5 }]\noutlier = [{ output = 0, value = 1e9, at = 3 }]\n", gain));
    const simulate::ScenarioRun run = simulate::run_scenario(controller, controller.problem.scenarios[0]);
    const simulate::ReplayRun replay = simulate::replay(controller, {run.times, run.y, run.u, run.r});
    TEST_ASSERT_TRUE((replay.estimate.array() == run.estimate.array()).all());
    TEST_ASSERT_TRUE((replay.law.array() == run.u.array()).all());
    TEST_ASSERT_TRUE((replay.sigma.array() == run.sigma.array()).all());
    TEST_ASSERT_TRUE((replay.nis.array() == run.nis.array()).all());
    TEST_ASSERT_TRUE(replay.left_out == run.numbers.left_out && replay.left_out[0] == 6);
  }
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_the_same_seed_gives_the_same_bytes_on_any_number_of_threads);
  RUN_TEST(test_runs_that_are_shared_out_are_those_of_the_whole);
  RUN_TEST(test_a_filter_that_is_right_knows_its_error);
  RUN_TEST(test_a_filter_with_recovery_knows_its_error);
  RUN_TEST(test_a_filter_with_a_wrong_plant_is_found_out);
  RUN_TEST(test_a_run_that_misses_a_requirement_has_failed);
  RUN_TEST(test_percentiles_are_numbers_of_runs);
  RUN_TEST(test_the_log_of_a_run_gives_the_estimates_of_the_run);
  return UNITY_END();
}
