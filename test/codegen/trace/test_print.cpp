// SPDX-License-Identifier: MIT
// From the graph to C: literals that read back, lines that are broken between tokens, nothing that nobody needs.
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

#include <unity.h>

#include "program.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

using namespace lqg::trace;
using namespace lqg_test;

namespace {

// A C compiler reads a literal without a suffix as a double and one with `f` as a float.
void expect_double_reads_back(double value) {
  const std::string text = literal(value, true);
  char* end = nullptr;
  const double found = std::strtod(text.c_str(), &end);
  if (found != value || std::signbit(found) != std::signbit(value) || *end != '\0' ||
      text.find_first_of(".e") == std::string::npos)
    TEST_FAIL_MESSAGE(text.c_str());
}

void expect_float_reads_back(float value) {
  const std::string text = literal(static_cast<double>(value), false);
  char* end = nullptr;
  const float found = std::strtof(text.c_str(), &end);
  if (found != value || std::signbit(found) != std::signbit(value) || *end != 'f' || end[1] != '\0' ||
      text.find_first_of(".e") == std::string::npos)
    TEST_FAIL_MESSAGE(text.c_str());
}

void test_literal_of_any_finite_bits_reads_back() {
  Random random(1);
  for (int i = 0; i < 1000000; ++i) {
    const double value = random.pattern<double>();
    if (std::isfinite(value)) expect_double_reads_back(value);
    const float number = random.pattern<float>();
    if (std::isfinite(number)) expect_float_reads_back(number);
  }
}

void test_literal_of_subnormal_and_of_honest_numbers_reads_back() {
  Random random(2);
  for (int i = 0; i < 300000; ++i) {
    expect_double_reads_back(std::ldexp(random.uniform(), -1022 - random.below(52)));
    expect_float_reads_back(std::ldexp(static_cast<float>(random.uniform()), -126 - random.below(23)));
    expect_double_reads_back(std::ldexp(random.uniform(), random.between(-20, 20)));
    expect_float_reads_back(static_cast<float>(std::ldexp(random.uniform(), random.between(-20, 20))));
    expect_double_reads_back(random.between(-100000, 100000));
    expect_float_reads_back(static_cast<float>(random.between(-100000, 100000)));
  }
}

template <class T, class Expect>
void expect_at_the_ends(Expect expect) {
  using Limits = std::numeric_limits<T>;
  for (const T value :
       {T(0), Limits::min(), Limits::denorm_min(), Limits::max(), Limits::epsilon(), T(1) / 3, T(1e10)}) {
    expect(value);
    expect(-value);
  }
}

void test_literal_at_the_ends_of_the_range_reads_back() {
  expect_at_the_ends<double>(expect_double_reads_back);
  expect_at_the_ends<float>(expect_float_reads_back);
}

// What C has no literal of.
void expect_no_literal(double value, bool is_double) {
  try {
    TEST_FAIL_MESSAGE(literal(value, is_double).c_str());
  } catch (const std::range_error&) {
  }
}

void test_what_is_not_finite_has_no_literal() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()})
    for (const bool is_double : {false, true}) expect_no_literal(value, is_double);
  for (const double value : {1e39, -1e39, std::numeric_limits<double>::max()}) expect_no_literal(value, false);
}

void test_literal_is_the_shortest() {
  TEST_ASSERT_EQUAL_STRING("0.01f", literal(0.01, false).c_str());
  TEST_ASSERT_EQUAL_STRING("0.01", literal(0.01, true).c_str());
  TEST_ASSERT_EQUAL_STRING("-3.0f", literal(-3, false).c_str());
  TEST_ASSERT_EQUAL_STRING("1e-06f", literal(1e-6, false).c_str());
  TEST_ASSERT_EQUAL_STRING("0.5", literal(0.5, true).c_str());
}

// Statements as they are printed: words, numbers with exponents, calls, sums and differences, UTF-8 in names.
std::string random_line(Random& random) {
  const char* const operands[] = {
      "x_0", "innovation_position", "1e-06f", "-0.5f", "self->P[12]", "fmaf(-a, b, c)", "(a - b)", "2.5e+10", "x̂₀",
      "y"};
  const char* const joints[] = {" + ", " - ", " * ", " / ", ", ", " < ", " == ", " ? ", " : "};
  std::string line(static_cast<std::size_t>(random.below(9)), ' ');
  line += "const float result = ";
  for (int i = random.below(40); i-- > 0;) line += std::string(operands[random.below(10)]) + joints[random.below(9)];
  return line + "z;";
}

