// SPDX-License-Identifier: MIT
// Disturbances beside inputs and late outputs, which are states of the filter that the regulator was not made for.
#include <cmath>

#include <unity.h>

#include "design/loop/compensator.hpp"
#include "design/rounding.hpp"
#include "design/sampled/added_states.hpp"
#include "design/solve.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

// A motor with damping, whose torque is the input; the angle and the speed are measured.
Problem motor() {
  const MatrixXd A = (MatrixXd(2, 2) << 0, 1, 0, -0.5).finished(), B = (MatrixXd(2, 1) << 0, 2).finished();
  Problem problem = problem_of(Domain::continuous, 0.1, A, B, MatrixXd::Identity(2, 2));
  problem.regulator->Q = Eigen::Vector2d(10, 1).asDiagonal();
  problem.regulator->R *= 0.5;
  problem.estimator->W = Eigen::Vector2d(0.001, 0.02).asDiagonal();
  problem.estimator->V = Eigen::Vector2d(1e-4, 1e-3).asDiagonal();
  return problem;
}

Problem disturbed(Problem problem, double size) {
  problem.estimator->disturbance = {{0, size}};
  return problem;
}

Problem estimator_alone(Problem problem) {
  problem.regulator.reset();
  return problem;
}

void expect_doubles(const MatrixXd& expected, const RealMatrix& found, const char* name) {
  TEST_ASSERT_TRUE_MESSAGE(expected.rows() == found.rows() && expected.cols() == found.cols(), name);
  for (Index i = 0; i < found.rows(); ++i)
    for (Index j = 0; j < found.cols(); ++j) TEST_ASSERT_TRUE_MESSAGE(expected(i, j) == to_double(found(i, j)), name);
}

bool is_refused(const Problem& problem, const std::string& key, const std::string& words) {
  Findings findings;
  if (solve(problem, findings)) return false;
  for (const Finding& finding : findings)
    if (finding.key == key && finding.message.find(words) != std::string::npos) return true;
  return false;
}

// --- numbers ----------------------------------------------------------------------------------------------------

// By reference.py, late_and_disturbed_motor.
void test_late_and_disturbed_motor_has_the_reference_gains() {
  Problem problem = disturbed(motor(), 0.25);
  problem.plant.delay = 0.15;
  problem.plant.output_delay = Eigen::Vector2d(0.2, 0);
  const Solution found = solved(problem);
  const MatrixXd L = (MatrixXd(7, 2) << 0.36218135622065983, 0.072990572255443489, 0.11695570019770914,
                      0.4836161671920387, -0.086879081461232258, 0.56798359237414642, 0.34814739200348571,
                      0.034286324860596323, 0.32787946461884948, 0.011695570019770913, 0, 0, 0, 0)
                         .finished();
  const MatrixXd K = (MatrixXd(1, 7) << 3.5739833531365197, 2.3537908351656727, 1.6508287442307679, 0, 0,
                      0.22933611065773743, 0.42149263357303046)
                         .finished();
  expect_doubles(L, found.estimator->L, "L");
  expect_doubles(K, found.regulator->K, "K");
}

// --- beside a plant that is written with these states ---------------------------------------------------------------

// The motor, sampled in doubles, so that what is added can be written into its matrices.
Problem sampled_motor() {
  const MatrixXd A = (MatrixXd(2, 2) << 1, 0.0975, 0, 0.95).finished(), B = (MatrixXd(2, 1) << 0.01, 0.195).finished();
  Problem problem = estimator_alone(problem_of(Domain::discrete, 0.125, A, B, MatrixXd::Identity(2, 2)));
  problem.estimator->W = Eigen::Vector2d(0.001, 0.02).asDiagonal();
  problem.estimator->V = Eigen::Vector2d(1e-4, 1e-3).asDiagonal();
  problem.estimator->x0 = Eigen::Vector2d(0.5, -0.25);
  problem.estimator->P0 = (MatrixXd(2, 2) << 2, 0.5, 0.5, 1).finished();
  return problem;
}

