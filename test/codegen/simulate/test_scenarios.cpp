// SPDX-License-Identifier: MIT
// What a scenario does to the plant, against closed forms; its runs against the simulation of the design's own plant.
#include <algorithm>
#include <cmath>

#include <unity.h>

#include "../emit/design_text.hpp"
#include "design/equations/sampling.hpp"
#include "design/numeric/digits.hpp"
#include "design/rounding.hpp"
#include "emit/report/scenario_view.hpp"
#include "simulate/period.hpp"
#include "simulate/prepared_scenario.hpp"
#include "simulate/scenario_numbers.hpp"
#include "simulate/simulation.hpp"

using namespace lqg;
using controller::Controller;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using simulate::ScenarioRun;

namespace {

const double rounding = 1e-12;  // of some hundred samples in double

// ẍ = u, the position is measured: an estimator alone, to which a scenario gives u.
const char* const mass = R"(
name = "mass"
[plant]
domain = "continuous"
sample_time = 0.1
A = [[0, 1], [0, 0]]
B = [[0], [1]]
C = [[1, 0]]
states = ["place [m]", "speed [m/s]"]
inputs = ["force [N]"]
outputs = ["place [m]"]
[kalman]
process_noise = [0, 1e-6]
measurement_noise = [1e-4]
[code]
real = "double"
)";

const char* const pushed = R"(
[[scenario]]
name = "pushed"
duration = 2
noise = false
input = [{ input = "force", value = 1 }]
)";

ScenarioRun run_of(const std::string& text) {
  const Controller controller = lqg_test::controller_of(text);
  return simulate::run_scenario(controller, controller.problem.scenarios.at(0));
}

// Row i of `found` at the times beside it is `wanted` of the time.
template <class Wanted>
void expect_curve(const VectorXd& times, const MatrixXd& found, Index i, Wanted wanted, const char* what) {
  TEST_ASSERT_TRUE_MESSAGE(times.size() > 0 && times.size() == found.cols(), what);
  for (Index k = 0; k < times.size(); ++k) {
    const std::string where = std::string(what) + " at " + std::to_string(times(k));
    TEST_ASSERT_TRUE_MESSAGE(std::abs(found(i, k) - wanted(times(k))) <= rounding, where.c_str());
  }
}

double ramp(double t) { return std::max(0.0, t); }
double parabola(double t) { return ramp(t) * ramp(t) / 2; }

// --- time -------------------------------------------------------------------------------------------------------

void test_a_period_is_that_of_many_digits() {
  const design::Digits digits(50);
  lqg_test::Random random(11);
  for (const double time : {1e-6, 0.01, 1.0, 30.0}) {
    const auto entries = [&](double) { return random.uniform(); };
    const MatrixXd A = MatrixXd::Zero(4, 4).unaryExpr(entries), B = MatrixXd::Zero(4, 2).unaryExpr(entries);
    const design::SampledPeriod wanted =
        design::sample({A.cast<design::Real>(), B.cast<design::Real>(), {}, {}}, design::Real(time));
    const simulate::Period found = simulate::period_of(A, B, time);
    const MatrixXd exact_A = design::to_doubles(wanted.A), exact_B = design::to_doubles(wanted.B);
    TEST_ASSERT_TRUE((found.A - exact_A).cwiseAbs().maxCoeff() <= 1e-13 * (1 + exact_A.cwiseAbs().maxCoeff()));
    TEST_ASSERT_TRUE((found.B - exact_B).cwiseAbs().maxCoeff() <= 1e-13 * (1 + exact_B.cwiseAbs().maxCoeff()));
  }
}

void test_a_course_is_a_step_a_ramp_a_sine_or_ends() {
  const std::string courses = R"(
[[scenario]]
name = "courses"
duration = 1
noise = false
input = [{ input = 0, value = 2, at = 0.2, until = 0.5 }, { input = 0, value = 3, at = 0.6, ramp = 0.2 },
         { input = 0, value = 0.5, sine = 2.5 }]
)";
  const Controller controller = lqg_test::controller_of(mass + courses);
  const MatrixXd input = simulate::courses_of(controller, controller.problem.scenarios[0]).input;
  for (int k = 0; k < 10; ++k) {
    const double t = 0.1 * k, step = k >= 2 && k < 5 ? 2 : 0, rise = k < 6 ? 0 : 3 * std::min(1.0, (t - 0.6) / 0.2);
    const double sine = 0.5 * std::sin(2 * std::acos(-1.0) * 2.5 * t);
    TEST_ASSERT_TRUE_MESSAGE(std::abs(input(0, k) - step - rise - sine) < 1e-8, std::to_string(k).c_str());
  }
}

