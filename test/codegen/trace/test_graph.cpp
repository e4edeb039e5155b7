// SPDX-License-Identifier: MIT
// The record of a traced run: folds that keep every bit, one node for one operation, names.
#include <map>
#include <set>
#include <tuple>

#include <unity.h>

#include "program.hpp"
#include "trace/expr.hpp"

using namespace lqg::trace;
using namespace lqg_test;

namespace {

constexpr Target targets[] = {{false, false}, {false, true}, {true, false}, {true, true}};

constexpr int programs = 1500, inputs = 6, operations = 60, runs = 6;

void expect_same_results(const Program& program, const std::vector<int>& nodes, const Graph& graph,
                         const std::vector<double>& in, int seed, int& compared) {
  const Results direct = evaluate(program, graph.target(), in);
  const std::vector<double> values = interpret(graph, in);
  for (std::size_t at = 0; at < program.size(); ++at) {
    if (!direct.is_honest[at]) continue;
    const double found = values[static_cast<std::size_t>(nodes[at])];
    if (same(found, direct.values[at])) {
      ++compared;
      continue;
    }
    char message[200];
    std::snprintf(message, sizeof message, "seed %d, double %d, fused %d, operation %d (Op %d): %a, folded %a", seed,
                  graph.target().is_double, graph.target().is_fused, static_cast<int>(at),
                  static_cast<int>(program[at].op), direct.values[at], found);
    TEST_FAIL_MESSAGE(message);
  }
}

void test_folds_keep_every_bit_of_finite_results() {
  int compared = 0;
  for (const Target target : targets)
    for (int seed = 0; seed < programs; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      const Program program = random_program(random, target, inputs, operations);
      Graph graph(target);
      const std::vector<int> nodes = record(program, graph);
      for (int run = 0; run < runs; ++run) {
        std::vector<double> in;
        for (int i = 0; i < inputs; ++i) in.push_back(random_number(random, target));
        expect_same_results(program, nodes, graph, in, seed, compared);
      }
    }
  // Half of what was computed is finite throughout, or the test says little.
  TEST_ASSERT_GREATER_THAN(4 * programs * runs * operations / 2, compared);
}

// op(a, b, c) is `result`: each of them x, y, a number (m is −1), or ' ' for none.
struct Fold {
  const char* what;
  Op op;
  char a, b, c, result;
};

int operand(Graph& graph, char what) {
  switch (what) {
    case 'x': return graph.input("x", "x");
    case 'y': return graph.input("y", "y");
    case 'm': return graph.constant(-1);
    case ' ': return -1;
    default: return graph.constant(what - '0');
  }
}

void test_what_does_not_change_a_value_is_left_out() {
  const Fold folds[] = {
      {"x + 0", Op::add, 'x', '0', ' ', 'x'},
      {"0 + x", Op::add, '0', 'x', ' ', 'x'},
      {"x − 0", Op::subtract, 'x', '0', ' ', 'x'},
      {"x · 0", Op::multiply, 'x', '0', ' ', '0'},
      {"0 · x", Op::multiply, '0', 'x', ' ', '0'},
      {"x · 1", Op::multiply, 'x', '1', ' ', 'x'},
      {"1 · x", Op::multiply, '1', 'x', ' ', 'x'},
      {"x / 1", Op::divide, 'x', '1', ' ', 'x'},
      {"0 / x", Op::divide, '0', 'x', ' ', '0'},
      {"0 x + y", Op::multiply_add, '0', 'x', 'y', 'y'},
      {"x 0 + y", Op::multiply_add, 'x', '0', 'y', 'y'},
      {"5 · 0 + y", Op::multiply_add, '5', '0', 'y', 'y'},
      {"0 · 5 + y", Op::multiply_add, '0', '5', 'y', 'y'},
      {"1 x + 0", Op::multiply_add, '1', 'x', '0', 'x'},
      {"x 1 + 0", Op::multiply_add, 'x', '1', '0', 'x'},
      {"y − 0 x", Op::multiply_subtract, '0', 'x', 'y', 'y'},
      {"y − x 0", Op::multiply_subtract, 'x', '0', 'y', 'y'},
      {"y − 5 · 0", Op::multiply_subtract, '5', '0', 'y', 'y'},
      {"y − 0 · 5", Op::multiply_subtract, '0', '5', 'y', 'y'},
      {"0 − −1 x", Op::multiply_subtract, 'm', 'x', '0', 'x'},
      {"1 ? x : y", Op::select, '1', 'x', 'y', 'x'},
      {"0 ? x : y", Op::select, '0', 'x', 'y', 'y'},
  };
  for (const Target target : targets)
    for (const Fold& fold : folds) {
      Graph graph(target);
      std::map<char, int> nodes;
      for (const char what : {fold.a, fold.b, fold.c, fold.result})
        if (!nodes.count(what)) nodes[what] = operand(graph, what);
      TEST_ASSERT_EQUAL_INT_MESSAGE(nodes[fold.result],
                                    graph.make(fold.op, nodes[fold.a], nodes[fold.b], nodes[fold.c]), fold.what);
    }
}

void test_a_value_with_itself_is_folded() {
  Graph graph({});
  const int x = graph.input("x", "x"), y = graph.input("y", "y");
  const int low = graph.make(Op::less, x, y);
  TEST_ASSERT_TRUE(graph.is_constant(graph.make(Op::subtract, x, x), 0));
  TEST_ASSERT_TRUE(graph.is_constant(graph.make(Op::divide, x, x), 1));
  TEST_ASSERT_EQUAL_INT(x, graph.make(Op::negate, graph.make(Op::negate, x)));
  const int size = graph.make(Op::absolute, x);
  TEST_ASSERT_EQUAL_INT(size, graph.make(Op::absolute, size));
  TEST_ASSERT_EQUAL_INT(x, graph.make(Op::select, low, x, x));
  TEST_ASSERT_EQUAL_INT(low, graph.make(Op::either, low, low));
  TEST_ASSERT_EQUAL_INT(low, graph.make(Op::negation, graph.make(Op::negation, low)));
}

void test_constants_fold_in_the_precision_of_the_target() {
  const double third = 1.0 / 3, in_float = static_cast<double>(1.0f / 3.0f);
  Graph doubles({true, false}), floats({false, false});
  TEST_ASSERT_TRUE(doubles.is_constant(doubles.make(Op::divide, doubles.constant(1), doubles.constant(3)), third));
  TEST_ASSERT_TRUE(floats.is_constant(floats.make(Op::divide, floats.constant(1), floats.constant(3)), in_float));
}

// (1 + ε)(1 − ε) − 1 is −ε² with one rounding and 0 with two.
void test_constants_fold_fused_only_where_the_target_is() {
  const double epsilon = 0x1p-23;
  for (const bool is_fused : {false, true}) {
    Graph graph({false, is_fused});
    const int a = graph.constant(1 + epsilon), b = graph.constant(1 - epsilon);
    const double expected = is_fused ? -epsilon * epsilon : 0;
    TEST_ASSERT_TRUE(graph.is_constant(graph.make(Op::multiply_add, a, b, graph.constant(-1)), expected));
    TEST_ASSERT_TRUE(graph.is_constant(graph.make(Op::multiply_subtract, a, b, graph.constant(1)), -expected));
  }
}

void test_constants_whose_result_is_not_finite_stay_an_operation() {
  Graph graph({});
  const int zero = graph.constant(0), one = graph.constant(1);
  const int largest = graph.constant(static_cast<double>(std::numeric_limits<float>::max()));
  TEST_ASSERT_TRUE(graph.nodes()[static_cast<std::size_t>(graph.make(Op::divide, one, zero))].op == Op::divide);
  TEST_ASSERT_TRUE(graph.nodes()[static_cast<std::size_t>(graph.make(Op::add, largest, largest))].op == Op::add);
}

void test_nothing_finite_lies_beyond_an_infinite_limit() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Graph graph({});
  const int x = graph.input("x", "x");
  TEST_ASSERT_TRUE(graph.is_constant(graph.make(Op::less, x, graph.constant(-infinity)), 0));
  TEST_ASSERT_TRUE(graph.is_constant(graph.make(Op::less, graph.constant(infinity), x), 0));
  TEST_ASSERT_FALSE(graph.is_constant(graph.make(Op::less, x, graph.constant(infinity))));
  TEST_ASSERT_FALSE(graph.is_constant(graph.make(Op::less, graph.constant(-infinity), x)));
}

