// SPDX-License-Identifier: MIT
// Flash and stack that are stated, without the compiler that they are stated for: how values fit into registers, and
// the shipped designs against what that compiler once made. test/bench/estimates.sh compares with the compiler itself.
#include <fstream>
#include <sstream>
#include <string>

#include <unity.h>

#include "design_text.hpp"
#include "emit/plan/instructions.hpp"
#include "emit/plan/registers.hpp"
#include "trace/expr.hpp"

using namespace lqg_test;
using lqg::emit::Listing;
using lqg::emit::Traffic;
using lqg::trace::Expr;
using lqg::trace::Graph;
using lqg::trace::Recording;

namespace {

// In the order of their names: inputs first, as they are loaded, then what is computed of them and stored.
Listing listing_of(const Graph& graph, const std::vector<lqg::trace::Store>& stores, std::vector<int> results) {
  const lqg::trace::Printer printer(graph, results);
  Listing listing{graph.nodes(), {}, {}, stores, {}};
  for (int i = 0; i < static_cast<int>(graph.nodes().size()); ++i) {
    listing.needed.push_back(printer.needs(i));
    listing.declared.push_back(printer.needs(i) && printer.is_declared(i));
  }
  return listing;
}

Expr input(Graph& graph, int i) {
  const std::string index = std::to_string(i);
  return Expr::of(graph.input("x[" + index + "]", "x_" + index));
}

// y = 0.3 x0 + 2 x1, counted by hand: two loads, two constants of which 2 is an immediate one, four operations, one
// store.
void test_a_sum_of_products() {
  Graph graph({});
  const Recording recording(graph);
  const Expr y = Expr(0.3) * input(graph, 0) + Expr(2) * input(graph, 1);
  graph.name(y.node, "y");
  const Traffic count = traffic_of(listing_of(graph, {{"y[0]", y.node}}, {y.node}), 31);
  TEST_ASSERT_EQUAL_INT(3, count.operations);
  TEST_ASSERT_EQUAL_INT(2, count.loads);
  TEST_ASSERT_EQUAL_INT(1, count.stores);
  TEST_ASSERT_EQUAL_INT(1, count.constant_loads);
  TEST_ASSERT_EQUAL_INT(1, count.immediates);
  TEST_ASSERT_EQUAL_INT(1, count.pool);
  TEST_ASSERT_EQUAL_INT(0, count.spills + count.reloads + count.slots);
}

// Squares of 12 inputs that all wait for a second use at the end: 12 registers hold them; with 8, some have to wait in
// memory.
void test_values_that_find_no_register_are_spilled() {
  Graph graph({});
  const Recording recording(graph);
  std::vector<Expr> squares;
  for (int i = 0; i < 12; ++i) {
    const Expr x = input(graph, i);
    squares.push_back(x * x);
    graph.name(squares.back().node, "square");
  }
  Expr sum = squares[0] * squares[11];
  for (std::size_t i = 1; i < 12; ++i) sum = sum + squares[i] * squares[11 - i];
  for (std::size_t i = 0; i < 12; ++i) sum = sum + squares[i];
  graph.name(sum.node, "sum");
  const Listing listing = listing_of(graph, {{"y[0]", sum.node}}, {sum.node});
  const Traffic roomy = traffic_of(listing, 31), tight = traffic_of(listing, 8);
  TEST_ASSERT_EQUAL_INT(0, roomy.spills);
  TEST_ASSERT_EQUAL_INT(roomy.operations, tight.operations);
  TEST_ASSERT_GREATER_THAN_INT(0, tight.spills);
  TEST_ASSERT_GREATER_OR_EQUAL_INT(tight.spills, tight.reloads);
  TEST_ASSERT_LESS_OR_EQUAL_INT(8, tight.registers);
  TEST_ASSERT_LESS_OR_EQUAL_INT(12, tight.slots);
}

std::string shipped(const char* name) {
  std::ifstream file(std::string(LQG_DESIGNS_FOLDER) + "/" + name + ".toml");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Never less than compiled; at most 15 % more, and 24 bytes of which most are rounding.
void expect_stated(const char* name, const char* what, long stated, long compiled) {
  const std::string message =
      std::string(name) + ": " + what + " stated " + std::to_string(stated) + ", compiled " + std::to_string(compiled);
  TEST_ASSERT_TRUE_MESSAGE(stated >= compiled && stated <= compiled + compiled * 15 / 100 + 24, message.c_str());
}

// Compiled: by test/bench/estimates.sh with Debian's arm-none-eabi-gcc 12.2.1 20221205 (15:12.2.rel1-1), each as its
// file says.
void test_shipped_designs_are_stated_as_they_were_compiled() {
  constexpr struct {
    const char* name;
    long flash, stack;
  } compiled[] = {{"balancing_robot", 3104, 140},  {"ball_and_beam", 672, 8},   {"dc_motor", 3808, 156},
                  {"double_integrator", 1076, 40}, {"oven", 1392, 60},          {"quadrotor", 2376, 124},
                  {"quarter_car", 14592, 408},     {"range_tracker", 3620, 60}, {"servo", 900, 16},
                  {"two_mass", 1332, 52}};
  for (const auto& design : compiled) {
    const lqg::emit::Controller controller = controller_of(shipped(design.name));
    expect_stated(design.name, "flash", controller.cost.flash, design.flash);
    expect_stated(design.name, "stack", controller.cost.stack, design.stack);
  }
}

long instructions_on(const std::string& core, const std::vector<lqg::controller::CoreInstructions>& all) {
  for (const auto& [name, instructions] : all)
    if (name == core) return instructions;
  return -1;
}

// y = a x: a library's multiplication and its input, by hand from the costs in instructions.cpp.
void test_without_an_fpu_each_operation_is_a_call() {
  Graph graph({});
  const Recording recording(graph);
  const Expr y = Expr(0.3) * input(graph, 0);
  graph.name(y.node, "y");
  const auto all = instructions_of(listing_of(graph, {{"y[0]", y.node}}, {y.node}), false);
  TEST_ASSERT_EQUAL_INT(103 + 34, instructions_on("cortex-m0", all));
  TEST_ASSERT_EQUAL_INT(21 + 17, instructions_on("cortex-m3", all));
  TEST_ASSERT_TRUE(instructions_on("cortex-m4f", all) < instructions_on("cortex-m3", all));
  TEST_ASSERT_EQUAL_INT(instructions_on("cortex-m4f", all), instructions_on("cortex-m33", all));
}

void test_doubles_are_calls_where_the_fpu_has_floats_only() {
  Graph graph({true, false, false});
  const Recording recording(graph);
  const Expr y = Expr(0.3) * input(graph, 0);
  graph.name(y.node, "y");
  const auto all = instructions_of(listing_of(graph, {{"y[0]", y.node}}, {y.node}), true);
  TEST_ASSERT_EQUAL_INT(37 + 45, instructions_on("cortex-m4f", all));
  TEST_ASSERT_EQUAL_INT(180 + 121, instructions_on("rv32f", all));
  TEST_ASSERT_TRUE(instructions_on("cortex-m7", all) < 37);
  TEST_ASSERT_TRUE(instructions_on("rv64", all) < 37);
}

void test_fused_multiply_adds_are_not_stated_for_cores_without_them() {
  Graph graph({false, true, false});
  const Recording recording(graph);
  const Expr y = Expr(0.3) * input(graph, 0);
  graph.name(y.node, "y");
  Listing listing = listing_of(graph, {{"y[0]", y.node}}, {y.node});
  listing.is_fused = true;
  const auto all = instructions_of(listing, false);
  for (const char* core : {"cortex-m0", "cortex-m3", "rv32"}) TEST_ASSERT_EQUAL_INT(-1, instructions_on(core, all));
  for (const char* core : {"cortex-m4f", "cortex-m7", "cortex-m33", "cortex-m55", "rv32f", "rv64"})
    TEST_ASSERT_TRUE(instructions_on(core, all) > 0);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_sum_of_products);
  RUN_TEST(test_values_that_find_no_register_are_spilled);
  RUN_TEST(test_shipped_designs_are_stated_as_they_were_compiled);
  RUN_TEST(test_without_an_fpu_each_operation_is_a_call);
  RUN_TEST(test_doubles_are_calls_where_the_fpu_has_floats_only);
  RUN_TEST(test_fused_multiply_adds_are_not_stated_for_cores_without_them);
  return UNITY_END();
}