void test_a_held_force_moves_a_mass_by_t_squared_halves_between_the_samples_too() {
  const ScenarioRun run = run_of(std::string(mass) + pushed);
  expect_curve(run.times, run.x, 0, parabola, "place");
  expect_curve(run.fine_times, run.fine_x, 0, parabola, "place between");
  expect_curve(run.fine_times, run.fine_outputs, 0, parabola, "output between");
  TEST_ASSERT_TRUE(run.fine_times.size() > 4 * run.times.size());
}

// 1, 1.5 and 2 periods, and one shorter than an instant.
void test_a_delay_of_any_part_of_a_period_moves_the_answer_by_itself() {
  for (const char* delay : {"0.1", "0.15", "0.2", "0.003", "0.0999"}) {
    const ScenarioRun run = run_of(std::string(mass) + pushed + "plant = { delay = " + delay + " }\n");
    const double late = std::stod(delay);
    expect_curve(run.times, run.x, 0, [late](double t) { return parabola(t - late); }, delay);
    expect_curve(run.fine_times, run.fine_x, 1, [late](double t) { return ramp(t - late); }, delay);
  }
}

void test_a_replaced_plant_answers_as_itself() {
  const ScenarioRun run = run_of(std::string(mass) + pushed +
                                 "plant = { A = [[0, 1], [0, -2]], scale = [{ matrix = \"B\", factor = 3 }] }\n");
  expect_curve(run.fine_times, run.fine_x, 1, [](double t) { return 1.5 * (1 - std::exp(-2 * t)); }, "speed");
}

void test_one_entry_is_scaled_by_the_names_of_its_row_and_column() {
  const ScenarioRun run =
      run_of(std::string(mass) + pushed +
             "plant = { scale = [{ matrix = \"A\", row = \"place\", column = \"speed\", factor = 2 }] }\n");
  expect_curve(run.fine_times, run.fine_x, 0, [](double t) { return 2 * parabola(t); }, "place");
  expect_curve(run.fine_times, run.fine_x, 1, ramp, "speed");
}

// ẍ = u sampled every 0.1 s: the design knows the samples, the scenario what lies between.
void test_a_continuous_plant_in_place_of_the_samples_is_seen_between_them() {
  const char* const sampled = R"(
name = "mass"
[plant]
domain = "discrete"
sample_time = 0.1
A = [[1, 0.1], [0, 1]]
B = [[0.005], [0.1]]
C = [[1, 0]]
[kalman]
process_noise = [0, 1e-6]
measurement_noise = [1e-4]
[code]
real = "double"
[[scenario]]
name = "between"
duration = 2
noise = false
input = [{ input = 0, value = 1 }]
)";
  const ScenarioRun samples = run_of(sampled);
  TEST_ASSERT_EQUAL(0, samples.fine_times.size());
  expect_curve(samples.times, samples.x, 0, parabola, "place at the samples");
  const ScenarioRun run = run_of(std::string(sampled) +
                                 "plant = { continuous = true, A = [[0, 1], [0, 0]], "
                                 "B = [[0], [1]] }\n");
  expect_curve(run.fine_times, run.fine_x, 0, parabola, "place between");
  TEST_ASSERT_TRUE((run.x - samples.x).cwiseAbs().maxCoeff() <= rounding);
}

// --- actuators, loads and sensors -----------------------------------------------------------------------------------

// ȧ = (1 − a)/τ: the speed is t − τ (1 − e^(−t/τ)).
void test_a_lag_of_the_actuator_is_first_order() {
  const ScenarioRun run =
      run_of(std::string(mass) + pushed + "actuator = [{ input = \"force\", time_constant = 0.25 }]\n");
  expect_curve(run.fine_times, run.fine_x, 1, [](double t) { return t - 0.25 * (1 - std::exp(-t / 0.25)); }, "speed");
}