int columns_of(const std::string& text) {
  int count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void test_wrap_turns_spaces_into_line_ends_and_changes_nothing_else() {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const std::string line = random_line(random);
    const int indent = random.below(12);
    const std::string wrapped = wrap(line, indent, random.between(40, 100));
    std::string joined;
    for (const std::string& part : lines_of(wrapped)) {
      const std::string margin(static_cast<std::size_t>(joined.empty() ? 0 : indent), ' ');
      TEST_ASSERT_EQUAL_STRING(margin.c_str(), part.substr(0, margin.size()).c_str());
      TEST_ASSERT_TRUE(joined.empty() || part[margin.size()] != ' ');
      joined += (joined.empty() ? "" : " ") + part.substr(margin.size());
    }
    TEST_ASSERT_EQUAL_STRING(line.c_str(), joined.c_str());
  }
}

// After a comma or the sign of an assignment, or before an operator.
bool may_break(const std::string& before, const std::string& after) {
  const std::string start = after.substr(0, 2);
  return before.back() == ',' || before.find("result =") == before.size() - 8 || start == "+ " || start == "- " ||
         start == "? " || start == ": " || start == "* " || start == "/ " || start == "< " || start == "&&" ||
         start == "||";
}

void test_wrap_breaks_before_an_operator_or_after_a_comma_only() {
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    const std::vector<std::string> lines = lines_of(wrap(random_line(random), 8, random.between(40, 100)));
    for (std::size_t k = 1; k < lines.size(); ++k)
      TEST_ASSERT_TRUE_MESSAGE(may_break(lines[k - 1], lines[k].substr(8)), lines[k].c_str());
  }
}

void expect_wrapped(const char* expected, const std::string& line) {
  TEST_ASSERT_EQUAL_STRING(expected, wrap(line, 4, 24).c_str());
}

// Before a choice, else between conditions, else in a sum, else between arguments, else at a comparison or a product,
// else behind the =.
void test_wrap_breaks_where_a_reader_would() {
  expect_wrapped("first = aaaaaaa + b\n    ? ccccc : ddd", "first = aaaaaaa + b ? ccccc : ddd");
  expect_wrapped("first = aa ? bb\n    : cc ? dd : eeeeeeee", "first = aa ? bb : cc ? dd : eeeeeeee");
  expect_wrapped("first = aaaaaa * bbb\n    + ccccccc * ddd", "first = aaaaaa * bbb + ccccccc * ddd");
  expect_wrapped("first = aa < bb\n    && cc < dddddd", "first = aa < bb && cc < dddddd");
  expect_wrapped("first = aa - b < c\n    && dddd < ee - fff", "first = aa - b < c && dddd < ee - fff");
  expect_wrapped("first = aaaaaaaaa\n    * bbbbbbbbbb", "first = aaaaaaaaa * bbbbbbbbbb");
  expect_wrapped("first =\n    aaaaaaaaaaaaaaaaaaaa", "first = aaaaaaaaaaaaaaaaaaaa");
}

void test_a_long_equation_is_broken_between_words() {
  Graph graph({});
  const int x = graph.input("x[0]", "x");
  std::string equation = "α ← α + f g";
  while (equation.size() < 400) equation += ",  U ← U − λ bᵀ";
  graph.section(equation, "");
  const int doubled = graph.make(Op::add, x, x);
  graph.name(doubled, "doubled");
  int comments = 0;
  for (const std::string& line : lines_of(Printer(graph, {doubled}).statements({{"x[0]", doubled}}))) {
    TEST_ASSERT_LESS_OR_EQUAL_INT_MESSAGE(120, columns_of(line), line.c_str());
    comments += line.rfind("     * ", 0) == 0 || line.rfind("    /* ", 0) == 0;
  }
  TEST_ASSERT_GREATER_THAN_INT(2, comments);
}

