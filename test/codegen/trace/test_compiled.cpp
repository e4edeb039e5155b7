// SPDX-License-Identifier: MIT
// Random computations, printed and compiled: the C computes what the graph says, to the bit. Brackets, order and types.
#include <cinttypes>
#include <cmath>
#include <limits>
#include <sstream>

#include <unity.h>

#include "../compiler.hpp"
#include "program.hpp"
#include "trace/print.hpp"

using namespace lqg::trace;
using namespace lqg_test;

namespace {

constexpr int functions = 150, inputs = 5, operations = 30, runs = 4;

// A computation as a C function f_3(in, out, flags, statuses), and what it is to give.
struct Function {
  std::string text;
  std::vector<std::vector<double>> in;        // of every run
  std::vector<std::vector<double>> expected;  // numbers, conditions, statuses
};

const char* array_of(Kind kind) {
  return kind == Kind::number ? "out" : kind == Kind::condition ? "conditions" : "statuses";
}

// One operation in `every` has a name; the others are printed inside what uses them.
Function random_function(Random& random, Target target, int number, int every) {
  Function function;
  const Program program = random_program(random, target, inputs, operations);
  Graph graph(target);
  const std::vector<int> nodes = record(program, graph);
  std::vector<Store> stores;
  std::vector<int> results;
  for (std::size_t at = program.size() - operations; at < program.size(); ++at) {
    if (random.one_in(every)) graph.name(nodes[at], "named");
    if (!random.one_in(4)) continue;
    stores.push_back(
        {std::string(array_of(kind(program, static_cast<int>(at)))) + "[" + std::to_string(results.size()) + "]",
         nodes[at]});
    results.push_back(nodes[at]);
  }
  function.text = "static void f_" + std::to_string(number) +
                  "(const real in[], real out[], int conditions[], lqg_status_t statuses[])\n{\n"
                  "    (void)in, (void)out, (void)conditions, (void)statuses;\n" +
                  Printer(graph, results).statements(stores) + "}\n";
  for (int run = 0; run < runs; ++run) {
    std::vector<double> in, expected;
    for (int i = 0; i < inputs; ++i) in.push_back(random_number(random, target));
    const std::vector<double> values = interpret(graph, in);
    for (const int result : results) expected.push_back(values[static_cast<std::size_t>(result)]);
    function.in.push_back(in);
    function.expected.push_back(expected);
  }
  return function;
}

std::string bits(double value, Target target) {
  char text[24];
  std::uint64_t wide;
  std::uint32_t narrow;
  const float number = static_cast<float>(value);
  std::memcpy(&wide, &value, sizeof wide);
  std::memcpy(&narrow, &number, sizeof narrow);
  std::snprintf(text, sizeof text, "0x%" PRIx64, target.is_double ? wide : narrow);
  return text;
}

// One line for each function and run: its number results as bits, then conditions and statuses.
std::string c_program(const std::vector<Function>& functions_of_file, Target target) {
  const std::string real = target.is_double ? "double" : "float", word = target.is_double ? "uint64_t" : "uint32_t";
  std::ostringstream text;
  text << "#include <inttypes.h>\n#include <math.h>\n#include <stdbool.h>\n"
       << "#include <stdint.h>\n#include <stdio.h>\n#include <string.h>\n"
       << "#include \"lqg/status.h\"\ntypedef " << real << " real;\ntypedef " << word << " word;\n"
       << "enum { results = " << operations << " };\n";
  for (const Function& function : functions_of_file) text << function.text;
  text << "static void (*const all[])(const real[], real[], int[], lqg_status_t[]) = {";
  for (std::size_t i = 0; i < functions_of_file.size(); ++i) text << (i ? ", f_" : "f_") << i;
  text << "};\nstatic const word inputs[][" << inputs << "] = {\n";
  for (const Function& function : functions_of_file)
    for (const std::vector<double>& in : function.in) {
      text << "{";
      for (const double value : in) text << bits(value, target) << ", ";
      text << "},\n";
    }
  text << "};\nint main(void)\n{\n    for (int i = 0; i < (int)(sizeof all / sizeof *all) * " << runs << "; i++) {\n"
       << "        real in[" << inputs << "], out[results] = {0};\n        int conditions[results] = {0};\n"
       << "        lqg_status_t statuses[results] = {0};\n        word words[results];\n\n"
       << "        memcpy(in, inputs[i], sizeof in);\n        all[i / " << runs << "](in, out, conditions, statuses);\n"
       << "        memcpy(words, out, sizeof words);\n        for (int k = 0; k < results; k++)\n"
       << "            printf(\"%" << "\" PRIx64 \" %d %u \", (uint64_t)words[k], conditions[k], statuses[k]);\n"
       << "        printf(\"\\n\");\n    }\n    return 0;\n}\n";
  return text.str();
}

double number_of(std::uint64_t bits_of_it, Target target) {
  double wide;
  float narrow;
  const std::uint32_t half = static_cast<std::uint32_t>(bits_of_it);
  std::memcpy(&wide, &bits_of_it, sizeof wide);
  std::memcpy(&narrow, &half, sizeof narrow);
  return target.is_double ? wide : static_cast<double>(narrow);
}

// A store of a result may be of any kind: the two arrays that it does not stand in hold 0.
void expect_line(const std::string& line, const std::vector<double>& expected, const Function& function,
                 Target target) {
  std::istringstream stream(line);
  for (const double value : expected) {
    std::uint64_t word;
    int condition;
    unsigned status;
    stream >> std::hex >> word >> std::dec >> condition >> status;
    TEST_ASSERT_FALSE_MESSAGE(stream.fail(), line.c_str());
    const double number = number_of(word, target);
    const double found = condition ? condition : status ? status : number;
    if (!same(value, found)) TEST_FAIL_MESSAGE((function.text + "is " + line).c_str());
  }
}

void compile_and_compare(Target target, int every) {
  Random random(static_cast<std::uint64_t>(every));
  std::vector<Function> all;
  for (int i = 0; i < functions; ++i) all.push_back(random_function(random, target, i, every));
  const auto folder = empty_folder("compiled");
  write(folder / "all.c", c_program(all, target));
  const Outcome compiled = run(as_c + " -O1 -I" LQG_INCLUDE_FOLDER " -o " + (folder / "all").string() + " " +
                               (folder / "all.c").string() + " -lm");
  TEST_ASSERT_TRUE_MESSAGE(compiled.succeeded, compiled.output.substr(0, 2000).c_str());
  const Outcome ran = run((folder / "all").string());
  TEST_ASSERT_TRUE(ran.succeeded);
  std::istringstream lines(ran.output);
  for (const Function& function : all)
    for (const std::vector<double>& expected : function.expected) {
      std::string line;
      TEST_ASSERT_TRUE(static_cast<bool>(std::getline(lines, line)));
      expect_line(line, expected, function, target);
    }
}

void compile_and_compare_all(int every) {
  for (const bool is_double : {false, true})
    for (const bool is_fused : {false, true}) compile_and_compare({is_double, is_fused}, every);
}

// Inputs have names; what is used once and has none needs its brackets.
void test_expressions_without_names_compile_to_what_the_graph_says() { compile_and_compare_all(1000000); }

void test_named_expressions_compile_to_what_the_graph_says() { compile_and_compare_all(3); }

// fma(--x, …) would be a decrement.
void test_the_sign_of_a_product_and_of_its_factor_stay_two_tokens() {
  for (const bool is_fused : {false, true}) {
    Graph graph({false, is_fused});
    const int x = graph.input("x", "x"), y = graph.input("y", "y");
    const int negative = graph.make(Op::negate, x);
    const int less = graph.make(Op::multiply_subtract, negative, y, y);
    const std::string text = Printer(graph, {less}).expression(less);
    TEST_ASSERT_TRUE_MESSAGE(text.find("--") == std::string::npos, text.c_str());
  }
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_expressions_without_names_compile_to_what_the_graph_says);
  RUN_TEST(test_named_expressions_compile_to_what_the_graph_says);
  RUN_TEST(test_the_sign_of_a_product_and_of_its_factor_stay_two_tokens);
  return UNITY_END();
}
