// SPDX-License-Identifier: MIT
// The emitted controller whose filter has disturbances and late outputs, in scenarios.
#include <algorithm>
#include <cmath>

#include <unity.h>

#include "../emit/design_text.hpp"
#include "emit/report/scenario_view.hpp"
#include "simulate/scenario_run.hpp"

using namespace lqg;
using controller::Controller;
using Eigen::Index;
using simulate::ScenarioRun;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  TEST_ASSERT_TRUE_MESSAGE(at != text.npos, from.c_str());
  return text.replace(at, from.size(), to);
}

ScenarioRun run_of(const std::string& text) {
  const Controller controller = lqg_test::controller_of(text);
  return simulate::run_scenario(controller, controller.problem.scenarios.at(0));
}

// A motor with damping whose angle follows a reference; a load of a fifth of the limit comes at 2 s.
const char* const motor = R"(
name = "motor"
[plant]
domain = "continuous"
sample_time = 0.02
A = [[0, 1], [0, -2]]
B = [[0], [5]]
C = [[1, 0]]
D = [[0]]
states = ["angle [rad]", "speed [rad/s]"]
inputs = ["torque [N m]"]
outputs = ["angle [rad]"]
[lqr]
Q = [10, 0.1]
R = [1]
track = ["angle"]
[kalman]
process_noise = [0, 1e-4]
measurement_noise = [1e-8]
disturbance = ["torque"]
[limits]
u_min = [-1]
u_max = [1]
[code]
real = "double"
[[scenario]]
name = "load"
duration = 20
noise = false
reference = [{ output = "angle", value = 0.2 }]
load = [{ input = "torque", value = -0.2, at = 2 }]
)";

double last_error(const ScenarioRun& run) { return std::abs(run.x(0, run.x.cols() - 1) - 0.2); }

// --- disturbances -------------------------------------------------------------------------------------------------

void test_a_load_leaves_no_error_with_the_key_and_one_without() {
  TEST_ASSERT_TRUE(last_error(run_of(motor)) < 1e-5);
  TEST_ASSERT_TRUE(last_error(run_of(replaced(motor, "disturbance = [\"torque\"]", ""))) > 0.01);
  TEST_ASSERT_TRUE(last_error(run_of(replaced(motor, "[\"torque\"]\n[limits]", "{ torque = 0.5 }\n[limits]"))) < 1e-5);
}

void test_the_load_is_what_the_filter_says_of_the_disturbance() {
  const ScenarioRun run = run_of(motor);
  TEST_ASSERT_TRUE(run.estimate.rows() == 3);
  const double found = run.estimate(2, run.estimate.cols() - 1);
  TEST_ASSERT_TRUE(std::abs(found + 0.2) < 1e-4);
}

void test_the_report_draws_the_load_beside_its_estimate() {
  const Controller controller = lqg_test::controller_of(motor);
  const emit::PageView view = emit::scenario_view(controller, emit::runs_to_show(controller).at(0));
  const auto chart = std::find_if(view.charts.begin(), view.charts.end(),
                                  [](const emit::Chart& each) { return each.title == "torque_disturbance [N m]"; });
  TEST_ASSERT_TRUE(chart != view.charts.end() && chart->curves.size() == 2);
  TEST_ASSERT_TRUE(chart->curves[0].y.back() == -0.2);
  TEST_ASSERT_TRUE(std::abs(chart->curves[1].y.back() + 0.2) < 1e-4);
}

// Late inputs, a weight on changes, the predictor's form, a filter on line: the same end.
void test_other_laws_and_forms_leave_no_error_either() {
  const std::string late = replaced(motor, "sample_time = 0.02", "sample_time = 0.02\ndelay = 0.05");
  TEST_ASSERT_TRUE(last_error(run_of(late)) < 1e-5);
  TEST_ASSERT_TRUE(last_error(run_of(replaced(late, "R = [1]", "R = [1]\ninput_rate = [3]"))) < 1e-5);
  for (const char* more : {"form = \"predictor\"", "gain = \"online\"", "gain = \"online\"\ncovariance = \"plain\""})
    TEST_ASSERT_TRUE(last_error(run_of(replaced(motor, "[limits]", std::string(more) + "\n[limits]"))) < 1e-5);
  const std::string heard_late = replaced(motor, "sample_time = 0.02", "sample_time = 0.02\noutput_delay = [0.06]");
  TEST_ASSERT_TRUE(last_error(run_of(heard_late)) < 1e-5);
}

