// SPDX-License-Identifier: MIT
// A scenario about an operating point is in the plant's own units: it is the scenario of the plant at 0, shifted.
#include <cmath>

#include <unity.h>

#include "../emit/design_text.hpp"
#include "controller/operating_point.hpp"
#include "simulate/scenario_run.hpp"
#include "simulate/simulation.hpp"

using namespace lqg;
using controller::Controller;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using simulate::ScenarioRun;

namespace {

const double rounding = 1e-10;  // of some hundred samples in double, of numbers up to 100

const char* const tank = R"(
name = "tank"
[plant]
domain = "continuous"
sample_time = 0.25
delay = 0.3
A = [[-0.5, 0.25], [0.5, -0.5]]
B = [[1], [0]]
C = [[0, 1], [1, 0]]
outputs = ["level", "flow"]
operating_point = { states = [30, 70], inputs = [4], outputs = [70, 30] }
[lqr]
Q = [0.5, 1]
R = [2]
integral = { outputs = [0], Q = [0.05] }
[kalman]
process_noise = [0.01, 0.01]
measurement_noise = [0.01, 0.02]
output_max = [80, inf]
[limits]
u_min = [3]
u_max = [6]
u_rate = [2]
[code]
real = "double"
[[scenario]]
name = "all of it"
duration = 60
x0 = [30.5, 69]
reference = [{ output = "level", value = 72, at = 5, until = 30 }, { output = "level", value = 71, at = 35, ramp = 4 }]
load = [{ input = 0, value = -0.25, at = 20 }]
sensor = [{ output = "flow", gain = 1.25, bias = 0.5, min = 20, max = 45 }]
actuator = [{ input = 0, min = 3.25, max = 5.5, rate = 1, gain = 0.75, time_constant = 0.1 }]
outlier = [{ output = "level", value = 75, at = 15 }]
dropout = [{ output = "level", from = 10, until = 11 }]
)";

// The scenario of `tank` for the plant at 0. A gain of a sensor or an actuator multiplies what is in own units: of
// deviations it leaves a bias, which an actuator does not have.
design::Scenario shifted(design::Scenario scenario) {
  design::Sensor& sensor = scenario.sensor.front();
  sensor.bias += (sensor.gain - 1) * 30, sensor.min -= 30, sensor.max -= 30;
  design::Actuator& actuator = scenario.actuator.front();
  actuator.min -= 4, actuator.max -= 4;
  scenario.outlier.front().value -= 70;
  return scenario;
}

void expect_shifted(const MatrixXd& own, const MatrixXd& deviations, const VectorXd& point, const char* what) {
  TEST_ASSERT_TRUE_MESSAGE(own.cols() == deviations.cols() && own.cols() > 0, what);
  for (Index k = 0; k < own.cols(); ++k)
    for (Index i = 0; i < own.rows(); ++i) {
      if (std::isnan(own(i, k)) && std::isnan(deviations(i, k))) continue;
      const double difference = own(i, k) - (point(i) + deviations(i, k));
      TEST_ASSERT_TRUE_MESSAGE(std::abs(difference) <= rounding, (std::string(what) + " " + std::to_string(k)).c_str());
    }
}

std::string without(std::string text, const std::string& part) {
  const std::size_t at = text.find(part);
  TEST_ASSERT_TRUE(at != std::string::npos);
  return text.erase(at, part.size());
}