bool commutes(Op op) {
  return op == Op::add || op == Op::multiply || op == Op::multiply_add || op == Op::multiply_subtract ||
         op == Op::either;
}

void test_an_operation_on_the_same_operands_is_made_once() {
  for (const Target target : targets)
    for (int seed = 0; seed < programs / 10; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      const Program program = random_program(random, target, inputs, operations);
      Graph graph(target);
      const std::vector<int> first = record(program, graph);
      std::set<std::tuple<Op, int, int, int>> seen;
      for (const Node& node : graph.nodes()) {
        if (node.a < 0) continue;
        const bool swaps = commutes(node.op) && node.b < node.a;
        TEST_ASSERT_TRUE(seen.emplace(node.op, swaps ? node.b : node.a, swaps ? node.a : node.b, node.c).second);
      }
    }
}

void test_order_of_factors_and_of_summands_does_not_matter() {
  Graph graph({});
  const int x = graph.input("x", "x"), y = graph.input("y", "y"), z = graph.input("z", "z");
  for (const Op op : {Op::add, Op::multiply}) TEST_ASSERT_EQUAL_INT(graph.make(op, x, y), graph.make(op, y, x));
  for (const Op op : {Op::multiply_add, Op::multiply_subtract})
    TEST_ASSERT_EQUAL_INT(graph.make(op, x, y, z), graph.make(op, y, x, z));
  for (const Op op : {Op::subtract, Op::divide, Op::less, Op::usable})
    TEST_ASSERT_NOT_EQUAL_INT(graph.make(op, x, y), graph.make(op, y, x));
}

