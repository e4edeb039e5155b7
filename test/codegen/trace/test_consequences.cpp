// SPDX-License-Identifier: MIT
// What is said to follow from a test holds whenever the test passes, and is enough for every term of a sum.
#include <cmath>
#include <set>

#include <unity.h>

#include "program.hpp"
#include "trace/consequences.hpp"
#include "trace/print.hpp"

using namespace lqg::trace;
using namespace lqg_test;

namespace {

const Target targets[] = {{false, false}, {false, true}, {true, false}, {true, true}};

bool holds(const Consequence& consequence, const std::vector<double>& values) {
  const double value = values[static_cast<std::size_t>(consequence.node)];
  if (consequence.limit >= 0) return std::abs(value) < values[static_cast<std::size_t>(consequence.limit)];
  return std::abs(value) < consequence.bound;  // finite where that is infinite; a NaN is not below anything
}

// How often a condition passed that something follows from.
int check_consequences(const Graph& graph, const std::vector<double>& inputs) {
  int passed = 0;
  const std::vector<double> values = interpret(graph, inputs);
  for (int node = 0; node < static_cast<int>(values.size()); ++node) {
    if (!is_condition(graph.nodes()[static_cast<std::size_t>(node)].op) || values[static_cast<std::size_t>(node)] == 0)
      continue;
    for (const Consequence& consequence : consequences(graph, node)) {
      TEST_ASSERT_TRUE(holds(consequence, values));
      ++passed;
    }
  }
  return passed;
}

void test_what_follows_holds_in_random_programs_for_any_numbers() {
  Random random(1);
  int passed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Target target = targets[i % 4];
    Graph graph(target);
    record(random_program(random, target, 4, 40), graph);
    for (int k = 0; k < 10; ++k) {
      std::vector<double> inputs;
      for (int j = 0; j < 4; ++j) inputs.push_back(random_number(random, target));
      passed += check_consequences(graph, inputs);
    }
  }
  TEST_ASSERT_GREATER_THAN(10000, passed);
}

// Σ terms below 2^limit, as the emitted code ends, beside others that have to be finite.
struct Sum {
  Graph graph;
  int condition = -1;
  std::set<int> bounded, finite;

  Sum(Random& random, Target target) : graph(target) {
    int sum = -1, others = -1;
    for (int i = 0; i < 8; ++i) {
      const int x = graph.input(input_text(i), "in_" + std::to_string(i));
      if (i == 3)
        others = x, finite.insert(x);
      else if (i == 6)
        others = graph.make(Op::add, graph.make(Op::add, others, x), graph.constant(0.25)), finite.insert(x);
      else
        sum = with_term(random, sum, x), bounded.insert(x);
    }
    const int limit = graph.constant(std::ldexp(1.0, 2 * random.between(-3, 3)));
    condition = random.one_in(2) ? graph.make(Op::less, sum, limit)
                                 : graph.make(Op::usable, others, graph.make(Op::subtract, limit, sum));
    if (graph.nodes()[static_cast<std::size_t>(condition)].op == Op::less) finite.clear();
  }

  int with_term(Random& random, int sum, int x) {
    const bool is_square = random.one_in(2);
    if (sum < 0) return is_square ? graph.make(Op::multiply, x, x) : graph.make(Op::absolute, x);
    if (random.one_in(2))
      sum = graph.make(Op::multiply, graph.constant(std::ldexp(1.0, 2 * random.between(-2, 2))), sum);
    return is_square ? graph.make(Op::multiply_add, x, x, sum) : graph.make(Op::add, sum, graph.make(Op::absolute, x));
  }
};

void test_sum_bounds_each_term_and_others_are_finite() {
  Random random(2);
  for (int i = 0; i < 400; ++i) {
    const Sum sum(random, targets[i % 4]);
    std::set<int> bounded, finite;
    for (const Consequence& consequence : consequences(sum.graph, sum.condition))
      (std::isfinite(consequence.bound) ? bounded : finite).insert(consequence.node);
    for (const int x : sum.bounded) TEST_ASSERT_EQUAL(1, bounded.count(x));
    for (const int x : sum.finite) TEST_ASSERT_EQUAL(1, finite.count(x));
  }
}

