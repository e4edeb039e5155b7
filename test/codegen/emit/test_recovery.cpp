// SPDX-License-Identifier: MIT
// In how many samples a controller is back to normal: against the closed forms of plants of one state.
#include <cmath>

#include <unity.h>

#include "emit/c/header.hpp"
#include "emitted.hpp"
#include "servo_design.hpp"

using namespace lqg_test;
using lqg::controller::Recovery;
using lqg::emit::Controller;
using Eigen::MatrixXd;

namespace {

MatrixXd one(double value) { return MatrixXd::Constant(1, 1, value); }

// x⁺ = a x + u + w, y = x + v, w and v of variance 1.
DesignText scalar_plant(double a) {
  DesignText design;
  design.A = one(a), design.B = one(1), design.C = one(1);
  design.W = one(1), design.V = one(1), design.noise = "discrete";
  design.gain = "steady", design.form = "filter";
  return design;
}

// The factor of the filter's error in a sample, a (1 − L), and P before an update: P = a² P/(P + 1) + 1, by hand.
struct Filter {
  double factor, P;
};
Filter filter_by_hand(double a) {
  const double P = (a * a + std::sqrt(a * a * a * a + 4)) / 2;
  return {a / (P + 1), P};
}

long two_digits_up(double samples) {
  const double unit = samples > 1000 ? 100 : samples > 100 ? 10 : 1;
  return static_cast<long>(std::ceil(samples / unit) * unit);
}

// From 1 to 2⁸⁰; without a gate there is the reset.
long samples_of_gate(const Controller& controller) {
  return controller.has.gate ? static_cast<long>(std::ceil(80 * std::log(2.0) / std::log(controller.gate.widen(0))))
                             : 1;
}

// Samples until factorⁿ bound ≤ √P.
double samples_from_bound(const Controller& controller, const Filter& filter) {
  const double start = std::ldexp(1.0, controller.bounds.x[0]);
  return std::ceil(std::log(start / std::sqrt(filter.P)) / -std::log(filter.factor));
}

void test_the_error_of_a_filter_dies_out_by_its_pole() {
  for (const double a : {0.5, 0.99, 1.0, 1.5}) {
    const Controller controller = controller_of(scalar_plant(a));
    const Filter filter = filter_by_hand(a);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, std::sqrt(filter.P), controller.recovery.within(0));
    TEST_ASSERT_EQUAL_INT64(
        two_digits_up(static_cast<double>(samples_of_gate(controller)) + samples_from_bound(controller, filter)),
        controller.recovery.samples);
  }
}

// P may have to settle before x̂ does.
void test_a_filter_that_carries_P_has_twice_that() {
  DesignText design = scalar_plant(0.99);
  design.gain = "online", design.covariance = "ud";
  const Controller controller = controller_of(design);
  TEST_ASSERT_EQUAL_INT64(two_digits_up(static_cast<double>(samples_of_gate(controller)) +
                                        2 * samples_from_bound(controller, filter_by_hand(0.99))),
                          controller.recovery.samples);
}

// What nothing drives and nothing forgets: named, and the rest has its number.
void test_states_that_no_noise_reaches_are_named() {
  DesignText design;
  design.A = Eigen::Vector2d(0.9, 1).asDiagonal();
  design.C = MatrixXd::Identity(2, 2);
  design.G = Eigen::Vector2d(1, 0);
  design.W = one(1), design.V = MatrixXd::Identity(2, 2), design.noise = "discrete";
  design.gain = "online", design.covariance = "plain", design.states = R"(["moving", "bias [m]"])";
  const Controller controller = controller_of(design);
  TEST_ASSERT_EQUAL_INT(1, static_cast<int>(controller.recovery.lasting.size()));
  TEST_ASSERT_EQUAL_INT(1, controller.recovery.lasting.front());
  TEST_ASSERT_TRUE(controller.recovery.samples > 0);
  const std::string header = lqg::emit::header(controller);
  TEST_ASSERT_TRUE(header.find("#define LOOP_RECOVERY_SAMPLES " + std::to_string(controller.recovery.samples) + " ") !=
                   std::string::npos);
  TEST_ASSERT_TRUE(header.find("/* No noise reaches bias:") != std::string::npos);
}

// The loop that a regulator closes has to come back, too.
void test_a_regulator_adds_its_own_time() {
  DesignText design = double_integrator();
  const long with = controller_of(design).recovery.samples;
  design.Q.resize(0, 0);
  const long without = controller_of(design).recovery.samples;
  TEST_ASSERT_TRUE(with > without);
  TEST_ASSERT_TRUE(without > 0);
}

void test_a_regulator_alone_promises_nothing() {
  DesignText design = double_integrator();
  design.W.resize(0, 0), design.V.resize(0, 0);
  TEST_ASSERT_TRUE(lqg::emit::header(controller_of(design)).find("RECOVERY_SAMPLES") == std::string::npos);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_the_error_of_a_filter_dies_out_by_its_pole);
  RUN_TEST(test_a_filter_that_carries_P_has_twice_that);
  RUN_TEST(test_states_that_no_noise_reaches_are_named);
  RUN_TEST(test_a_regulator_adds_its_own_time);
  RUN_TEST(test_a_regulator_alone_promises_nothing);
  return UNITY_END();
}
