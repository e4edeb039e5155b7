// SPDX-License-Identifier: MIT
// Functions of lqg/functions.h in a graph: how they fold, print and count.
#include <string>

#include <unity.h>

#include "lqg/functions.h"
#include "trace/expr.hpp"
#include "trace/functions.hpp"
#include "trace/print.hpp"

using namespace lqg::trace;

namespace {

std::string printed(const Graph& graph, const Expr& result) {
  return Printer(graph, {result.node}).statements({{"out", result.node}});
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void test_a_function_of_a_number_is_a_number_as_the_target_has_it() {
  for (const bool is_double : {false, true}) {
    Graph graph({is_double, false});
    const Recording recording(graph);
    const double expected = is_double ? lqg_cos(0.7) : static_cast<double>(lqg_cosf(0.7f));
    TEST_ASSERT_TRUE(graph.is_constant(cos(Expr(is_double ? 0.7 : static_cast<double>(0.7f))).node, expected));
  }
}

void test_a_function_that_has_no_value_there_stays_a_call() {
  Graph graph({});
  const Recording recording(graph);
  TEST_ASSERT_TRUE(has(printed(graph, log(Expr(0)) + sqrt(Expr(-1))), "lqg_logf(0.0f) + lqg_sqrtf(-1.0f)"));
}

void test_a_sine_and_a_cosine_of_one_value_are_one_call() {
  Graph graph({true, false});
  const Recording recording(graph);
  const Expr angle = Expr::of(graph.input("x[0]", "angle"));
  const std::string text = printed(graph, cos(angle) * sin(angle));
  TEST_ASSERT_TRUE(has(text,
                       "    double sin_angle;\n    double cos_angle;\n    "
                       "lqg_sin_cos(angle, &sin_angle, &cos_angle);\n"));
  TEST_ASSERT_TRUE(has(text, "out = cos_angle * sin_angle;"));
}

void test_of_different_values_or_alone_they_are_not() {
  Graph graph({});
  const Recording recording(graph);
  const Expr a = Expr::of(graph.input("x[0]", "a")), b = Expr::of(graph.input("x[1]", "b"));
  TEST_ASSERT_TRUE(has(printed(graph, sin(a) + cos(b)), "lqg_sinf(a) + lqg_cosf(b)"));
  cos(a);  // which nothing needs
  TEST_ASSERT_FALSE(has(printed(graph, sin(a) + b), "sin_cos"));
}

void test_a_function_is_called_once_for_one_value_and_named_after_it() {
  Graph graph({});
  const Recording recording(graph);
  const Expr y = Expr::of(graph.input("y[0]", "y")), x = Expr::of(graph.input("y[1]", "x"));
  const Expr angle = atan2(y, x);
  const std::string text = printed(graph, angle * atan2(y, x) + angle);
  TEST_ASSERT_TRUE(has(text, "const float atan2_y = lqg_atan2f(y, x);"));
  TEST_ASSERT_TRUE(text.find("lqg_atan2f") == text.rfind("lqg_atan2f"));
}

void test_functions_count_as_about_their_multiply_adds() {
  Graph graph({});
  const Recording recording(graph);
  const Expr a = Expr::of(graph.input("x[0]", "a"));
  const Operations one = Printer(graph, {sin(a).node}).operations(),
                   both = Printer(graph, {sin(a).node, cos(a).node}).operations();
  TEST_ASSERT_EQUAL_INT(multiply_adds_of(Op::sine), one.total());
  TEST_ASSERT_TRUE(both.total() > one.total() && both.total() < 2 * one.total());
}

}  // namespace

void setUp(void) {}
void tearDown(void) {}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_function_of_a_number_is_a_number_as_the_target_has_it);
  RUN_TEST(test_a_function_that_has_no_value_there_stays_a_call);
  RUN_TEST(test_a_sine_and_a_cosine_of_one_value_are_one_call);
  RUN_TEST(test_of_different_values_or_alone_they_are_not);
  RUN_TEST(test_a_function_is_called_once_for_one_value_and_named_after_it);
  RUN_TEST(test_functions_count_as_about_their_multiply_adds);
  return UNITY_END();
}