void test_a_negative_number_is_subtracted() {
  Graph graph({});
  const int x = graph.input("x[0]", "x");
  const int sum = graph.make(Op::add, graph.make(Op::multiply, x, x), graph.constant(-0.5));
  TEST_ASSERT_EQUAL_STRING("(x * x) - 0.5f", Printer(graph, {sum}).expression(sum).c_str());
}

void test_wrap_keeps_every_line_within_the_width_where_it_may_break() {
  constexpr int width = 100, longest = 40;  // columns; of an operand and what joins it
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    std::string line = "    const float result = z";
    for (int k = random.below(40); k-- > 0;)
      line +=
          (random.one_in(2) ? " + " : " - ") + std::string(static_cast<std::size_t>(random.between(1, longest)), 'x');
    const std::vector<std::string> lines = lines_of(wrap(line, 8, width));
    for (std::size_t k = 0; k < lines.size(); ++k) {
      TEST_ASSERT_LESS_OR_EQUAL_INT_MESSAGE(width, columns_of(lines[k]), lines[k].c_str());
      if (k + 1 < lines.size()) TEST_ASSERT_GREATER_THAN_INT(width - longest - 4, columns_of(lines[k]));
    }
  }
}

// A first part without a place to break is no reason to leave the rest unbroken.
void test_wrap_goes_on_after_a_part_that_is_too_long() {
  const std::string word(120, 'x');
  const std::string wrapped = wrap("    " + word + " + " + word + " + y", 8);
  for (const std::string& line : lines_of(wrapped))
    TEST_ASSERT_LESS_THAN_INT_MESSAGE(140, columns_of(line), line.c_str());
}

struct Printed {
  Graph graph;
  std::vector<int> results;
  std::string text;
};

// A random program, half of its operations named, a few of its numbers stored.
Printed print_random(std::uint64_t seed) {
  Random random(seed);
  Printed printed{Graph({}), {}, ""};
  const Program program = random_program(random, {}, 5, 60);
  const std::vector<int> nodes = record(program, printed.graph);
  std::vector<Store> stores;
  for (std::size_t at = 0; at < program.size(); ++at) {
    if (random.one_in(2)) printed.graph.name(nodes[at], "named");
    if (kind(program, static_cast<int>(at)) != Kind::number || !random.one_in(8)) continue;
    stores.push_back({"out[" + std::to_string(stores.size()) + "]", nodes[at]});
    printed.results.push_back(nodes[at]);
  }
  printed.text = Printer(printed.graph, printed.results).statements(stores);
  return printed;
}

std::map<std::string, int> words_of(const std::string& text) {
  std::map<std::string, int> count;
  const std::regex word("[A-Za-z_][A-Za-z_0-9]*");
  for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at) ++count[at->str()];
  return count;
}

void test_what_nobody_needs_is_not_printed() {
  int declared = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Printed printed = print_random(seed);
    const std::map<std::string, int> words = words_of(printed.text);
    const std::regex declaration("const [a-z_]+ ([A-Za-z_0-9]+) =");
    for (std::sregex_iterator at(printed.text.begin(), printed.text.end(), declaration), end; at != end; ++at) {
      ++declared;
      TEST_ASSERT_GREATER_THAN_INT_MESSAGE(1, words.at((*at)[1].str()), printed.text.c_str());
    }
  }
  TEST_ASSERT_GREATER_THAN(1000, declared);
}

void test_what_is_needed_is_needed_by_a_result() {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Printed printed = print_random(seed);
    std::vector<bool> wanted(printed.graph.nodes().size(), false);
    for (const int result : printed.results) wanted[static_cast<std::size_t>(result)] = true;
    for (std::size_t at = wanted.size(); at-- > 0;) {
      const Node& node = printed.graph.nodes()[at];
      for (const int operand : {node.a, node.b, node.c})
        if (wanted[at] && operand >= 0) wanted[static_cast<std::size_t>(operand)] = true;
    }
    const Printer printer(printed.graph, printed.results);
    for (std::size_t at = 0; at < wanted.size(); ++at)
      TEST_ASSERT_EQUAL_INT(wanted[at], printer.needs(static_cast<int>(at)));
  }
}