// 0.5 more in each period of 0.1 s, to 0.8 at most, of which half acts.
void test_an_actuator_is_limited_slow_and_weak_in_this_order() {
  const ScenarioRun run =
      run_of(std::string(mass) + pushed + "actuator = [{ input = \"force\", rate = 5, max = 0.8, gain = 0.5 }]\n");
  double speed = 0, force = 0;
  for (Index k = 0; k < run.times.size(); ++k) {
    TEST_ASSERT_TRUE(std::abs(run.x(1, k) - speed) <= rounding);
    force = std::min(0.8, force + 0.5);
    speed += 0.1 * 0.5 * force;
  }
}

void test_loads_on_an_input_and_on_a_state_add_to_what_the_actuator_does() {
  const std::string loads = R"(
[[scenario]]
name = "loads"
duration = 2
noise = false
load = [{ input = "force", value = -1, at = 0.5 }, { state = "place", value = 3, at = 1 }]
actuator = [{ input = "force", gain = 0 }]
)";
  const ScenarioRun run = run_of(mass + loads);
  expect_curve(run.fine_times, run.fine_x, 1, [](double t) { return -ramp(t - 0.5); }, "speed");
  expect_curve(run.fine_times, run.fine_x, 0, [](double t) { return 3 * ramp(t - 1) - parabola(t - 0.5); }, "place");
}

void test_a_late_sensor_says_what_was_between_two_samples() {
  for (const char* delay : {"0.1", "0.07", "0.23"}) {
    const ScenarioRun run =
        run_of(std::string(mass) + pushed + "sensor = [{ output = \"place\", delay = " + delay + " }]\n");
    const double late = std::stod(delay);
    expect_curve(run.times, run.y, 0, [late](double t) { return parabola(t - late); }, delay);
    expect_curve(run.times, run.outputs, 0, parabola, "what it measures");
  }
}

void test_a_sensor_has_gain_bias_quantum_and_range_in_this_order() {
  const ScenarioRun run =
      run_of(std::string(mass) + pushed +
             "sensor = [{ output = 0, gain = 2, bias = 0.3, quantum = 0.25, min = 0.5, max = 3.1 }]\n");
  for (Index k = 0; k < run.times.size(); ++k) {
    const double exact = 2 * parabola(run.times(k)) + 0.3;
    const double wanted = std::clamp(std::round(exact / 0.25) * 0.25, 0.5, 3.1);
    TEST_ASSERT_TRUE(std::abs(run.y(0, k) - wanted) <= rounding);
  }
}

void test_drop_outs_and_outliers_are_told_and_left_out() {
  const ScenarioRun run = run_of(std::string(mass) + pushed +
                                 "dropout = [{ output = \"place\", from = 0.5, until = 0.8 }]\n"
                                 "outlier = [{ output = \"place\", value = 1e6, at = 1.2 }]\n");
  for (Index k = 0; k < run.times.size(); ++k) {
    const bool is_missing = k >= 5 && k < 8;
    TEST_ASSERT_EQUAL(is_missing, std::isnan(run.y(0, k)));
    TEST_ASSERT_EQUAL(is_missing || k == 12,
                      run.has(k, step::Event::output_rejected) || run.has(k, step::Event::output_gated));
  }
  TEST_ASSERT_TRUE(run.y(0, 12) == 1e6);
  TEST_ASSERT_EQUAL_UINT64(4, run.numbers.left_out[0]);
  TEST_ASSERT_TRUE(run.sigma(0, 7) > 1.1 * run.sigma(0, 4));
}