// [x; d; angle[k−1]; angle[k−2]] of the motor, disturbed by 0.5 and heard two periods late.
Problem written_motor() {
  const Problem plain = sampled_motor();
  Problem problem = plain;
  Plant& plant = problem.plant;
  plant.A = MatrixXd::Zero(5, 5);
  plant.A.topLeftCorner(2, 2) = plain.plant.A;
  plant.A.col(2).head(2) = plain.plant.B;
  plant.A(2, 2) = plant.A(3, 0) = plant.A(4, 3) = 1;
  plant.B = MatrixXd::Zero(5, 1);
  plant.B.topRows(2) = plain.plant.B;
  plant.C = (MatrixXd(2, 5) << 0, 0, 0, 0, 1, 0, 1, 0, 0, 0).finished();
  plant.G = MatrixXd::Zero(5, 3);
  plant.G(0, 0) = plant.G(1, 1) = 1;
  plant.G(2, 2) = 0.5;
  plant.H = MatrixXd::Zero(2, 3);
  plant.states.clear();
  Estimator& kalman = *problem.estimator;
  kalman.W = Eigen::Vector3d(0.001, 0.02, 0.125).asDiagonal();  // a second of its samples has the variance 1
  kalman.Swv = MatrixXd::Zero(3, 2);
  MatrixXd start = MatrixXd::Zero(5, 3);  // the motor stood still before
  start.topRows(3).setIdentity();
  start(3, 0) = start(4, 0) = 1;
  MatrixXd P0 = MatrixXd::Zero(3, 3);
  P0.topLeftCorner(2, 2) = kalman.P0;
  P0(2, 2) = 1e4 * 0.125 * 0.25;
  kalman.x0 = start * Eigen::Vector3d(0.5, -0.25, 0);
  kalman.P0 = start * P0 * start.transpose();
  return problem;
}

Problem keyed_motor() {
  Problem problem = disturbed(sampled_motor(), 0.5);
  problem.plant.output_delay = Eigen::Vector2d(0.25, 0);
  return problem;
}

void expect_same_filters(const Problem& keyed, const Problem& written) {
  const Solution a = solved(keyed), b = solved(written);
  expect_rounded(b.plant.A, a.plant.A, "A");
  expect_rounded(b.start->x0, a.start->x0, "x0");
  expect_rounded(b.start->P0, a.start->P0, "P0");
  expect_rounded(b.estimator->L, a.estimator->L, "L");
  expect_rounded(b.estimator->L_predictor, a.estimator->L_predictor, "L_predictor");
  TEST_ASSERT_TRUE(a.estimator->L_schedule.size() == b.estimator->L_schedule.size());
  for (std::size_t k = 0; k < a.estimator->L_schedule.size(); ++k)
    expect_rounded(b.estimator->L_schedule[k], a.estimator->L_schedule[k], "L of a sample");
  TEST_ASSERT_TRUE(a.online.has_value() == b.online.has_value());
  if (a.online) expect_rounded(b.online->W, a.online->W, "W on line");
}

void test_filter_is_that_of_a_plant_written_with_the_added_states() {
  for (const Gain gain : {Gain::steady, Gain::schedule, Gain::online})
    for (const Form form : {Form::filter, Form::predictor}) {
      Problem keyed = keyed_motor(), written = written_motor();
      for (Problem* problem : {&keyed, &written}) {
        problem->estimator->gain = gain;
        problem->estimator->form = form;
        problem->estimator->horizon = gain == Gain::schedule ? 12 : 0;
      }
      expect_same_filters(keyed, written);
    }
}

// --- what disturbances do to the loop -------------------------------------------------------------------------------

// Where plant and controller rest while `load` acts beside the first input.
RealMatrix resting_state(const Problem& problem, const Solution& found, const Real& load) {
  const MeasuredPlant plant = measured_plant(problem, found);
  const Compensator controller = compensator(problem, found);
  const RealMatrix A = closed_loop(plant, controller).A;
  const RealMatrix pushed = above(plant.B.col(0), multiply(controller.B, plant.D.col(0))) * load;
  return *solve(identity(A.rows()) - A, pushed);
}

Problem random_disturbed_problem(std::uint64_t seed) {
  Problem problem = disturbed(random_problem(seed), 0.5);
  const double T = problem.plant.sample_time;
  problem.plant.delay = problem.plant.domain == Domain::continuous ? 0.7 * T * static_cast<double>(seed % 4)
                                                                   : T * static_cast<double>(seed % 3);
  if (problem.regulator->cost == Cost::continuous) problem.plant.delay = 0;
  if (seed % 2 == 0 && problem.regulator->cost != Cost::continuous)
    problem.regulator->input_rate = MatrixXd::Identity(problem.plant.B.cols(), problem.plant.B.cols());
  if (seed % 5 == 0 && problem.plant.delay > 0) problem.regulator->decay = 1.01;
  return problem;
}