void test_another_motor_than_the_design_knows_is_held_as_well() {
  const std::string other = "plant = { scale = [{ matrix = \"B\", factor = 0.8 }] }\n";
  TEST_ASSERT_TRUE(last_error(run_of(motor + other)) < 1e-5);
}

// 4 rad keep the torque at its limit for a second: nothing winds up meanwhile.
void test_an_input_at_its_limit_winds_nothing_up() {
  const ScenarioRun run = run_of(replaced(motor, "value = 0.2 }", "value = 4 }"));
  TEST_ASSERT_TRUE(run.numbers.share_at_limits.at(0) > 0.02);
  const Index before_load = 100;
  TEST_ASSERT_TRUE(run.x.row(0).head(before_load).maxCoeff() < 4.1);
  TEST_ASSERT_TRUE(run.estimate.row(2).head(before_load).cwiseAbs().maxCoeff() < 1e-6);
}

// --- late outputs -------------------------------------------------------------------------------------------------

const char* const heard = R"(
name = "heard"
[plant]
domain = "continuous"
sample_time = 0.1
output_delay = [0.3, 0]
A = [[0, 1], [-1, -0.2]]
B = [[0], [1]]
C = [[1, 0], [0, 1]]
[kalman]
process_noise = [0.01, 0.01]
measurement_noise = [1e-4, 1e-4]
initial_state = [0.5, -0.3]
[code]
real = "double"
[[scenario]]
name = "pushed"
duration = 3
noise = false
x0 = [0.5, -0.3]
input = [{ input = 0, value = 1 }, { input = 0, value = 2, sine = 1 }]
)";

// What is simulated is what the filter knows: without noise the estimate is the state, to the last digits.
void expect_right_estimate(const std::string& text, const char* what) {
  const ScenarioRun run = run_of(text);
  TEST_ASSERT_TRUE_MESSAGE((run.x - run.estimate.topRows(2)).cwiseAbs().maxCoeff() < 1e-12, what);
}

void test_filter_of_late_outputs_has_the_plant_that_is_simulated() {
  const std::string predictor = replaced(heard, "[code]", "form = \"predictor\"\n[code]");
  expect_right_estimate(heard, "filter");
  expect_right_estimate(predictor, "predictor");
  expect_right_estimate(replaced(predictor, "[kalman]", "D = [[0.7], [0]]\n[kalman]"), "D in predictor form");
  const std::string late = replaced(heard, "output_delay", "delay = 0.25\noutput_delay");
  expect_right_estimate(late, "late input");
  expect_right_estimate(replaced(late, "[kalman]", "D = [[0.7], [-0.4]]\n[kalman]"), "D of a late input");
}

void test_a_sensor_of_a_scenario_is_late_beyond_the_design() {
  const ScenarioRun designed = run_of(heard);
  const ScenarioRun later = run_of(heard + std::string("sensor = [{ output = 0, delay = 0.1 }]\n"));
  for (Index k = 1; k < later.y.cols(); ++k) TEST_ASSERT_TRUE(std::abs(later.y(0, k) - designed.y(0, k - 1)) < 1e-12);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_load_leaves_no_error_with_the_key_and_one_without);
  RUN_TEST(test_the_load_is_what_the_filter_says_of_the_disturbance);
  RUN_TEST(test_the_report_draws_the_load_beside_its_estimate);
  RUN_TEST(test_other_laws_and_forms_leave_no_error_either);
  RUN_TEST(test_another_motor_than_the_design_knows_is_held_as_well);
  RUN_TEST(test_an_input_at_its_limit_winds_nothing_up);
  RUN_TEST(test_filter_of_late_outputs_has_the_plant_that_is_simulated);
  RUN_TEST(test_a_sensor_of_a_scenario_is_late_beyond_the_design);
  return UNITY_END();
}