// Both sensors say the place. What the gate does not believe of one is not marked at the other.
void test_an_output_that_is_left_out_is_marked_at_its_own_chart() {
  std::string text = mass;
  text.replace(text.find("C = [[1, 0]]"), 12, "C = [[1, 0], [1, 0]]");
  text.replace(text.find("outputs = [\"place [m]\"]"), 23, "outputs = [\"place [m]\", \"again [m]\"]");
  text.replace(text.find("measurement_noise = [1e-4]"), 26, "measurement_noise = [1e-4, 1e-4]\ngate = 5");
  const Controller controller =
      lqg_test::controller_of(text + pushed + "outlier = [{ output = \"again\", value = 300, at = 1.2 }]\n" +
                              "dropout = [{ output = \"place\", from = 0.5, until = 0.55 }]\n");
  const ScenarioRun run = simulate::run_scenario(controller, controller.problem.scenarios[0]);
  for (Index k = 0; k < run.times.size(); ++k) {
    TEST_ASSERT_EQUAL(k == 5, run.left_out(0, k));
    TEST_ASSERT_EQUAL(k == 12, run.left_out(1, k));
  }
  const emit::PageView view = emit::scenario_view(controller, {controller.problem.scenarios[0], run});
  const auto events_of = [&](const char* title) {
    std::string words;
    for (const emit::Chart& chart : view.charts)
      if (chart.title == title && chart.id.find("-y") != std::string::npos)
        for (const emit::EventMark& event : chart.events) words += event.label + ";";
    return words;
  };
  TEST_ASSERT_EQUAL_STRING("left out;", events_of("place [m]").c_str());
  TEST_ASSERT_EQUAL_STRING("gated;", events_of("again [m]").c_str());
}

// --- beside the simulation of the design's own plant ------------------------------------------------------------

// The same numbers in the same order: the bits of simulate(), noise and all, where nothing has to be integrated.
void test_a_scenario_without_anything_is_the_simulation_bit_for_bit() {
  lqg_test::Random random(5);
  for (int count = 0; count < 12; ++count) {
    lqg_test::DesignText text = lqg_test::random_design(random, 1 + count % 4);
    if (text.domain != "discrete") continue;
    const Controller controller = lqg_test::controller_of(text);
    design::Scenario scenario;
    scenario.duration = 50 * text.sample_time;
    const ScenarioRun run = simulate::run_scenario(controller, scenario, 3);
    simulate::SimulationOptions options;
    options.samples = 50;
    options.seed = 3;
    const simulate::Trajectory wanted = simulate::simulate(controller, options);
    TEST_ASSERT_TRUE((run.x.array() == wanted.x.leftCols(50).array()).all());
    TEST_ASSERT_TRUE((run.u.array() == wanted.u.array()).all());
    TEST_ASSERT_TRUE((run.y.array() == wanted.y.array()).all());
    TEST_ASSERT_TRUE((run.estimate.array() == wanted.estimate.array()).all());
    TEST_ASSERT_TRUE(run.events == wanted.events);
    TEST_ASSERT_TRUE(std::abs(run.numbers.cost - wanted.cost.sum()) <= 1e-9 * std::abs(wanted.cost.sum()));
  }
}

// Over a long run σ² of a steady filter is that of the design.
void test_sigma_settles_at_the_covariance_of_the_design() {
  const Controller controller = lqg_test::controller_of(mass);
  design::Scenario scenario;
  scenario.duration = 200;
  const ScenarioRun run = simulate::run_scenario(controller, scenario);
  const MatrixXd P = design::to_doubles(controller.solution.estimator->P_posterior);
  for (int i = 0; i < 2; ++i)
    TEST_ASSERT_TRUE(std::abs(run.sigma(i, run.sigma.cols() - 1) / std::sqrt(P(i, i)) - 1) < 1e-9);
  TEST_ASSERT_TRUE(run.sigma(0, 0) > 2 * run.sigma(0, run.sigma.cols() - 1));
}

// --- numbers ------------------------------------------------------------------------------------------------------

