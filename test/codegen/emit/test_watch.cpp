// SPDX-License-Identifier: MIT
// Outputs that are watched: the gate, updates by one output alone, innovations and their variances.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include <unity.h>

#include "emit/c/header.hpp"
#include "emitted.hpp"
#include "servo_design.hpp"

using namespace lqg_test;
using lqg::design::Problem;
using lqg::design::Solution;
using lqg::emit::Controller;

namespace {

void gate_at_three(Problem& problem, Solution&) { problem.estimator->gate = 3; }
// With one, the widths tell a partial update from an update alone: a constant gain hears that the others are silent.
void without_a_gate(Problem& problem, Solution&) { problem.estimator->spike = std::numeric_limits<double>::infinity(); }

struct Kind {
  const char *gain, *covariance;
};
const Kind kinds[] = {{"steady", ""}, {"online", "ud"}, {"online", "plain"}};

DesignText design_of(const Kind& kind, DesignText design = double_integrators(2)) {
  design.gain = kind.gain, design.covariance = kind.covariance;
  design.name = "loop";
  return design;
}

void test_a_gate_in_every_filter() {
  for (const Kind& kind : kinds)
    expect_emitted_to_pass(changed(design_of(kind), gate_at_three), {Language::c, Language::cxx});
}

// Feed-through, cross noise and correlated outputs, fused.
void test_a_gate_beside_everything_else() {
  for (const Kind& kind : kinds) {
    DesignText design = design_of(kind);
    design.D = (Eigen::MatrixXd(2, 2) << 0.3, 0, 0.1, -0.2).finished();
    design.V << 0.01, 0.004, 0.004, 0.02;
    design.Swv = (Eigen::MatrixXd(2, 2) << 0.01, 0, -0.005, 0.02).finished();
    design.arithmetic = "fused", design.form = "predictor";
    expect_emitted_to_pass(changed(design, gate_at_three), {Language::c});
  }
}

// kalman.gate alone is as wide as the file has it; a spike is only looked for where nobody has said anything, or has
// asked.
void test_the_narrower_one_of_gate_and_spike_is_the_threshold() {
  const double infinity = std::numeric_limits<double>::infinity();
  struct Case {
    double gate;
    std::optional<double> spike;
    double threshold;
  };
  for (const Case& each : {Case{0, {}, 300}, Case{5, {}, 5}, Case{1000, {}, 1000}, Case{0, 50, 50},
                           Case{0, infinity, 0}, Case{5, 50, 5}, Case{50, 5, 5}, Case{5, infinity, 5}})
    for (const Kind& kind : kinds) {
      const Controller controller = changed(design_of(kind), [&](Problem& problem, Solution&) {
        problem.estimator->gate = each.gate, problem.estimator->spike = each.spike;
      });
      TEST_ASSERT_EQUAL_DOUBLE(each.threshold, controller.gate.sigma);
      TEST_ASSERT_EQUAL_INT(each.threshold > 0, controller.has.gate);
    }
}

// What a program prints in either style.
std::string run_in_both_styles(Controller controller, const std::string& body) {
  std::string printed[2];
  for (const bool compact : {false, true}) {
    controller.style = compact ? lqg::design::Style::compact : lqg::design::Style::unrolled;
    printed[compact] =
        run_with_header(controller,
                        "#include <stdio.h>\n#include <string.h>\n#include \"loop.h\"\n\nint main(void)\n{\n"
                        "    static loop_t self, other;\n    float y[LOOP_NY] = {0}, u[LOOP_NU] = {0};\n"
                        "    unsigned status = 0;\n\n    (void)y;\n    (void)u;\n    (void)status;\n"
                        "    loop_init(&self);\n    loop_init(&other);\n" +
                            body + "    return 0;\n}\n");
  }
  TEST_ASSERT_EQUAL_STRING(printed[0].c_str(), printed[1].c_str());
  return printed[0];
}

// Far off: left out, reported and counted, in that output alone; a reset keeps the count.
void test_an_unlikely_output_is_left_out_and_counted() {
  for (const Kind& kind : kinds) {
    const std::string printed = run_in_both_styles(changed(design_of(kind), gate_at_three), R"(
    y[1] = 100;
    printf("%u ", loop_update(&self, y));
    printf("%lu %lu %g %g ", self.gated[0], self.gated[1], (double)self.x[2], (double)self.x[3]);
    y[1] = 0.01f;
    printf("%u ", loop_update(&self, y));
    u[0] = 1e38f * 10;
    printf("%u %lu", loop_predict(&self, u), self.gated[1]);
)");
    TEST_ASSERT_EQUAL_STRING("2 0 1 0 0 0 16 1", printed.c_str());
  }
}

// The threshold is gate² S once the gate has narrowed: just inside and just outside of it.
void test_the_gate_is_where_the_variance_says() {
  for (const Kind& kind : kinds) {
    const std::string printed = run_in_both_styles(changed(design_of(kind, double_integrator()), gate_at_three), R"(
    float nu[LOOP_NY], S[LOOP_NY], low = 0, high = 1000;

    self.widening[0] = 1;
    loop_innovation(&self, y, nu, S);
    for (int k = 0; k < 60; k++) {
        loop_t copy = self;
        y[0] = (low + high) / 2;
        if (loop_update(&copy, y) & LQG_OUTPUT_GATED)
            high = y[0];
        else
            low = y[0];
    }
    printf("%.5f", (double)(low * low / S[0]));
)");
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 9, std::strtod(printed.c_str(), nullptr));
  }
}

