// SPDX-License-Identifier: MIT
// The bounds of a state: far from everything that a loop does, and kept by the emitted code.
#include <cmath>
#include <limits>

#include <unity.h>

#include "emit/plan/plan.hpp"
#include "design/rounding.hpp"
#include "emitted.hpp"
#include "servo_design.hpp"

using namespace lqg_test;
using lqg::design::Problem;
using lqg::design::Solution;
using lqg::controller::Bounds;
using lqg::emit::Controller;

namespace {

constexpr int designs = 20;

void keep(Problem&, Solution&) {}

Bounds bounds_of(const DesignText& design) { return controller_of(design).bounds; }

struct Kind {
  const char *gain, *covariance, *form;
};
const Kind kinds[] = {{"steady", "", "filter"}, {"online", "ud", "filter"}, {"online", "plain", "predictor"}};

DesignText design_of(const Kind& kind) {
  DesignText design = double_integrators(2);
  design.gain = kind.gain, design.covariance = kind.covariance, design.form = kind.form;
  return design;
}

// What the filter does not know of any state at any time is nothing beside its bound, nor is where it begins.
void test_bounds_are_far_from_what_a_filter_does_not_know() {
  for (int seed = 0; seed < designs; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Controller controller = controller_of(random_design(random, 1 + seed % 6));
    const double margin = controller.target.is_double ? 0x1p61 : 0x1p32;
    const Eigen::VectorXd x0 = controller.x0;
    for (int i = 0; i < controller.size.nx; ++i) {
      const double bound = std::ldexp(1.0, controller.bounds.x[static_cast<std::size_t>(i)]);
      TEST_ASSERT_TRUE(bound >= margin * std::abs(x0(i)));
      TEST_ASSERT_TRUE(bound >= margin * std::sqrt(controller.problem.estimator->P0(i, i)));
      if (controller.solution.estimator && controller.solution.estimator->P_prior.size())
        TEST_ASSERT_TRUE(bound >=
                         margin * std::sqrt(lqg::design::to_double(controller.solution.estimator->P_prior(i, i))));
    }
  }
}

// Position in mm instead of m: its bound and that of its output are those numbers a thousand times as large, or as near
// as powers of 256 are; the speed's stays.
void test_bounds_follow_the_units() {
  DesignText design = double_integrator();
  const Bounds in_m = bounds_of(design);
  design.A(0, 1) *= 1000, design.B(0, 0) *= 1000;
  design.V *= 1e6;
  design.P0 = Eigen::Vector2d(1e6, 1).asDiagonal();
  design.Q = Eigen::Vector2d(1e-6, 1).asDiagonal();
  const Bounds in_mm = bounds_of(design);
  TEST_ASSERT_TRUE(in_mm.x[0] == in_m.x[0] + 8 || in_mm.x[0] == in_m.x[0] + 16);
  TEST_ASSERT_EQUAL_INT(in_m.x[1], in_mm.x[1]);
  TEST_ASSERT_TRUE(in_mm.innovation(0) >= 256 * in_m.innovation(0));
}

// A filter that believes to know all from the beginning: what its inputs may do counts instead.
void test_inputs_widen_the_bounds_of_states_that_are_known() {
  DesignText design = double_integrator();
  design.P0 = Eigen::MatrixXd::Zero(2, 2);
  design.W *= 1e-20, design.V *= 1e-20;
  design.u_min = Eigen::VectorXd::Constant(1, -1e4), design.u_max = Eigen::VectorXd::Constant(1, 1e4);
  const Bounds bounds = bounds_of(design);
  for (int i = 0; i < 2; ++i)
    TEST_ASSERT_TRUE(std::ldexp(1.0, bounds.x[static_cast<std::size_t>(i)]) >= 0x1p32 * 1e4 * std::abs(design.B(i, 0)));
}

// The largest variances of float: what P0 says is still within the bounds, and the sum of squares is a number.
void test_a_diffuse_start_is_within_the_bounds() {
  DesignText design = double_integrator();
  design.gain = "online", design.covariance = "ud";
  design.P0 = Eigen::MatrixXd::Identity(2, 2) * 1e30;
  const Bounds bounds = bounds_of(design);
  double sum = 0;
  for (const int bound : bounds.x) sum += 1e30 / std::ldexp(1.0, 2 * bound);
  TEST_ASSERT_TRUE(sum < 1e-6);
  for (const int bound : bounds.x)
    TEST_ASSERT_TRUE(std::ldexp(1.0, 2 * bound) < static_cast<double>(std::numeric_limits<float>::max()));
}

// Beyond that the filter would begin anew for ever: refused, with the state and what to do.
void test_a_start_beyond_the_squares_of_float_is_refused() {
  DesignText design = double_integrator();
  Controller controller = controller_of(design);
  controller.problem.estimator->P0(1, 1) = 1e37;
  lqg::design::Findings findings;
  TEST_ASSERT_FALSE(
      lqg::emit::make_controller(controller.problem, controller.solution, controller.source, findings).has_value());
  TEST_ASSERT_EQUAL_STRING("kalman.initial_covariance", findings.front().key.c_str());
  TEST_ASSERT_TRUE(findings.front().message.find("found 3.162e+18 for speed") != std::string::npos);
}

void test_integrals_have_bounds_and_a_regulator_alone_has_none() {
  const Controller controller = changed(limited_double_integrator(), integrate_position);
  TEST_ASSERT_EQUAL_INT(1, static_cast<int>(controller.bounds.xi.size()));
  TEST_ASSERT_TRUE(controller.bounds.error(0) == controller.bounds.innovation(0));
  DesignText alone = double_integrator();
  alone.W.resize(0, 0), alone.V.resize(0, 0);
  TEST_ASSERT_TRUE(bounds_of(alone).x.empty());
}

std::string run_in_both_styles(Controller controller, const std::string& body) {
  std::string printed[2];
  for (const bool compact : {false, true}) {
    controller.style = compact ? lqg::design::Style::compact : lqg::design::Style::unrolled;
    printed[compact] =
        run_with_header(controller,
                        "#include <math.h>\n#include <stdio.h>\n#include \"loop.h\"\n\nint main(void)\n{\n"
                        "    static const float bound[LOOP_NX] = LOOP_X_BOUNDS;\n    static loop_t self;\n"
                        "    float x[LOOP_NX], y[LOOP_NY] = {0}, u[LOOP_NU] = {0};\n\n"
                        "    (void)x, (void)y, (void)u, (void)bound;\n    loop_init(&self);\n" +
                            body + "    return 0;\n}\n");
  }
  TEST_ASSERT_EQUAL_STRING(printed[0].c_str(), printed[1].c_str());
  return printed[0];
}

// By hand, each state at its bound and just below it.
void test_set_state_keeps_the_bounds() {
  for (const Kind& kind : kinds) {
    const std::string printed = run_in_both_styles(changed(design_of(kind), keep), R"(
    for (int i = 0; i < LOOP_NX; i++) {
        for (int k = 0; k < LOOP_NX; k++)
            x[k] = 0;
        x[i] = nextafterf(bound[i], 0);
        printf("%u ", loop_set_state(&self, x));
        x[i] = -bound[i];
        printf("%u ", loop_set_state(&self, x));
    }
    printf("%lu", self.resets);
)");
    TEST_ASSERT_EQUAL_STRING("0 16 0 16 0 16 0 16 4", printed.c_str());
  }
}

// A spike costs its sample and no more: the estimate goes on as if the output were missing.
void test_an_absurd_output_is_as_good_as_none() {
  for (const Kind& kind : kinds) {
    const std::string printed = run_in_both_styles(changed(design_of(kind), keep), R"(
    loop_t other;
    int same = 1;

    x[0] = 100, x[1] = 2, x[2] = -50, x[3] = 1;
    loop_set_state(&self, x);
    other = self;
    y[1] = -50;
    for (int k = 0; k < 3; k++) {
        y[0] = k == 0 ? 1e30f : k == 1 ? -3e38f : 2e17f;
        printf("%u ", loop_update(&self, y));
        y[0] = (float)NAN;
        loop_update(&other, y);
        for (int i = 0; i < LOOP_NX; i++)
            same &= self.x[i] == other.x[i];
    }
    printf("%d %lu", same, self.resets);
)");
    TEST_ASSERT_EQUAL_STRING("257 257 257 1 0", printed.c_str());  // 257: output 0
  }
}

// Resets are counted until the next init; the loop then is where it began.
void test_resets_are_counted() {
  for (const Kind& kind : kinds) {
    const std::string printed = run_in_both_styles(changed(design_of(kind), keep), R"(
    const float hostile[] = {1e30f, (float)NAN, -(float)INFINITY};
    for (int k = 0; k < 3; k++) {
        u[0] = hostile[k];
        printf("%u ", loop_predict(&self, u));
    }
    printf("%lu %g ", self.resets, (double)self.x[0]);
    loop_init(&self);
    printf("%lu", self.resets);
)");
    TEST_ASSERT_EQUAL_STRING("16 16 16 3 0 0", printed.c_str());
  }
}

// An absurd y does not wind up an integral, and ξ itself begins anew beyond its bound.
void test_an_integral_keeps_its_bound() {
  const Controller controller = changed(limited_double_integrator(), integrate_position);
  const std::string bound = std::to_string(controller.bounds.xi[0]);
  const std::string printed = run_in_both_styles(controller, R"(
    y[0] = 1e30f;
    printf("%u ", loop_update(&self, y));
    printf("%u ", loop_predict(&self, u));
    printf("%g ", (double)self.xi[0]);
    self.xi[0] = nextafterf(ldexpf(1, )" + bound + R"(), 0);
    printf("%u ", loop_predict(&self, u));
    self.xi[0] = ldexpf(1, )" + bound + R"();
    printf("%u ", loop_predict(&self, u));
    printf("%g %lu", (double)self.xi[0], self.resets);
)");
  TEST_ASSERT_EQUAL_STRING("257 0 0 0 16 0 1", printed.c_str());
}

// What is on its way is part of the state.
void test_inputs_on_their_way_keep_their_bounds() {
  const std::string printed = run_in_both_styles(changed(double_integrator(), delay_input), R"(
    u[0] = nextafterf(bound[3], 0) * 0.5f;
    printf("%u ", loop_set_input(&self, u));
    u[0] = bound[3];
    printf("%u ", loop_set_input(&self, u));
    printf("%lu", self.resets);
)");
  TEST_ASSERT_EQUAL_STRING("0 16 1", printed.c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_bounds_are_far_from_what_a_filter_does_not_know);
  RUN_TEST(test_bounds_follow_the_units);
  RUN_TEST(test_inputs_widen_the_bounds_of_states_that_are_known);
  RUN_TEST(test_a_diffuse_start_is_within_the_bounds);
  RUN_TEST(test_a_start_beyond_the_squares_of_float_is_refused);
  RUN_TEST(test_integrals_have_bounds_and_a_regulator_alone_has_none);
  RUN_TEST(test_set_state_keeps_the_bounds);
  RUN_TEST(test_an_absurd_output_is_as_good_as_none);
  RUN_TEST(test_resets_are_counted);
  RUN_TEST(test_an_integral_keeps_its_bound);
  RUN_TEST(test_inputs_on_their_way_keep_their_bounds);
  return UNITY_END();
}