// A second-order answer: overshoot e^(−πζ/√(1−ζ²)) at π/(ωn √(1−ζ²)).
void test_the_numbers_of_a_step_are_those_of_the_closed_form() {
  const char* const text = R"(
name = "follower"
[plant]
domain = "continuous"
sample_time = 0.001
A = [[-1]]
B = [[1]]
C = [[1]]
[lqr]
Q = [1]
R = [1]
track = [0]
[kalman]
process_noise = [1]
measurement_noise = [1]
[[scenario]]
name = "step"
duration = 3
reference = [{ output = 0, value = 2, at = 0.5 }]
)";
  const Controller controller = lqg_test::controller_of(text);
  const simulate::PreparedScenario prepared(controller, controller.problem.scenarios[0], 1);
  const double zeta = 0.4, omega = 10, damped = omega * std::sqrt(1 - zeta * zeta);
  ScenarioRun run;
  run.times = VectorXd::LinSpaced(3000, 0, 2.999);
  run.r = prepared.courses.reference;
  run.outputs = MatrixXd::Zero(1, 3000);
  const auto answer = [&](double t) {
    return 1 - std::exp(-zeta * omega * t) * (std::cos(damped * t) + zeta * omega / damped * std::sin(damped * t));
  };
  for (Index k = 500; k < 3000; ++k) run.outputs(0, k) = 2 * answer(run.times(k) - 0.5);
  run.x = run.outputs;
  run.u = MatrixXd::Zero(1, 3000);
  simulate::count_numbers(prepared, run);
  TEST_ASSERT_EQUAL_UINT(1, run.numbers.answers.size());
  const simulate::StepAnswer& found = run.numbers.answers[0];
  TEST_ASSERT_TRUE(std::abs(found.overshoot - std::exp(-std::acos(-1.0) * zeta / std::sqrt(1 - zeta * zeta))) < 1e-4);
  TEST_ASSERT_TRUE(found.at == run.times(500) && found.from == 0 && found.to == 2);
  double settled = 0, rise_begin = -1, rise_end = -1;
  for (double t = 0; t < 2.5; t += 1e-5) {
    if (std::abs(answer(t) - 1) > 0.02) settled = t;
    if (rise_begin < 0 && answer(t) >= 0.1) rise_begin = t;
    if (rise_end < 0 && answer(t) >= 0.9) rise_end = t;
  }
  TEST_ASSERT_TRUE(std::abs(*found.settling_time - settled) <= 0.0011);
  TEST_ASSERT_TRUE(std::abs(*found.rise_time - (rise_end - rise_begin)) <= 0.0011);
}

void test_an_answer_is_looked_at_until_the_next_event() {
  const char* const text = R"(
name = "follower"
[plant]
domain = "discrete"
sample_time = 0.1
A = [[0.5]]
B = [[0.5]]
C = [[1]]
[lqr]
Q = [1]
R = [1]
track = [0]
[[scenario]]
name = "two steps and a load"
duration = 6
noise = false
reference = [{ output = 0, value = 2, at = 1, until = 3 }]
load = [{ input = 0, value = 5, at = 5 }]
)";
  const ScenarioRun run = run_of(text);
  TEST_ASSERT_EQUAL_UINT(2, run.numbers.answers.size());
  TEST_ASSERT_TRUE(run.numbers.answers[0].settling_time && run.numbers.answers[1].settling_time);
  TEST_ASSERT_TRUE(run.numbers.answers[1].from == 2 && run.numbers.answers[1].to == 0);
  TEST_ASSERT_TRUE(run.numbers.answers[1].overshoot < 1e-6);
  TEST_ASSERT_TRUE(run.outputs(0, 59) > 1);
}

void test_a_loop_that_is_lost_ends_its_run() {
  const ScenarioRun run = run_of(std::string(mass) + R"(
[[scenario]]
name = "wrong sign"
duration = 200
input = [{ input = 0, value = 1 }]
plant = { A = [[0, 1], [0, 5]] }
)");
  TEST_ASSERT_TRUE(run.numbers.has_diverged);
  TEST_ASSERT_TRUE(run.times.size() < 2000 && run.times.size() == run.x.cols() && run.x.allFinite());
  TEST_ASSERT_EQUAL_UINT(static_cast<unsigned>(run.times.size()), run.events.size());
}

const char* const limited_text = R"(
name = "limited"
[plant]
domain = "continuous"
sample_time = 0.01
A = [[0, 1], [0, -1]]
B = [[0], [10]]
C = [[1, 0]]
[lqr]
Q = [100, 1]
R = [1e-4]
track = [0]
[kalman]
process_noise = [0, 1]
measurement_noise = [1e-6]
[limits]
u_min = [-0.5]
u_max = [2]
)";

void test_a_design_without_scenarios_is_shown_within_its_limits() {
  const Controller controller = lqg_test::controller_of(limited_text);
  const std::vector<design::Scenario> shown = simulate::scenarios_to_show(controller);
  TEST_ASSERT_EQUAL_UINT(3, shown.size());
  TEST_ASSERT_EQUAL_STRING("step of y0", shown[0].name.c_str());
  const ScenarioRun step = simulate::run_scenario(controller, shown[0]);
  TEST_ASSERT_TRUE(step.numbers.share_at_limits[0] == 0);
  TEST_ASSERT_TRUE(step.numbers.peak_u[0] > 0.1 && step.numbers.peak_u[0] <= 0.5);
  TEST_ASSERT_TRUE(step.numbers.answers.at(0).settling_time.has_value());
}