// One output after the other is the update by all of them, to the bit; with constant gains only because these axes know
// nothing of each other, and the header says so.
void test_updates_by_one_output_each_are_the_update_by_all() {
  for (const Kind& kind : kinds) {
    const Controller controller = changed(design_of(kind), [](Problem&, Solution&) {});
    const std::string printed = run_in_both_styles(controller, R"(
    y[0] = 0.3f;
    y[1] = -0.2f;
    status |= loop_update(&self, y);
    status |= loop_update_y0(&other, y[0]);
    status |= loop_update_y1(&other, y[1]);
    printf("%u %d", status, memcmp(&self, &other, sizeof self) == 0);
)");
    TEST_ASSERT_EQUAL_STRING("0 1", printed.c_str());
    const bool says_so = lqg::emit::header(controller).find("An approximation: its gain") != std::string::npos;
    TEST_ASSERT_EQUAL_INT(controller.filter == lqg::step::Filter::steady, says_so);
  }
}

// All of them: the update. One of them: the update by it alone, whatever stands in the others' places.
void test_a_partial_update_is_the_update_by_those_that_are_used() {
  for (const Kind& kind : kinds) {
    const std::string printed = run_in_both_styles(changed(design_of(kind), without_a_gate), R"(
    const float nothing = 1e38f * 10 - 1e38f * 10;
    y[0] = 0.3f;
    y[1] = -0.2f;
    status |= loop_update(&self, y);
    status |= loop_partial_update(&other, y, ~0ul);
    printf("%u %d ", status, memcmp(&self, &other, sizeof self) == 0);
    y[0] = nothing;
    status |= loop_update_y1(&self, y[1]);
    status |= loop_partial_update(&other, y, 1ul << LOOP_Y_Y1);
    printf("%u %d ", status, memcmp(&self, &other, sizeof self) == 0);
    status |= loop_partial_update(&other, y, 0);
    printf("%u %d", status, memcmp(&self, &other, sizeof self) == 0);
)");
    TEST_ASSERT_EQUAL_STRING("0 1 0 1 0 1", printed.c_str());
  }
}

void test_a_partial_update_reports_the_outputs_that_are_used_only() {
  for (const Kind& kind : kinds) {
    const std::string printed = run_in_both_styles(changed(design_of(kind), [](Problem&, Solution&) {}), R"(
    const float absurd[] = {1e38f * 10 - 1e38f * 10, 1e38f * 10, 1e37f};
    for (int k = 0; k < 3; k++) {
        y[0] = absurd[k];
        y[1] = 0.1f;
        printf("%u,", loop_partial_update(&self, y, 1ul << LOOP_Y_Y0));
        printf("%u,", loop_partial_update(&self, y, 1ul << LOOP_Y_Y1));
        printf("%u ", loop_partial_update(&self, y, 3));
    }
    printf("%d", self.x[0] == 0);
)");
    TEST_ASSERT_EQUAL_STRING("257,0,257 257,0,257 257,0,257 1", printed.c_str());  // 257: output 0
  }
}