void test_a_constant_load_moves_no_state_in_the_long_run() {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Problem problem = random_disturbed_problem(seed);
    Findings findings;
    const std::optional<Solution> found = solve(problem, findings);
    if (!found || found->loop.poles.empty()) continue;  // random plants need not show the disturbance
    ++seen;
    for (const std::complex<double>& pole : found->loop.poles) TEST_ASSERT_TRUE(std::abs(pole) < 1);
    const Digits scope(60);
    const RealMatrix rest = resting_state(problem, *found, Real(3));
    const Index nx = problem.plant.A.rows(), ns = compensator(problem, *found).A.rows();
    expect_small(largest_entry(rest.topRows(nx)), 1e-25, "state at rest");
    expect_small(abs(rest(rest.rows() - ns + nx, 0) - 3), 1e-25, "estimate of the load");
  }
  TEST_ASSERT_TRUE(seen > 30);
}

// Without the key the same loop has a steady error.
void test_the_motor_gives_way_to_a_load_only_without_the_key() {
  const Problem plain = motor();
  const Solution found = solved(plain), better = solved(disturbed(plain, 0.25));
  const Digits scope(60);
  TEST_ASSERT_TRUE(abs(resting_state(plain, found, Real(1))(0, 0)) > 0.1);
  expect_small(abs(resting_state(disturbed(plain, 0.25), better, Real(1))(0, 0)), 1e-25, "angle");
}

// decay would move the walk's pole outside of the circle: the regulator knows nothing of it.
void test_decay_and_disturbance_leave_the_regulator_what_it_was() {
  Problem problem = motor();
  problem.regulator->decay = 1.05;
  const Solution plain = solved(problem), found = solved(disturbed(problem, 0.25));
  expect_rounded(plain.regulator->K, found.regulator->K.leftCols(2), "K");
  TEST_ASSERT_TRUE(found.regulator->K(0, 2) == 1);
  TEST_ASSERT_TRUE(plain.regulator->poles == found.regulator->poles);
}

void test_disturbed_plant_costs_and_trembles_as_much_as_the_simulated_one_without_load() {
  const Solution plain = solved(motor()), little = solved(disturbed(motor(), 1e-6));
  const double ratio = *little.loop.cost_per_sample / *plain.loop.cost_per_sample;
  TEST_ASSERT_TRUE(ratio > 0.999999 && ratio < 1.001);
  TEST_ASSERT_TRUE(little.loop.rms->x.size() == 3 && little.loop.rms->x[2] == 0);
}

void test_structured_gain_cancels_the_disturbance_with_all_of_the_input() {
  Problem problem = disturbed(motor(), 0.25);
  problem.regulator->structure = (MatrixXd(1, 2) << 1, 0).finished();
  const Solution found = solved(problem);
  TEST_ASSERT_TRUE(found.regulator->K(0, 1) == 0 && found.regulator->K(0, 2) == 1);
  TEST_ASSERT_TRUE(found.regulator->structure->full.cols() == 3);
}

// --- late outputs -------------------------------------------------------------------------------------------------

void test_equally_late_outputs_add_poles_at_0_alone() {
  Problem late = motor();
  late.plant.output_delay = Eigen::Vector2d(0.3, 0.3);
  const Solution found = solved(late), plain = solved(motor());
  TEST_ASSERT_TRUE(found.estimator->poles.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) {
    const std::complex<double> wanted = i < 2 ? plain.estimator->poles[i] : 0;
    TEST_ASSERT_TRUE(std::abs(found.estimator->poles[i] - wanted) < 1e-12);
  }
  TEST_ASSERT_TRUE(*found.loop.cost_per_sample > *plain.loop.cost_per_sample);
}

// Forty states that only move on: the gain is that of the prompt estimate, moved on as well.
void test_long_chain_of_a_late_output_is_designed_for() {
  Problem late = estimator_alone(motor());
  late.plant.output_delay = Eigen::Vector2d(4, 0);
  const Solution found = solved(late);
  TEST_ASSERT_TRUE(found.estimator->poles.size() == 42);
  TEST_ASSERT_TRUE(found.estimator->poles[2] == 0.0);
}