design::Scenario step_scenario(const char* name, double duration, int signal, double value, double at) {
  design::Scenario scenario;
  scenario.name = name;
  scenario.duration = duration;
  scenario.reference.resize(1);
  scenario.reference[0].signal = signal;
  scenario.reference[0].value = value;
  scenario.reference[0].at = at;
  return scenario;
}

void test_scenarios_of_several_designs_last_as_the_longest_with_the_smallest_step() {
  const std::vector<design::Scenario> common = simulate::common_scenarios(
      {{step_scenario("step of angle", 2, 0, -0.5, 0.2), step_scenario("step of speed", 1, 1, 3, 0.1)},
       {step_scenario("step of angle", 5, 3, 2, 0.5)}});
  TEST_ASSERT_EQUAL_UINT(2, common.size());
  TEST_ASSERT_TRUE(common[0].duration == 5 && common[0].reference[0].at == 0.5);
  TEST_ASSERT_TRUE(common[0].reference[0].value == -0.5);
  TEST_ASSERT_TRUE(common[1].duration == 1 && common[1].reference[0].value == 3);
}

void test_default_scenarios_take_times_by_name_and_keep_their_own_signal() {
  const Controller controller = lqg_test::controller_of(limited_text);
  const std::vector<design::Scenario> own = simulate::scenarios_to_show(controller);
  const std::vector<design::Scenario> shown =
      simulate::scenarios_to_show(controller, {step_scenario("step of y0", 7, 5, 0.125, 1)});
  TEST_ASSERT_EQUAL_UINT(own.size(), shown.size());
  TEST_ASSERT_TRUE(shown[0].duration == 7 && shown[0].reference[0].value == 0.125 && shown[0].reference[0].at == 1);
  TEST_ASSERT_EQUAL_INT(0, shown[0].reference[0].signal);
  TEST_ASSERT_TRUE(shown[1].duration == own[1].duration);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_period_is_that_of_many_digits);
  RUN_TEST(test_a_course_is_a_step_a_ramp_a_sine_or_ends);
  RUN_TEST(test_a_held_force_moves_a_mass_by_t_squared_halves_between_the_samples_too);
  RUN_TEST(test_a_delay_of_any_part_of_a_period_moves_the_answer_by_itself);
  RUN_TEST(test_a_replaced_plant_answers_as_itself);
  RUN_TEST(test_one_entry_is_scaled_by_the_names_of_its_row_and_column);
  RUN_TEST(test_a_continuous_plant_in_place_of_the_samples_is_seen_between_them);
  RUN_TEST(test_a_lag_of_the_actuator_is_first_order);
  RUN_TEST(test_an_actuator_is_limited_slow_and_weak_in_this_order);
  RUN_TEST(test_loads_on_an_input_and_on_a_state_add_to_what_the_actuator_does);
  RUN_TEST(test_a_late_sensor_says_what_was_between_two_samples);
  RUN_TEST(test_a_sensor_has_gain_bias_quantum_and_range_in_this_order);
  RUN_TEST(test_drop_outs_and_outliers_are_told_and_left_out);
  RUN_TEST(test_an_output_that_is_left_out_is_marked_at_its_own_chart);
  RUN_TEST(test_a_scenario_without_anything_is_the_simulation_bit_for_bit);
  RUN_TEST(test_sigma_settles_at_the_covariance_of_the_design);
  RUN_TEST(test_the_numbers_of_a_step_are_those_of_the_closed_form);
  RUN_TEST(test_an_answer_is_looked_at_until_the_next_event);
  RUN_TEST(test_a_loop_that_is_lost_ends_its_run);
  RUN_TEST(test_a_design_without_scenarios_is_shown_within_its_limits);
  RUN_TEST(test_scenarios_of_several_designs_last_as_the_longest_with_the_smallest_step);
  RUN_TEST(test_default_scenarios_take_times_by_name_and_keep_their_own_signal);
  return UNITY_END();
}