void test_a_node_stands_after_all_that_it_uses() {
  Random random(1);
  Graph graph({});
  record(random_program(random, {}, inputs, operations), graph);
  for (int at = 0; at < static_cast<int>(graph.nodes().size()); ++at) {
    const Node& node = graph.nodes()[static_cast<std::size_t>(at)];
    TEST_ASSERT_TRUE(node.a < at && node.b < at && node.c < at);
  }
}

void test_zero_has_no_sign_and_is_one_node() {
  Graph graph({});
  TEST_ASSERT_EQUAL_INT(graph.constant(0.0), graph.constant(-0.0));
}

void test_the_first_name_of_a_node_is_kept() {
  Graph graph({});
  const int x = graph.input("in[0]", "x");
  graph.name(x, "other");
  graph.name(graph.constant(1), "one");
  TEST_ASSERT_EQUAL_STRING("x", graph.nodes()[static_cast<std::size_t>(x)].name.c_str());
  TEST_ASSERT_EQUAL_STRING("", graph.nodes()[static_cast<std::size_t>(graph.constant(1))].name.c_str());
}

void test_recordings_may_be_nested() {
  Graph outer({}), inner({});
  const Recording recording(outer);
  {
    const Recording nested(inner);
    TEST_ASSERT_EQUAL_PTR(&inner, &graph());
  }
  TEST_ASSERT_EQUAL_PTR(&outer, &graph());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_folds_keep_every_bit_of_finite_results);
  RUN_TEST(test_what_does_not_change_a_value_is_left_out);
  RUN_TEST(test_a_value_with_itself_is_folded);
  RUN_TEST(test_constants_fold_in_the_precision_of_the_target);
  RUN_TEST(test_constants_fold_fused_only_where_the_target_is);
  RUN_TEST(test_constants_whose_result_is_not_finite_stay_an_operation);
  RUN_TEST(test_nothing_finite_lies_beyond_an_infinite_limit);
  RUN_TEST(test_an_operation_on_the_same_operands_is_made_once);
  RUN_TEST(test_order_of_factors_and_of_summands_does_not_matter);
  RUN_TEST(test_a_node_stands_after_all_that_it_uses);
  RUN_TEST(test_zero_has_no_sign_and_is_one_node);
  RUN_TEST(test_the_first_name_of_a_node_is_kept);
  RUN_TEST(test_recordings_may_be_nested);
  return UNITY_END();
}
