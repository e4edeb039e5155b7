// SPDX-License-Identifier: MIT
// Plants of equations between samples: against closed forms and the exact samples of linear plants.
#include <cmath>

#include <unity.h>

#include "../plant_of_equations.hpp"
#include "simulate/motion.hpp"
#include "simulate/period.hpp"

using namespace lqg;
using design::Domain;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using lqg_test::plant_of;
using simulate::Held;
using simulate::Motion;

namespace {

const double tight = 1e-11;

Held held(double command) {
  Held result;
  result.command = VectorXd::Constant(1, command);
  return result;
}

void expect_near(double expected, double found, const char* what, double tolerance = tight) {
  TEST_ASSERT_TRUE_MESSAGE(std::abs(found - expected) <= tolerance,
                           (std::string(what) + ": " + std::to_string(found - expected) + " off").c_str());
}

// θ̈ = −sin θ from θ = 2 at rest: θ = 2 arcsin(k sn(K − t, k)) with k = sin 1, by mpmath with 40 digits.
void test_a_pendulum_swings_as_jacobis_functions_say() {
  const design::Plant plant = plant_of(Domain::continuous, {"th", "om"}, {"u"}, {"om", "u - sin(th)"}, {"th"});
  const Motion motion(plant, {}, {});
  const double times[] = {1, 5, 20};
  const double angles[] = {1.532727506038253442, -1.6841244365668093504, -1.6445675165127079016};
  const double rates[] = {-0.95310698545136362932, 0.77853857294699852167, -0.82757784094304781286};
  for (int i = 0; i < 3; ++i) {
    VectorXd x = Eigen::Vector2d(2, 0);
    motion.move(held(0), times[i], x);
    expect_near(angles[i], x(0), "angle");
    expect_near(rates[i], x(1), "rate");
  }
}

void test_a_linear_plant_moves_as_its_exact_samples_with_lag_and_loads() {
  const double a = -3, b = 7, tau = 0.02, T = 0.05;
  const design::Plant plant = plant_of(Domain::continuous, {"x", "v"}, {"u"}, {"v", "-3*x - 0.4*v + 7*u"}, {"x + u"});
  const Motion motion(plant, {}, {{0, tau}});
  Held all = held(1.5);
  all.load = VectorXd::Constant(1, 0.25);
  all.state_load = Eigen::Vector2d(0.1, -0.2);
  VectorXd x = Eigen::Vector3d(0.3, -0.1, 0.5);
  MatrixXd A(3, 3), B(3, 4);
  A << 0, 1, 0, a, -0.4, b, 0, 0, -1 / tau;
  B << 0, 0, 1, 0, 0, b, 0, 1, 1 / tau, 0, 0, 0;
  const simulate::Period exact = simulate::period_of(A, B, T);
  const VectorXd expected = exact.A * x + exact.B * Eigen::Vector4d(1.5, 0.25, 0.1, -0.2);
  motion.move(all, T, x);
  for (int i = 0; i < 3; ++i) expect_near(expected(i), x(i), "state", 1e-12);
}

void test_states_inputs_and_outputs_are_deviations_from_the_operating_point() {
  design::Plant plant = plant_of(Domain::continuous, {"x"}, {"u"}, {"-x^2 + u"}, {"x^2 + u"});
  design::OperatingPoint point;
  point.x = VectorXd::Constant(1, 3), point.u = VectorXd::Constant(1, 9), point.y = VectorXd::Constant(1, 18);
  plant.operating_point = point;
  const Motion motion(plant, {}, {});
  VectorXd x = VectorXd::Zero(1);
  motion.move(held(0), 10, x);
  expect_near(0, x(0), "at rest");
  expect_near(0.5 * 6.5 + 2, motion.outputs(VectorXd::Constant(1, 0.5), VectorXd::Constant(1, 2))(0), "output");
  motion.move(held(-9), 0.5, x);  // ẋ = −x²: x = 1/(1/3 + t)
  expect_near(1 / (1.0 / 3 + 0.5) - 3, x(0), "free");
}

void test_a_parameter_of_the_scenario_is_another_one_in_all_formulas() {
  design::Plant plant =
      plant_of(Domain::continuous, {"x"}, {"u"}, {"-rate*x + u"}, {"gain*x"}, {{"rate", 2}, {"gain", 3}});
  const Motion motion(plant, {{"rate", 5}}, {});
  VectorXd x = VectorXd::Constant(1, 1);
  motion.move(held(0), 0.3, x);
  expect_near(std::exp(-1.5), x(0), "rate");
  expect_near(6, motion.outputs(VectorXd::Constant(1, 2), VectorXd::Zero(1))(0), "gain");
}

void test_a_sampled_plant_moves_by_its_formula_and_its_lag_acts_at_once() {
  design::Plant plant = plant_of(Domain::discrete, {"x", "y"}, {"u"}, {"x*y + u", "y/2"}, {"x"});
  plant.sample_time = 0.1;
  VectorXd x = Eigen::Vector2d(2, 3);
  Motion(plant, {}, {}).move(held(1), 0.1, x);
  expect_near(7, x(0), "x", 0);
  expect_near(1.5, x(1), "y", 0);
  VectorXd lagged = Eigen::Vector3d(0, 0, 0);
  Motion(plant, {}, {{0, 0.1}}).move(held(1), 0.1, lagged);
  expect_near(1 - std::exp(-1), lagged(0), "what acts", 1e-15);
}

void test_a_plant_that_runs_away_or_has_no_value_is_infinite() {
  const auto moved = [](const std::string& f, double x0, double time) {
    const design::Plant plant = plant_of(Domain::continuous, {"x", "c"}, {"u"}, {f, "0"}, {"x"});
    VectorXd x = Eigen::Vector2d(x0, 1);
    Motion(plant, {}, {}).move(held(0), time, x);
    return x;
  };
  for (const VectorXd& x : {moved("x^2", 1, 2), moved("-sqrt(x) - 1", 1, 5), moved("log(x)", -1, 1)}) {
    TEST_ASSERT_TRUE(std::isinf(x(0)));
    TEST_ASSERT_TRUE(std::isinf(x(1)));
  }
  expect_near(1 / (1 - 0.5), moved("x^2", 1, 0.5)(0), "before it does");
}

// Friction that switches at rest: each step is as short as they get, and their number is bounded.
void test_a_jump_of_f_ends_and_stays_near() {
  const design::Plant plant = plant_of(Domain::continuous, {"v"}, {"u"}, {"-max(-1, min(1, 1e9*v))"}, {"v"});
  VectorXd v = VectorXd::Constant(1, 0.5);
  Motion(plant, {}, {}).move(held(0), 1, v);
  expect_near(0, v(0), "at rest", 0.05);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_pendulum_swings_as_jacobis_functions_say);
  RUN_TEST(test_a_linear_plant_moves_as_its_exact_samples_with_lag_and_loads);
  RUN_TEST(test_states_inputs_and_outputs_are_deviations_from_the_operating_point);
  RUN_TEST(test_a_parameter_of_the_scenario_is_another_one_in_all_formulas);
  RUN_TEST(test_a_sampled_plant_moves_by_its_formula_and_its_lag_acts_at_once);
  RUN_TEST(test_a_plant_that_runs_away_or_has_no_value_is_infinite);
  RUN_TEST(test_a_jump_of_f_ends_and_stays_near);
  return UNITY_END();
}
