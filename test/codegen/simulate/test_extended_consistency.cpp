// SPDX-License-Identifier: MIT
// Whether extended filters know their error, over many runs of their plants with other noises and starts; and what they
// do where they begin far off.
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include <unity.h>

#include "../emit/design_text.hpp"
#include "simulate/monte_carlo.hpp"
#include "simulate/replay.hpp"
#include "simulate/scenario_run.hpp"

using namespace lqg;
using controller::Controller;
using Eigen::Index;
using simulate::Consistency;
using simulate::ScenarioRun;

namespace {

std::string text_of(const std::string& file) {
  std::ifstream stream(LQG_SOURCE_FOLDER + ("/" + file) + ".toml");
  TEST_ASSERT_TRUE_MESSAGE(stream.good(), file.c_str());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

const std::string motor = "codegen/designs/sensorless_motor", attitude = "codegen/designs/attitude";
const std::string pendulum = "test/designs/pendulum", ship = "test/designs/ship";

// As uncertain at the start as their filters believe.
const std::string of_pendulum = "\n[[scenario]]\nname = \"held\"\nduration = 4\nspread = { x0 = [\"sqrt(0.1)\", 1] }\n";
const std::string of_ship =
    "\n[[scenario]]\nname = \"turn\"\nduration = 50\nx0 = [-38, 22, -1.25, 5]\nspread = { x0 = [5, 5, 0.5, 2] }\n"
    "input = [{ input = \"turn\", value = 0.1, at = 10 }]\n";

const design::Scenario& scenario_of(const Controller& controller, const std::string& name) {
  for (const design::Scenario& scenario : controller.problem.scenarios)
    if (scenario.name == name) return scenario;
  TEST_FAIL_MESSAGE(name.c_str());
  return controller.problem.scenarios[0];
}

simulate::MonteCarlo runs_of(const Controller& controller, const std::string& scenario, int runs) {
  simulate::MonteCarloOptions options;
  options.runs = runs, options.threads = 2, options.seed = 5;
  return simulate::monte_carlo(controller, scenario_of(controller, scenario), options);
}

// A filter that is right: NEES (NIS) is χ² with `expected` degrees in each sample and run. Samples that are `memory`
// apart are independent, those of NIS all. 3.3 standard deviations of the mean are exceeded once in a thousand times.
// What the linearisation adds was measured with ten times as many runs, and is allowed twice.
void expect_consistent(const std::string& name, const std::optional<Consistency>& found, double independent,
                       double linearisation) {
  TEST_ASSERT_TRUE(found);
  const double by_chance = 3.3 * std::sqrt(2 / (found->expected * independent));
  const double excess = found->mean / found->expected - 1;
  const std::string message =
      name + ": " + std::to_string(100 * excess) + " % too much, " + std::to_string(100 * by_chance) + " % by chance";
  TEST_ASSERT_TRUE_MESSAGE(excess < by_chance + 2 * linearisation && excess > -by_chance, message.c_str());
}

void test_filters_know_their_error() {
  const struct {
    std::string file, added, scenario;
    int runs;
    double memory;     // samples
    double nees, nis;  // by the linearisation, measured
  } studies[] = {{pendulum, of_pendulum, "held", 200, 10, 0, 0},
                 {ship, of_ship, "turn", 200, 20, 0.11, 0.018},
                 {motor, "", "start", 100, 100, 0.03, 0.005},
                 {attitude, "", "flight", 50, 200, 0.011, 0.001}};
  for (const auto& study : studies) {
    const Controller controller = lqg_test::controller_of(text_of(study.file) + study.added);
    const simulate::MonteCarlo result = runs_of(controller, study.scenario, study.runs);
    TEST_ASSERT_TRUE(simulate::share_failed(result) == 0);
    const double samples = static_cast<double>(result.nees_counts.size()) * study.runs;
    expect_consistent(study.file + ", NEES", simulate::nees_of(result), samples / study.memory, study.nees);
    expect_consistent(study.file + ", NIS", simulate::nis_of(result), samples, study.nis);
  }
}

void test_the_log_of_a_run_gives_what_the_run_says_of_the_filter() {
  for (const std::string& file : {motor, attitude}) {
    const Controller controller = lqg_test::controller_of(text_of(file));
    const ScenarioRun run = simulate::run_scenario(controller, controller.problem.scenarios.at(1));
    const simulate::ReplayRun replay = simulate::replay(controller, {run.times, run.y, run.u, run.r});
    TEST_ASSERT_TRUE((replay.estimate.array() == run.estimate.array()).all());
    TEST_ASSERT_TRUE((replay.sigma.array() == run.sigma.array()).all());
    TEST_ASSERT_TRUE((replay.nis.array() == run.nis.array()).all());
    TEST_ASSERT_TRUE(run.left_out.any() && run.nis.maxCoeff() > 0);
  }
}

// 150 K more: copper has 1.59 times the resistance.
void test_a_motor_that_is_too_hot_is_found_out() {
  const Controller controller = lqg_test::controller_of(
      text_of(motor) +
      "\n[[scenario]]\nname = \"hot\"\nduration = 0.05\nx0 = [0, 0, 0, \"lambda\", 0]\n"
      "input = [{ input = \"u_alpha\", value = 3 }]\nplant = { parameters = { R = \"1.59*0.36\" } }\n");
  const simulate::MonteCarlo result = runs_of(controller, "hot", 20);
  TEST_ASSERT_TRUE(simulate::nees_of(result)->mean > 2 * simulate::nees_of(result)->expected);
}

// The same scenario with another start.
ScenarioRun run_from(const Controller& controller, const Eigen::VectorXd& x0) {
  design::Scenario scenario = scenario_of(controller, "begun far off");
  scenario.x0 = x0;
  return simulate::run_scenario(controller, scenario);
}

// The first sample from which on all are within `limit`.
Index back_at(const Eigen::VectorXd& errors, double limit) {
  Index at = errors.size();
  while (at > 0 && errors(at - 1) <= limit) --at;
  return at;
}

Eigen::VectorXd angle_errors_of_motor(const ScenarioRun& run) {
  Eigen::VectorXd errors(run.times.size());
  for (Index k = 0; k < errors.size(); ++k)
    errors(k) = std::abs(
        std::remainder(std::atan2(run.x(4, k), run.x(3, k)) - std::atan2(run.estimate(4, k), run.estimate(3, k)),
                       2 * std::acos(-1.0)));
  return errors;
}

// P0 is that of a rotor within 0.1 rad: P does not say how far off x̂ is, and nothing is left out.
void test_a_motor_finds_its_rotor_from_every_angle() {
  const Controller controller = lqg_test::controller_of(text_of(motor));
  const double flux = controller.problem.estimator->x0(3);
  for (int i = -5; i <= 6; ++i) {
    const double angle = i * std::acos(-1.0) / 6;
    Eigen::VectorXd x0(5);
    x0 << 0, 0, 0, flux * std::cos(angle), flux * std::sin(angle);
    const ScenarioRun run = run_from(controller, x0);
    const Index back = back_at(angle_errors_of_motor(run), 0.15);
    const std::string message = std::to_string(angle) + " rad: back at sample " + std::to_string(back);
    TEST_ASSERT_TRUE_MESSAGE(back <= (std::abs(i) <= 3 ? 70 : 450), message.c_str());
    TEST_ASSERT_TRUE(run.numbers.resets == 0 && run.numbers.covariance_resets == 0 && !run.left_out.any());
    if (std::abs(i) >= 2) TEST_ASSERT_TRUE(run.nees(30) > 10 * run.nees_degrees);
  }
}

Eigen::VectorXd angle_errors_of_attitude(const ScenarioRun& run) {
  Eigen::VectorXd errors(run.times.size());
  for (Index k = 0; k < errors.size(); ++k) {
    const Eigen::Vector4d q = run.x.col(k).head(4).normalized(), found = run.estimate.col(k).head(4).normalized();
    errors(k) = 2 * std::acos(std::min(1.0, std::abs(q.dot(found))));
  }
  return errors;
}

enum Axis { roll = 1, heading = 3 };

ScenarioRun run_of_attitude(const Controller& controller, double angle, Axis axis = roll) {
  Eigen::VectorXd x0(7);
  x0 << std::cos(angle / 2), 0, 0, 0, 0.03, -0.04, 0.02;
  x0(axis) = std::sin(angle / 2);
  return run_from(controller, x0);
}

Index samples_left_out(const ScenarioRun& run) { return run.left_out.colwise().any().count(); }

// Its gate widens for what it leaves out.
void test_an_attitude_far_off_is_let_in() {
  const Controller controller = lqg_test::controller_of(text_of(attitude));
  for (const double angle : {1.0, 1.5, 2.0}) {
    const ScenarioRun run = run_of_attitude(controller, angle);
    TEST_ASSERT_TRUE(samples_left_out(run) > 0 && !run.left_out.rightCols(run.times.size() - 100).any());
    TEST_ASSERT_TRUE(back_at(angle_errors_of_attitude(run), 0.12) <= 50);
    TEST_ASSERT_TRUE(back_at(angle_errors_of_attitude(run), 0.035) <= 300);
    TEST_ASSERT_TRUE(run.numbers.resets == 0 && run.numbers.covariance_resets == 0);
  }
  TEST_ASSERT_TRUE(back_at(angle_errors_of_attitude(run_of_attitude(controller, 2, heading)), 0.12) <= 900);
}

// 30 standard deviations of P0 are beyond what a linearisation bears: what is let in now and then spoils the bias. No
// reset tells, but the status of most samples does.
void test_an_attitude_that_stands_on_its_head_does_not_come_back() {
  const Controller controller = lqg_test::controller_of(text_of(attitude));
  const ScenarioRun run = run_of_attitude(controller, 3);
  TEST_ASSERT_TRUE(angle_errors_of_attitude(run).tail(500).mean() > 0.5);
  TEST_ASSERT_TRUE(samples_left_out(run) > run.times.size() / 2);
  TEST_ASSERT_TRUE(run.numbers.resets == 0);
}

// An angle that grows by 1 rad a sample, seen by its sine and cosine.
ScenarioRun run_of_turning(const std::string& next, const std::string& next_rate = "rate") {
  const Controller controller = lqg_test::controller_of(
      "name = \"turning\"\n[plant]\ndomain = \"discrete\"\nsample_time = 0.01\nstates = [\"angle\", \"rate\"]\n"
      "outputs = [\"c\", \"s\"]\nf = [\"" +
      next + "\", \"" + next_rate +
      "\"]\nh = [\"cos(angle)\", \"sin(angle)\"]\n"
      "[kalman]\ngain = \"extended\"\nprocess_noise = [1e-6, 1e-6]\nmeasurement_noise = [1e-4, 1e-4]\n"
      "initial_state = [0, 100]\ninitial_covariance = [0.01, 0.01]\n"
      "[[scenario]]\nname = \"long\"\nduration = 100\nx0 = [0, 100]\n");
  return simulate::run_scenario(controller, controller.problem.scenarios[0]);
}

// Beyond 8192 rad sin and cos of float have no value: each output is left out, or, in f, all begins anew. f of a
// discrete plant can wrap.
void test_an_angle_that_grows_leaves_the_range_and_one_that_f_wraps_does_not() {
  const ScenarioRun grown = run_of_turning("angle + 0.01*rate");
  const Index lost = (grown.estimate.row(0).array() > 8193).count();
  TEST_ASSERT_TRUE(lost > 1000 && samples_left_out(grown) >= lost);
  TEST_ASSERT_TRUE(grown.numbers.resets == 0);
  TEST_ASSERT_TRUE(run_of_turning("angle + 0.01*rate", "rate + 1e-9*sin(angle)").numbers.resets > 0);
  const ScenarioRun wrapped = run_of_turning("atan2(sin(angle + 0.01*rate), cos(angle + 0.01*rate))");
  TEST_ASSERT_TRUE(samples_left_out(wrapped) == 0 && wrapped.numbers.resets == 0);
  const Index last = wrapped.times.size() - 1;
  TEST_ASSERT_TRUE(std::abs(std::sin(wrapped.x(0, last) - wrapped.estimate(0, last))) < 0.01);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_filters_know_their_error);
  RUN_TEST(test_the_log_of_a_run_gives_what_the_run_says_of_the_filter);
  RUN_TEST(test_a_motor_that_is_too_hot_is_found_out);
  RUN_TEST(test_a_motor_finds_its_rotor_from_every_angle);
  RUN_TEST(test_an_attitude_far_off_is_let_in);
  RUN_TEST(test_an_attitude_that_stands_on_its_head_does_not_come_back);
  RUN_TEST(test_an_angle_that_grows_leaves_the_range_and_one_that_f_wraps_does_not);
  return UNITY_END();
}