// Noises that know of each other give the filter poles beside those of the prompt one.
void test_coupled_noises_of_late_and_prompt_outputs_are_designed_for() {
  Problem late = motor();
  late.plant.output_delay = Eigen::Vector2d(0.2, 0);
  late.estimator->V(0, 1) = late.estimator->V(1, 0) = 2e-4;
  const Solution found = solved(late);
  const Digits scope(50);
  const RealMatrix A = found.plant.A - multiply(found.estimator->L_predictor, found.plant.C);
  Real trace = A.trace();
  std::complex<double> sum = 0;
  for (const std::complex<double>& pole : found.estimator->poles) sum += pole;
  TEST_ASSERT_TRUE(std::abs(sum - to_double(trace)) < 1e-12);
}

// --- refusals -------------------------------------------------------------------------------------------------------

void test_disturbances_that_the_outputs_do_not_tell_are_refused() {
  Problem two = motor();
  two.plant.B = MatrixXd::Identity(2, 2);
  two.plant.C = MatrixXd::Identity(1, 2);
  two.plant.D = MatrixXd::Zero(1, 2);
  two.plant.H = MatrixXd::Zero(1, 2);
  two.regulator.reset();
  two.estimator->V = MatrixXd::Identity(1, 1);
  two.estimator->Swv = MatrixXd::Zero(2, 1);
  two.estimator->disturbance = {{0, 1}, {1, 1}};
  TEST_ASSERT_TRUE(is_refused(two, "kalman.disturbance", "is seen in no output"));
  Problem speed = disturbed(estimator_alone(motor()), 1);  // ẍ + x = u, the speed is measured: a zero at s = 0
  speed.plant.A(1, 0) = -1;
  speed.plant.C = (MatrixXd(2, 2) << 0, 1, 0, 2).finished();
  TEST_ASSERT_TRUE(is_refused(speed, "kalman.disturbance", "zero at z = 1"));
}

void test_what_states_cannot_say_of_late_outputs_is_refused() {
  Problem late = motor();
  late.plant.output_delay = Eigen::Vector2d(0, 0.2);
  const char* const key = "plant.output_delay";
  Problem problem = late;
  problem.plant.output_delay(1) = 0.25;
  TEST_ASSERT_TRUE(is_refused(problem, key, "whole periods"));
  problem = late;
  problem.estimator.reset();
  TEST_ASSERT_TRUE(is_refused(problem, key, "needs [kalman]"));
  problem = late;
  problem.plant.H(1, 0) = 0.1;
  TEST_ASSERT_TRUE(is_refused(problem, key, "plant.H"));
  problem = late;
  problem.estimator->Swv(0, 1) = 1e-5;
  TEST_ASSERT_TRUE(is_refused(problem, key, "cross_noise"));
  problem = late;
  problem.plant.D(1, 0) = 0.1;
  TEST_ASSERT_TRUE(is_refused(problem, key, "predictor"));
  problem.estimator->form = Form::predictor;
  (void)solved(problem);
  problem = late;
  problem.regulator->integral = Integral{{1}, MatrixXd::Identity(1, 1)};
  TEST_ASSERT_TRUE(is_refused(problem, "lqr.integral.outputs", "kalman.disturbance"));
}

void test_filter_structure_beside_added_states_is_refused() {
  Problem problem = disturbed(motor(), 1);
  problem.estimator->structure = MatrixXd::Ones(2, 2);
  TEST_ASSERT_TRUE(is_refused(problem, "kalman.structure", "disturbances"));
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_late_and_disturbed_motor_has_the_reference_gains);
  RUN_TEST(test_filter_is_that_of_a_plant_written_with_the_added_states);
  RUN_TEST(test_a_constant_load_moves_no_state_in_the_long_run);
  RUN_TEST(test_the_motor_gives_way_to_a_load_only_without_the_key);
  RUN_TEST(test_decay_and_disturbance_leave_the_regulator_what_it_was);
  RUN_TEST(test_disturbed_plant_costs_and_trembles_as_much_as_the_simulated_one_without_load);
  RUN_TEST(test_structured_gain_cancels_the_disturbance_with_all_of_the_input);
  RUN_TEST(test_equally_late_outputs_add_poles_at_0_alone);
  RUN_TEST(test_long_chain_of_a_late_output_is_designed_for);
  RUN_TEST(test_coupled_noises_of_late_and_prompt_outputs_are_designed_for);
  RUN_TEST(test_disturbances_that_the_outputs_do_not_tell_are_refused);
  RUN_TEST(test_what_states_cannot_say_of_late_outputs_is_refused);
  RUN_TEST(test_filter_structure_beside_added_states_is_refused);
  return UNITY_END();
}
