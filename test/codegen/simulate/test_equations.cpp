// SPDX-License-Identifier: MIT
// Scenarios of plants of equations: beside those of the same plant as matrices, and where the two differ.
#include <cmath>

#include <unity.h>

#include "../emit/design_text.hpp"
#include "simulate/monte_carlo.hpp"
#include "simulate/scenario_run.hpp"

using namespace lqg;
using controller::Controller;
using Eigen::Index;
using simulate::ScenarioRun;

namespace {

const std::string head = R"(name = "pendulum"
[parameters]
stiff = -20
[plant]
domain = "continuous"
sample_time = 0.02
delay = 0.03
states = ["th", "om"]
inputs = ["u"]
outputs = ["angle", "rate"]
)";

const std::string rest = R"([lqr]
bryson = { states = [0.3, 2], inputs = [5] }
[kalman]
process_noise = [1e-8, 1e-4]
measurement_noise = [1e-8, 1e-6]
[limits]
u_min = [-9]
u_max = [11]
[code]
real = "double"
)";

const std::string scenario = R"([[scenario]]
name = "all of it"
duration = 3
x0 = [0.4, 0.1]
load = [{ input = "u", value = 0.7, at = 0.5, until = 1.2 }, { state = "om", value = 2, at = 1, ramp = 0.5 }]
actuator = [{ input = "u", time_constant = 0.01, gain = 0.9 }]
sensor = [{ output = "rate", delay = 0.013, bias = 0.01 }]
)";

ScenarioRun run_of(const std::string& plant, const std::string& of = scenario) {
  const Controller controller = lqg_test::controller_of(head + plant + rest + of);
  return simulate::run_scenario(controller, controller.problem.scenarios.at(0));
}

void expect_near(const Eigen::MatrixXd& expected, const Eigen::MatrixXd& found, const char* what) {
  TEST_ASSERT_EQUAL(expected.cols(), found.cols());
  const double worst = (expected - found).cwiseAbs().maxCoeff();
  TEST_ASSERT_TRUE_MESSAGE(worst <= 1e-10, (std::string(what) + ": " + std::to_string(worst * 1e12) + "e-12").c_str());
}

void test_a_linear_f_runs_as_the_same_matrices() {
  const ScenarioRun of_matrices =
      run_of("A = [[0, 1], [-20, -0.5]]\nB = [[0], [3]]\nC = [[1, 0], [0, 1]]\nD = [[0], [0.01]]\n");
  const ScenarioRun of_equations = run_of(
      "f = [\"om\", \"stiff*th - 0.5*om + 3*u\"]\nh = [\"th\", \"om + 0.01*u\"]\n"
      "operating_point = { states = [0, 0] }\n");
  expect_near(of_matrices.x, of_equations.x, "x");
  expect_near(of_matrices.u, of_equations.u, "u");
  expect_near(of_matrices.y, of_equations.y, "y");
  expect_near(of_matrices.fine_x, of_equations.fine_x, "x between samples");
  expect_near(of_matrices.fine_outputs, of_equations.fine_outputs, "outputs between samples");
}

// u = −stiff sin(th)/3 holds it: at rest nothing moves, and all is in own units.
const std::string pendulum =
    "f = [\"om\", \"stiff*sin(th) - 0.5*om + 3*u\"]\nh = [\"th\", \"om\"]\n"
    "operating_point = { states = [0.5, 0], inputs = [\"?\"] }\n";

void test_a_plant_at_its_operating_point_stays_there() {
  const ScenarioRun run = run_of(pendulum, "[[scenario]]\nname = \"rest\"\nduration = 1\nnoise = false\n");
  const double u = 20 * std::sin(0.5) / 3;
  for (Index k = 0; k < run.x.cols(); ++k) {
    TEST_ASSERT_TRUE(std::abs(run.x(0, k) - 0.5) < 1e-9);
    TEST_ASSERT_TRUE(std::abs(run.u(0, k) - u) < 1e-9);
    TEST_ASSERT_TRUE(std::abs(run.outputs(0, k) - 0.5) < 1e-9);
  }
}

