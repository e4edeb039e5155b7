// SPDX-License-Identifier: MIT
// End to end: a design file is parsed, solved and written, what was written is compiled with all warnings, and it runs.
//
// test_emitted [first seed] [seeds] tries other random designs.
#include <cstdlib>

#include <unity.h>

#include "design_text.hpp"
#include "emitted.hpp"

using namespace lqg_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const std::vector<Language> both = {Language::c, Language::cxx};

int first_seed = 0, seeds = 16;

void expect_design_to_pass(DesignText design, const std::string& name) {
  design.name = name;
  expect_emitted_to_pass(controller_of(design), both);
}

void test_an_estimator_alone_has_no_control() {
  DesignText design = double_integrator();
  design.Q.resize(0, 0);
  expect_design_to_pass(design, "estimator_alone");
  design.gain = "online";
  design.arithmetic = "fused";
  expect_design_to_pass(design, "estimator_alone_online");
}

void test_an_estimator_without_inputs() {
  DesignText design = double_integrator();
  design.Q.resize(0, 0), design.B.resize(0, 0);
  design.inputs = "";
  for (const char* gain : {"steady", "online"}) {
    design.gain = gain;
    expect_design_to_pass(design, std::string("no_input_") + gain);
  }
}

// Left to itself it doubles with every sample: 2²⁰⁰ is no float.
void test_an_estimator_alone_of_an_unstable_plant() {
  DesignText design = double_integrator();
  design.Q.resize(0, 0);
  design.A *= 2;
  expect_design_to_pass(design, "unstable_estimator");
}

void test_a_regulator_alone() {
  DesignText design = double_integrator();
  design.W.resize(0, 0), design.C.resize(0, 0), design.G.resize(0, 0);
  design.outputs = "";
  expect_design_to_pass(design, "regulator_alone");
  design.real = "double";
  design.u_min = VectorXd::Constant(1, -0.5), design.u_max = VectorXd::Constant(1, 0.3);
  expect_design_to_pass(design, "regulator_alone_limited");
}

void test_one_state() {
  DesignText design;
  design.A = MatrixXd::Constant(1, 1, 1.1);
  design.B = design.C = design.Q = design.R = design.W = MatrixXd::Constant(1, 1, 1);
  design.V = MatrixXd::Constant(1, 1, 0.1);
  expect_design_to_pass(design, "one_state");
  design.gain = "online";
  for (const char* covariance : {"ud", "plain"}) {
    design.covariance = covariance;
    expect_design_to_pass(design, std::string("one_state_") + covariance);
  }
}

// Everything that a filter may have, in both forms.
DesignText with_everything() {
  DesignText design = double_integrators(2);
  design.D = (MatrixXd(2, 2) << 0.3, 0, 0.1, -0.2).finished();
  design.V << 0.01, 0.004, 0.004, 0.02;
  design.Swv = (MatrixXd(2, 2) << 0.01, 0, -0.005, 0.02).finished();
  return design;
}

void test_D_cross_noise_and_correlated_outputs_in_both_forms() {
  DesignText design = with_everything();
  for (const char* form : {"filter", "predictor"})
    for (const char* gain : {"steady", "online"}) {
      design.form = form, design.gain = gain;
      design.arithmetic = (design.form == "filter") == (design.gain == "steady") ? "plain" : "fused";
      expect_design_to_pass(design, std::string("everything_") + form + "_" + gain);
    }
}

void test_D_cross_noise_and_correlated_outputs_with_plain_covariance_in_double() {
  DesignText design = with_everything();
  design.gain = "online", design.covariance = "plain", design.real = "double";
  expect_design_to_pass(design, "everything_plain");
}

// Some of the inputs have limits on one side only, or none.
void test_limits_on_one_side_only() {
  DesignText design = double_integrator();
  design.u_max = VectorXd::Constant(1, 0.1);
  expect_design_to_pass(design, "upper_limit");
  design.u_min = VectorXd::Constant(1, -0.1);
  design.u_max.resize(0);
  expect_design_to_pass(design, "lower_limit");
}

// 0 lies outside: so does what stands in for a −K x̂ that is not finite.
void test_limits_that_leave_zero_out() {
  DesignText design = double_integrator();
  design.u_min = VectorXd::Constant(1, 0.1), design.u_max = VectorXd::Constant(1, 0.3);
  expect_design_to_pass(design, "off_zero");
}