// An output that is decorrelated by another one has no update of its own.
void test_an_output_that_needs_another_has_no_update_of_its_own() {
  DesignText design = design_of(kinds[1]);
  design.V << 0.01, 0.004, 0.004, 0.02;
  const std::string header = lqg::emit::header(changed(design, [](Problem&, Solution&) {}));
  TEST_ASSERT_TRUE(header.find("loop_update_y0(") != std::string::npos);
  TEST_ASSERT_TRUE(header.find("loop_update_y1(") == std::string::npos);
}

void test_updates_by_one_output_are_there_only_where_the_design_asks_for_them() {
  for (const lqg::design::Updates updates : {lqg::design::Updates::all, lqg::design::Updates::each}) {
    const std::string header = lqg::emit::header(
        changed(design_of(kinds[0]), [&](Problem& problem, Solution&) { problem.code.updates = updates; }));
    TEST_ASSERT_EQUAL(updates == lqg::design::Updates::each, header.find("loop_update_y0(") != std::string::npos);
    TEST_ASSERT_TRUE(header.find("loop_partial_update(") != std::string::npos);
  }
}

// y1 is made independent by y0: without it nothing is heard of y1, which is said.
void test_a_partial_update_says_when_an_output_lacks_its_company() {
  DesignText design = design_of(kinds[1]);
  design.V << 0.01, 0.004, 0.004, 0.02;
  const std::string printed = run_in_both_styles(changed(design, [](Problem&, Solution&) {}), R"(
    y[0] = 0.1f;
    y[1] = 0.2f;
    printf("%u ", loop_partial_update(&self, y, 2));
    printf("%d ", memcmp(&self, &other, sizeof self) == 0);
    printf("%u ", loop_partial_update(&self, y, 1));
    status = loop_partial_update(&other, y, 3);
    printf("%u", status);
)");
  TEST_ASSERT_EQUAL_STRING("513 1 0 0", printed.c_str());  // 513: output 1
}

// P0 = I: S of the position is 1 + V, whatever makes the outputs uncorrelated.
void test_innovation_and_variance_are_those_of_the_outputs_as_they_are() {
  for (const Kind& kind : {kinds[1], kinds[2]}) {
    DesignText design = design_of(kind);
    design.V << 0.01, 0.004, 0.004, 0.02;
    const std::string printed = run_in_both_styles(changed(design, [](Problem&, Solution&) {}), R"(
    float nu[LOOP_NY], S[LOOP_NY];

    self.x[0] = 1;
    y[0] = 1.5f;
    y[1] = -0.25f;
    loop_innovation(&self, y, nu, S);
    printf("%g %g %.5g %.5g", (double)nu[0], (double)nu[1], (double)S[0], (double)S[1]);
)");
    TEST_ASSERT_EQUAL_STRING("0.5 -0.25 1.01 1.02", printed.c_str());
  }
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_gate_in_every_filter);
  RUN_TEST(test_the_narrower_one_of_gate_and_spike_is_the_threshold);
  RUN_TEST(test_a_gate_beside_everything_else);
  RUN_TEST(test_an_unlikely_output_is_left_out_and_counted);
  RUN_TEST(test_the_gate_is_where_the_variance_says);
  RUN_TEST(test_updates_by_one_output_each_are_the_update_by_all);
  RUN_TEST(test_an_output_that_needs_another_has_no_update_of_its_own);
  RUN_TEST(test_updates_by_one_output_are_there_only_where_the_design_asks_for_them);
  RUN_TEST(test_a_partial_update_is_the_update_by_those_that_are_used);
  RUN_TEST(test_a_partial_update_reports_the_outputs_that_are_used_only);
  RUN_TEST(test_a_partial_update_says_when_an_output_lacks_its_company);
  RUN_TEST(test_innovation_and_variance_are_those_of_the_outputs_as_they_are);
  return UNITY_END();
}