void expect_shifted_runs(const std::string& text) {
  const Controller about = lqg_test::controller_of(text), plain = controller::without_point(about);
  const ScenarioRun own = simulate::run_scenario(about, about.problem.scenarios.at(0));
  const ScenarioRun at_zero = simulate::run_scenario(plain, shifted(plain.problem.scenarios.at(0)));
  const VectorXd x = (VectorXd(2) << 30, 70).finished(), u = VectorXd::Constant(1, 4),
                 y = (VectorXd(2) << 70, 30).finished();
  expect_shifted(own.x, at_zero.x, x, "x");
  expect_shifted(own.estimate.topRows(2), at_zero.estimate.topRows(2), x, "estimate");
  expect_shifted(own.u, at_zero.u, u, "u");
  expect_shifted(own.y, at_zero.y, y, "y");
  expect_shifted(own.outputs, at_zero.outputs, y, "outputs");
  expect_shifted(own.fine_x, at_zero.fine_x, x, "x between samples");
  expect_shifted(own.fine_outputs, at_zero.fine_outputs, y, "outputs between samples");
  expect_shifted(own.r, at_zero.r, y.head(1), "r");
  expect_shifted(own.innovation, at_zero.innovation, VectorXd::Zero(2), "innovation");
  TEST_ASSERT_TRUE(own.events == at_zero.events);
  const simulate::ScenarioNumbers &a = own.numbers, &b = at_zero.numbers;
  for (const auto& [found, expected] : {std::pair(&a.rms_x, &b.rms_x),
                                        {&a.peak_u, &b.peak_u},
                                        {&a.rms_y, &b.rms_y},
                                        {&a.share_at_limits, &b.share_at_limits}})
    for (std::size_t i = 0; i < found->size(); ++i)
      TEST_ASSERT_TRUE(std::abs((*found)[i] - (*expected)[i]) <= rounding);
  TEST_ASSERT_TRUE(std::abs(a.cost - b.cost) <= 1e-6);
  TEST_ASSERT_EQUAL_size_t(b.answers.size(), a.answers.size());
  for (std::size_t i = 0; i < a.answers.size(); ++i)
    TEST_ASSERT_TRUE(std::abs(a.answers[i].overshoot - b.answers[i].overshoot) <= rounding);
}

// Without the actuator's gain, which of u itself is another one than of its deviation.
void test_a_scenario_is_that_of_the_plant_at_zero_shifted() { expect_shifted_runs(without(tank, ", gain = 0.75")); }

void test_a_gain_of_an_actuator_is_of_u_itself() {
  const Controller about = lqg_test::controller_of(tank);
  design::Scenario scenario = about.problem.scenarios.at(0);
  scenario.noise = false, scenario.x0.resize(0), scenario.sensor.clear();
  const ScenarioRun run = simulate::run_scenario(about, scenario);
  // It begins at rest, with u = 4 and an actuator that has done that before; then it makes 3 of 4.
  TEST_ASSERT_TRUE(std::abs(run.u(0, 0) - 4) <= rounding);
  TEST_ASSERT_TRUE(run.x(0, 8) < 29.5);
}

void test_references_begin_at_the_operating_point_and_go_to_their_value() {
  const Controller about = lqg_test::controller_of(tank);
  const ScenarioRun run = simulate::run_scenario(about, about.problem.scenarios.at(0));
  const auto r = [&](double time) { return run.r(0, static_cast<Index>(std::lround(time / 0.25))); };
  TEST_ASSERT_TRUE(r(0) == 70 && r(10) == 72 && r(32) == 70 && std::abs(r(37) - 70.5) < 1e-6 && r(50) == 71);
}

// Nothing is given: the plant, the filter, r and the input stay where they are.
void test_what_is_not_given_is_the_operating_point() {
  const Controller about = lqg_test::controller_of(tank);
  simulate::SimulationOptions options;
  options.samples = 40, options.noise = false;
  const simulate::Trajectory run = simulate::simulate(about, options);
  for (int k = 0; k < options.samples; ++k) {
    TEST_ASSERT_TRUE(std::abs(run.x(0, k) - 30) <= rounding && std::abs(run.x(1, k) - 70) <= rounding);
    TEST_ASSERT_TRUE(std::abs(run.u(0, k) - 4) <= rounding && std::abs(run.y(0, k) - 70) <= rounding);
    TEST_ASSERT_EQUAL_UINT(0, run.events[static_cast<std::size_t>(k)]);
  }
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_scenario_is_that_of_the_plant_at_zero_shifted);
  RUN_TEST(test_a_gain_of_an_actuator_is_of_u_itself);
  RUN_TEST(test_references_begin_at_the_operating_point_and_go_to_their_value);
  RUN_TEST(test_what_is_not_given_is_the_operating_point);
  return UNITY_END();
}