// ½ om² − 20 cos(th) of a pendulum without friction and control is kept.
void test_a_free_pendulum_keeps_its_energy() {
  const std::string free =
      "[kalman]\nprocess_noise = [1e-8, 1e-4]\nmeasurement_noise = [1e-8]\n[code]\nreal = \"double\"\n";
  const Controller controller = lqg_test::controller_of(
      "name = \"p\"\n[plant]\ndomain = \"continuous\"\nsample_time = 0.05\nstates = [\"th\", \"om\"]\nf = [\"om\", "
      "\"-20*sin(th)\"]\nh = [\"th\"]\noperating_point = {}\n" +
      free + "[[scenario]]\nname = \"swing\"\nduration = 20\nnoise = false\nx0 = [3, 0]\n");
  const ScenarioRun run = simulate::run_scenario(controller, controller.problem.scenarios.at(0));
  double least = 0;
  for (Index k = 0; k < run.fine_x.cols(); ++k) {
    const double th = run.fine_x(0, k), om = run.fine_x(1, k);
    least = std::min(least, th);
    TEST_ASSERT_TRUE(std::abs(om * om / 2 - 20 * std::cos(th) + 20 * std::cos(3.0)) < 1e-8);
  }
  TEST_ASSERT_TRUE(least < -2.9);
}

void test_other_parameters_change_the_plant_and_not_the_design() {
  const auto with = [](const std::string& change) {
    return run_of(pendulum, "[[scenario]]\nname = \"other\"\nduration = 3\nnoise = false\nplant = { parameters = { " +
                                change + " } }\n");
  };
  const ScenarioRun same = with("stiff = -20"), other = with("stiff = -22");
  TEST_ASSERT_TRUE(std::abs(same.x(0, same.x.cols() - 1) - 0.5) < 1e-9);
  const Index last = other.x.cols() - 1;
  TEST_ASSERT_TRUE(std::abs(other.x(0, last) - 0.5) > 1e-3);
  const double held = -22 * std::sin(other.x(0, last)) + 3 * other.u(0, last);
  TEST_ASSERT_TRUE_MESSAGE(std::abs(held) < 1e-3, "the lighter spring of the scenario is at rest, too");
}

void test_a_loop_that_is_lost_ends_and_says_so() {
  const ScenarioRun run =
      run_of("f = [\"om\", \"th^3 - stiff*th + om + 3*u\"]\nh = [\"th\", \"om\"]\noperating_point = {}\n",
             "[[scenario]]\nname = \"far\"\nduration = 30\nx0 = [9, 0]\n");
  TEST_ASSERT_TRUE(run.numbers.has_diverged);
  TEST_ASSERT_TRUE(run.x.cols() < 500 && run.x.cols() > 0);
  TEST_ASSERT_TRUE(run.fine_x.allFinite() && run.x.allFinite());
}

void test_runs_of_many_are_the_same_whatever_stands_beside_them() {
  const Controller controller = lqg_test::controller_of(
      head + pendulum + rest + "[[scenario]]\nname = \"spread\"\nduration = 1\nspread = { x0 = [0.1, 0.1] }\n");
  simulate::MonteCarloOptions options;
  options.runs = 4;
  const simulate::MonteCarlo all = simulate::monte_carlo(controller, controller.problem.scenarios[0], options);
  options.first = 2, options.runs = 2, options.threads = 2;
  const simulate::MonteCarlo part = simulate::monte_carlo(controller, controller.problem.scenarios[0], options);
  TEST_ASSERT_EQUAL(4, all.numbers.size());
  TEST_ASSERT_TRUE(all.numbers[2].peak_x == part.numbers[0].peak_x);
  TEST_ASSERT_TRUE(all.numbers[3].rms_u == part.numbers[1].rms_u);
  TEST_ASSERT_TRUE(all.numbers[0].peak_x != all.numbers[1].peak_x);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_linear_f_runs_as_the_same_matrices);
  RUN_TEST(test_a_plant_at_its_operating_point_stays_there);
  RUN_TEST(test_a_free_pendulum_keeps_its_energy);
  RUN_TEST(test_other_parameters_change_the_plant_and_not_the_design);
  RUN_TEST(test_a_loop_that_is_lost_ends_and_says_so);
  RUN_TEST(test_runs_of_many_are_the_same_whatever_stands_beside_them);
  return UNITY_END();
}