// 0.1 is no number of binary: u must not pass the limit of the file, whichever way it is rounded.
void test_u_never_passes_a_limit_that_float_cannot_express() {
  DesignText design = double_integrator();
  design.u_min = VectorXd::Constant(1, -0.7), design.u_max = VectorXd::Constant(1, 0.1);
  const lqg::emit::Controller controller = controller_of(design);
  for (const char* x : {"1e9f", "-1e9f"}) {
    const std::string u = run_with_header(controller, std::string(R"(#include <stdio.h>
#include "loop.h"
int main(void)
{
    static loop_t self;
    float u[1];
    self.x[0] = )") + x + R"(;
    (void)loop_control(&self, u);
    printf("%.17g\n", (double)u[0]);
    return 0;
}
)");
    TEST_ASSERT_TRUE(std::strtod(u.c_str(), nullptr) >= -0.7 && std::strtod(u.c_str(), nullptr) <= 0.1);
  }
}

// An actuator too weak for its plant: the loop of the vectors runs away.
void test_limits_too_tight_for_an_unstable_plant() {
  DesignText design = double_integrator();
  design.A *= 2;
  design.u_min = VectorXd::Constant(1, -0.01), design.u_max = VectorXd::Constant(1, 0.01);
  expect_design_to_pass(design, "too_weak");
}

// An input of that name, and its limits: two of the emitted names want to be NAME_U_MIN.
void test_an_input_named_min() {
  DesignText design = double_integrator();
  design.inputs = R"(["min [N]"])";
  design.u_min = VectorXd::Constant(1, -1), design.u_max = VectorXd::Constant(1, 1);
  expect_design_to_pass(design, "input_min");
}

// Names that the unrolled code gives to its own values, or to their second occurrence.
void test_signals_named_like_temporaries() {
  DesignText design = double_integrators(2);
  design.states = R"(["x", "self", "S", "innovation"])";
  design.inputs = R"(["u", "status"])";
  design.outputs = R"(["a", "a_a"])";
  design.gain = "online";
  for (const char* covariance : {"ud", "plain"}) {
    design.covariance = covariance;
    expect_design_to_pass(design, std::string("odd_names_") + covariance);
  }
}

void test_no_process_noise_at_all() {
  DesignText design = double_integrator();
  design.A << 0.9, 0.1, 0, 0.8;
  design.W << 0;
  design.gain = "online";
  for (const char* covariance : {"ud", "plain"}) {
    design.covariance = covariance;
    expect_design_to_pass(design, std::string("no_noise_") + covariance);
  }
}

// The input does nothing: K = 0, B = 0, and no use for u or the state in the code.
void test_an_input_without_effect() {
  DesignText design = double_integrator();
  design.A << 0.9, 0.1, 0, 0.8;
  design.B.setZero();
  expect_design_to_pass(design, "no_effect");
  design.W.resize(0, 0), design.C.resize(0, 0), design.G.resize(0, 0), design.outputs = "";
  expect_design_to_pass(design, "no_effect_regulator");
}

void test_an_initial_state_that_is_known_exactly() {
  DesignText design = double_integrator();
  design.gain = "online";
  design.P0 = MatrixXd::Zero(2, 2);
  design.x0 = MatrixXd::Constant(2, 1, 0.5);
  for (const char* covariance : {"ud", "plain"}) {
    design.covariance = covariance;
    expect_design_to_pass(design, std::string("known_") + covariance);
  }
}

// 13 states: indices of two digits.
void test_more_than_ten_states() {
  DesignText design = double_integrators(6);
  design.gain = "online";
  design.name = "twelve";
  expect_emitted_to_pass(controller_of(design), {Language::c});
}

// C and C++ in turn: what is particular to a language stands above.
void test_random_designs() {
  for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    DesignText design = random_design(random, 1 + seed % 8);
    design.name = "random_" + std::to_string(seed);
    expect_emitted_to_pass(controller_of(design), {seed % 2 ? Language::c : Language::cxx});
  }
}

// Unstable without their plants: with its own input on recorded outputs each of them left its bounds.
void test_predictor_forms_that_are_unstable_by_themselves() {
  for (const int seed : {1011, 1051, 1059}) {
    Random random(static_cast<std::uint64_t>(seed));
    DesignText design = random_design(random, 1 + seed % 8);
    design.name = "unstable_" + std::to_string(seed);
    expect_emitted_to_pass(controller_of(design), {Language::c});
  }
}

}  // namespace

int main(int argc, char** argv) {
  UNITY_BEGIN();
  if (argc > 1) {
    first_seed = std::atoi(argv[1]);
    seeds = argc > 2 ? std::atoi(argv[2]) : 1;
    RUN_TEST(test_random_designs);
    return UNITY_END();
  }
  RUN_TEST(test_an_estimator_alone_has_no_control);
  RUN_TEST(test_an_estimator_without_inputs);
  RUN_TEST(test_an_estimator_alone_of_an_unstable_plant);
  RUN_TEST(test_a_regulator_alone);
  RUN_TEST(test_one_state);
  RUN_TEST(test_D_cross_noise_and_correlated_outputs_in_both_forms);
  RUN_TEST(test_D_cross_noise_and_correlated_outputs_with_plain_covariance_in_double);
  RUN_TEST(test_limits_on_one_side_only);
  RUN_TEST(test_limits_that_leave_zero_out);
  RUN_TEST(test_u_never_passes_a_limit_that_float_cannot_express);
  RUN_TEST(test_limits_too_tight_for_an_unstable_plant);
  RUN_TEST(test_an_input_named_min);
  RUN_TEST(test_signals_named_like_temporaries);
  RUN_TEST(test_no_process_noise_at_all);
  RUN_TEST(test_an_input_without_effect);
  RUN_TEST(test_an_initial_state_that_is_known_exactly);
  RUN_TEST(test_more_than_ten_states);
  RUN_TEST(test_random_designs);
  RUN_TEST(test_predictor_forms_that_are_unstable_by_themselves);
  return UNITY_END();
}
