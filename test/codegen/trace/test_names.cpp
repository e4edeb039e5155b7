// SPDX-License-Identifier: MIT
// What values are called: each by a name of its own, and by one that says what it is or what it is a part of.
#include <cctype>
#include <set>

#include <unity.h>

#include "program.hpp"
#include "trace/names.hpp"
#include "trace/print.hpp"

using namespace lqg::trace;
using namespace lqg_test;

namespace {

std::vector<std::string> all_names(const Graph& graph) {
  std::vector<bool> declared;
  for (const Node& node : graph.nodes()) declared.push_back(node.op != Op::constant);
  return names_of(graph, std::vector<bool>(graph.nodes().size(), true), declared);
}

std::string name_in(const Graph& graph, int node) { return all_names(graph)[static_cast<std::size_t>(node)]; }

bool is_identifier(const std::string& name) {
  if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0]))) return false;
  for (const char c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  return true;
}

// New nodes, named with few words or not at all, so that many want the same name; `x_2` may be asked for, too.
void test_names_are_unique_identifiers_however_often_they_are_asked_for() {
  const char* const words[] = {"x", "x_2", "x_part", "P_00", "x_part2"};
  const char* const suffixes[] = {"", "_2", "_3", "_part"};
  Random random(1);
  Graph graph({});
  graph.reserve({"x_3", "P_00_2"});
  int x = graph.input("in", "x");
  for (int i = 0; i < 2000; ++i) {
    graph.section("", suffixes[random.below(4)]);
    x = graph.make(Op::add, x, graph.constant(i + 1));
    if (random.one_in(2)) graph.name(x, words[random.below(5)]);
    if (random.one_in(3)) graph.hint(x, words[random.below(5)]);
  }
  const std::vector<std::string> names = all_names(graph);
  std::set<std::string> found = graph.reserved();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (graph.is_constant(static_cast<int>(i))) continue;
    TEST_ASSERT_TRUE_MESSAGE(is_identifier(names[i]), names[i].c_str());
    TEST_ASSERT_TRUE_MESSAGE(found.insert(names[i]).second, names[i].c_str());
  }
}

void test_the_second_of_two_that_want_a_name_gets_a_number() {
  Graph graph({});
  const int rate = graph.input("x[0]", "x_rate_gyro"), other = graph.input("x[1]", "x_rate_gyro");
  TEST_ASSERT_EQUAL_STRING("x_rate_gyro", name_in(graph, rate).c_str());
  TEST_ASSERT_EQUAL_STRING("x_rate_gyro_2", name_in(graph, other).c_str());
}

void test_a_reserved_name_is_left_to_what_has_it() {
  Graph graph({});
  graph.reserve({"loop_reset"});
  TEST_ASSERT_EQUAL_STRING("loop_reset_2", name_in(graph, graph.input("x[0]", "loop_reset")).c_str());
}

void test_a_value_without_a_name_is_a_part_of_the_first_that_is_made_of_it() {
  Graph graph({});
  const int x = graph.input("x[0]", "x");
  const int square = graph.make(Op::multiply, x, x), cube = graph.make(Op::multiply, square, x);
  const int law = graph.make(Op::add, graph.make(Op::add, square, cube), x);
  graph.name(law, "law_voltage");
  graph.name(graph.make(Op::add, square, cube), "later");
  TEST_ASSERT_EQUAL_STRING("later_part", name_in(graph, square).c_str());
  TEST_ASSERT_EQUAL_STRING("later_part2", name_in(graph, cube).c_str());
}

void test_what_nobody_needs_names_no_part() {
  Graph graph({});
  const int x = graph.input("x[0]", "x"), square = graph.make(Op::multiply, x, x);
  graph.name(graph.make(Op::add, square, x), "unneeded");
  const int law = graph.make(Op::multiply, square, square);
  graph.name(law, "law");
  const std::string text = Printer(graph, {law}).statements({{"u[0]", law}});
  TEST_ASSERT_TRUE_MESSAGE(text.find("law_part = x * x") != std::string::npos, text.c_str());
}

void test_a_hint_names_what_is_shared_and_gives_no_statement_to_what_is_not() {
  Graph graph({});
  const int x = graph.input("x[0]", "x");
  const int low = graph.make(Op::less, x, graph.constant(-8)), high = graph.make(Op::less, graph.constant(8), x);
  graph.hint(low, "below");
  graph.hint(high, "above");
  const int limited =
      graph.make(Op::select, low, graph.constant(-8), graph.make(Op::select, high, graph.constant(8), x));
  const std::string text = Printer(graph, {limited, low}).statements({{"u[0]", limited}});
  TEST_ASSERT_TRUE_MESSAGE(text.find("bool below = x < (-8.0f);") != std::string::npos, text.c_str());
  TEST_ASSERT_TRUE_MESSAGE(text.find("above") == std::string::npos, text.c_str());
}

void test_a_parameter_is_not_loaded() {
  Graph graph({});
  const int y = graph.input("y_angle", "y_angle"), doubled = graph.make(Op::add, y, y);
  TEST_ASSERT_EQUAL_STRING("\n    x[0] = y_angle + y_angle;\n",
                           Printer(graph, {doubled}).statements({{"x[0]", doubled}}).c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_names_are_unique_identifiers_however_often_they_are_asked_for);
  RUN_TEST(test_the_second_of_two_that_want_a_name_gets_a_number);
  RUN_TEST(test_a_reserved_name_is_left_to_what_has_it);
  RUN_TEST(test_a_value_without_a_name_is_a_part_of_the_first_that_is_made_of_it);
  RUN_TEST(test_what_nobody_needs_names_no_part);
  RUN_TEST(test_a_hint_names_what_is_shared_and_gives_no_statement_to_what_is_not);
  RUN_TEST(test_a_parameter_is_not_loaded);
  return UNITY_END();
}