void test_every_result_is_stored_exactly_once() {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Printed printed = print_random(seed);
    for (std::size_t i = 0; i < printed.results.size(); ++i) {
      const std::string target = "    out[" + std::to_string(i) + "] = ";
      const std::size_t at = printed.text.find(target);
      TEST_ASSERT_TRUE_MESSAGE(at != std::string::npos, printed.text.c_str());
      TEST_ASSERT_TRUE_MESSAGE(printed.text.find(target, at + 1) == std::string::npos, printed.text.c_str());
    }
  }
}

// Inputs may lie where results are stored: "self->x[0]".
void test_all_inputs_are_read_before_anything_is_stored() {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::string text = print_random(seed).text;
    const std::size_t first_store = text.find("    out[");
    TEST_ASSERT_TRUE(first_store == std::string::npos || text.find(" = in[", first_store) == std::string::npos);
  }
}

void test_blocks_stand_under_their_equations() {
  Graph graph({});
  const int x = graph.input("x[0]", "x_0");
  graph.section("first", "");
  const int doubled = graph.make(Op::add, x, x);
  graph.name(doubled, "doubled");
  graph.section("second", "_pos");
  const int squared = graph.make(Op::multiply, doubled, doubled);
  graph.name(squared, "squared");
  TEST_ASSERT_EQUAL_STRING(
      "    const float x_0 = x[0];\n"
      "\n    /* first */\n"
      "    const float doubled = x_0 + x_0;\n"
      "\n    /* second */\n"
      "    const float squared_pos = doubled * doubled;\n"
      "    x[0] = squared_pos;\n",
      Printer(graph, {squared}).statements({{"x[0]", squared}}).c_str());
}

void test_operations_are_counted_by_kind_and_only_where_needed() {
  Graph graph({});
  const int x = graph.input("x", "x"), y = graph.input("y", "y");
  const int product = graph.make(Op::multiply, x, y);
  const int sum = graph.make(Op::multiply_add, product, y, graph.constant(2));
  const int quotient = graph.make(Op::divide, sum, x);
  const int chosen = graph.make(Op::select, graph.make(Op::less, x, y), quotient, x);
  graph.make(Op::add, x, graph.constant(7));  // nobody needs it
  const Operations count = Printer(graph, {chosen}).operations();
  TEST_ASSERT_EQUAL_INT(0, count.additions);
  TEST_ASSERT_EQUAL_INT(1, count.multiplications);
  TEST_ASSERT_EQUAL_INT(1, count.multiply_adds);
  TEST_ASSERT_EQUAL_INT(1, count.divisions);
  TEST_ASSERT_EQUAL_INT(2, count.selections);
  TEST_ASSERT_EQUAL_INT(1, count.constants);
  TEST_ASSERT_EQUAL_INT(3, count.total());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_literal_of_any_finite_bits_reads_back);
  RUN_TEST(test_literal_of_subnormal_and_of_honest_numbers_reads_back);
  RUN_TEST(test_literal_at_the_ends_of_the_range_reads_back);
  RUN_TEST(test_what_is_not_finite_has_no_literal);
  RUN_TEST(test_literal_is_the_shortest);
  RUN_TEST(test_wrap_turns_spaces_into_line_ends_and_changes_nothing_else);
  RUN_TEST(test_wrap_breaks_before_an_operator_or_after_a_comma_only);
  RUN_TEST(test_wrap_breaks_where_a_reader_would);
  RUN_TEST(test_a_long_equation_is_broken_between_words);
  RUN_TEST(test_a_negative_number_is_subtracted);
  RUN_TEST(test_wrap_keeps_every_line_within_the_width_where_it_may_break);
  RUN_TEST(test_wrap_goes_on_after_a_part_that_is_too_long);
  RUN_TEST(test_what_nobody_needs_is_not_printed);
  RUN_TEST(test_what_is_needed_is_needed_by_a_result);
  RUN_TEST(test_every_result_is_stored_exactly_once);
  RUN_TEST(test_all_inputs_are_read_before_anything_is_stored);
  RUN_TEST(test_blocks_stand_under_their_equations);
  RUN_TEST(test_operations_are_counted_by_kind_and_only_where_needed);
  return UNITY_END();
}