// Near the bounds: each term alone close to the limit, the others small.
void test_sum_bounds_hold_next_to_the_limit() {
  Random random(3);
  int passed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Target target = targets[i % 4];
    const Sum sum(random, target);
    std::vector<double> inputs;
    for (int k = 0; k < 8; ++k)
      inputs.push_back(static_cast<double>(static_cast<float>(std::ldexp(random.uniform(), -20))));
    const double power = std::ldexp(1.0, random.between(-12, 12));
    inputs[static_cast<std::size_t>(random.below(8))] =
        target.is_double ? power * (1 + random.between(-3, 3) * 0x1p-53)
                         : static_cast<double>(static_cast<float>(power * (1 + random.between(-3, 3) * 0x1p-24)));
    passed += check_consequences(sum.graph, inputs);
  }
  TEST_ASSERT_GREATER_THAN(1000, passed);
}

void test_sum_with_a_term_of_any_sign_says_nothing() {
  Graph graph({});
  const int a = graph.input("in[0]", "a"), b = graph.input("in[1]", "b");
  const int sum = graph.make(Op::multiply_add, a, a, b);
  TEST_ASSERT_TRUE(consequences(graph, graph.make(Op::less, sum, graph.constant(4))).empty());
}

// The sign is tested beside the sum, and a NaN, which is not below 0 either, fails the sum.
void test_sum_with_a_term_that_is_tested_not_to_be_negative_bounds_it() {
  Graph graph({});
  const int a = graph.input("in[0]", "a"), b = graph.input("in[1]", "b");
  const int below = graph.make(Op::less, graph.make(Op::multiply_add, a, a, b), graph.constant(4));
  graph.make(Op::both, below, graph.make(Op::negation, graph.make(Op::less, b, graph.constant(0))));
  const double numbers[] = {0, -0.0, 1, -1, 1.75, -1.75, 3, 4, 1e30, -1e30, NAN, INFINITY, -INFINITY};
  int passed = 0;
  for (const double x : numbers)
    for (const double y : numbers) passed += check_consequences(graph, {x, y});
  TEST_ASSERT_GREATER_THAN(20, passed);
}

void test_prover_reads_what_follows_of_names_and_places_behind_the_stores() {
  Graph graph({false, false, true});
  const int a = graph.input("self->x[0]", "x_0"), b = graph.input("u[0]", "u_0");
  const int next = graph.make(Op::add, a, b);
  graph.name(next, "next");
  const int condition = graph.make(Op::less, graph.make(Op::multiply, next, next), graph.constant(4));
  const Printer printer(graph, {next, condition});
  TEST_ASSERT_EQUAL_STRING("RESTATED((next * next) < 4.0f, BELOW(self->x[0], 2.0))",
                           printer.test(condition, {{"self->x[0]", next}}).c_str());
  TEST_ASSERT_EQUAL_STRING("RESTATED((next * next) < 4.0f, BELOW(next, 2.0))", printer.expression(condition).c_str());
}

void test_prover_reads_an_input_that_is_not_stored_in_its_place() {
  Graph graph({false, false, true});
  const int a = graph.input("self->d[0]", "D");
  const int condition = graph.make(Op::finite, a);
  const Printer printer(graph, {condition});
  TEST_ASSERT_EQUAL_STRING("RESTATED((D - D) == 0.0f, FINITE(self->d[0]))",
                           printer.test(condition, std::vector<lqg::trace::Store>()).c_str());
  TEST_ASSERT_EQUAL_STRING("RESTATED((D - D) == 0.0f, FINITE(D))", printer.expression(condition).c_str());
  TEST_ASSERT_EQUAL_STRING("(D - D) == 0.0f", printer.test(condition, {{"self->d[0]", graph.constant(1)}}).c_str());
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_what_follows_holds_in_random_programs_for_any_numbers);
  RUN_TEST(test_sum_bounds_each_term_and_others_are_finite);
  RUN_TEST(test_sum_bounds_hold_next_to_the_limit);
  RUN_TEST(test_sum_with_a_term_of_any_sign_says_nothing);
  RUN_TEST(test_sum_with_a_term_that_is_tested_not_to_be_negative_bounds_it);
  RUN_TEST(test_prover_reads_what_follows_of_names_and_places_behind_the_stores);
  RUN_TEST(test_prover_reads_an_input_that_is_not_stored_in_its_place);
  return UNITY_END();
}
