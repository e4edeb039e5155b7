// SPDX-License-Identifier: MIT
// The tree of a TOML text: kinds, places, and the ways in which toml++ fails.
#include <cstdlib>
#include <string>

#include <unity.h>

#include "input/document.hpp"

using namespace lqg::input;

namespace {

Node tree(const std::string& text) {
  auto parsed = parse_toml(text);
  if (const Fault* fault = std::get_if<Fault>(&parsed)) TEST_FAIL_MESSAGE(fault->message.c_str());
  return std::get<Node>(parsed);
}

Fault failure(const std::string& text) {
  auto parsed = parse_toml(text);
  if (std::get_if<Node>(&parsed)) TEST_FAIL_MESSAGE(("taken for TOML: " + text).c_str());
  return std::get<Fault>(parsed);
}

void expect_place(int line, int column, const Location& where) {
  TEST_ASSERT_EQUAL_INT(line, where.line);
  TEST_ASSERT_EQUAL_INT(column, where.column);
}

void test_keys_come_in_the_order_of_the_file_with_their_places() {
  const Node root = tree("z = 1\na = [1.5, \"x\"]\n[m]\nb = true\n");
  TEST_ASSERT_EQUAL_UINT(3, root.keys.size());
  TEST_ASSERT_EQUAL_STRING("z", root.keys[0].name.c_str());
  TEST_ASSERT_EQUAL_STRING("a", root.keys[1].name.c_str());
  TEST_ASSERT_EQUAL_STRING("m", root.keys[2].name.c_str());
  expect_place(2, 1, root.keys[1].where);
  expect_place(2, 5, root.items[1].where);
  expect_place(2, 11, root.items[1].items[1].where);
  expect_place(3, 1, root.items[2].where);
  expect_place(4, 5, root.items[2].items[0].where);
}

void test_every_kind_of_value_is_told_apart() {
  const Node root = tree("a = \"t\"\nb = 1\nc = 1.5\nd = true\ne = 1979-05-27\nf = [1]\ng = {}\nh = []\n");
  const char* kinds[] = {"a string",       "a number", "a number", "a boolean",
                         "a date or time", "an array", "a table",  "an empty array"};
  for (std::size_t i = 0; i < 8; ++i) TEST_ASSERT_EQUAL_STRING(kinds[i], describe(root.items[i]).c_str());
}

void test_numbers_are_those_that_the_compiler_reads() {
  for (const char* number :
       {"0.1", "1e-310", "4.9406564584124654e-324", "1.7976931348623157e308", "0.30000000000000004", "9007199254740993",
        "123456.789e-7", "2.2250738585072011e-308", "-1e23", "-0.0"}) {
    const double read = tree("x = " + std::string(number)).items[0].number;
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(0, read == std::strtod(number, nullptr) ? 0 : 1, number);
  }
}

// toml++ 3.3.0 has an assertion there; the place is that of the culprit.
void test_assertion_of_the_parser_is_a_message_with_a_place() {
  const Fault first = failure("[ = 1");
  expect_place(1, 3, first.where);
  TEST_ASSERT_EQUAL_STRING_LEN("not TOML: ", first.message.c_str(), 10);
  expect_place(3, 4, failure("a = 1\n# µ\n[[ = 1\nb = [\n").where);
}

void test_syntax_errors_have_their_places() {
  expect_place(2, 5, failure("a = 1\nb = \n").where);
  TEST_ASSERT_EQUAL_STRING("not TOML: key-value pair: cannot redefine existing integer 'a'",
                           failure("a = 1\na = 2\n").message.c_str());
  TEST_ASSERT_EQUAL_STRING("not TOML: floating-point: '1e400' is not representable in 64 bits",
                           failure("a = 1e400\n").message.c_str());
  TEST_ASSERT_EQUAL_STRING("not TOML: floating-point: '1e-400' is not representable in 64 bits",
                           failure("a = 1e-400\n").message.c_str());
}

void test_a_hundred_thousand_brackets_end_in_a_message() {
  expect_place(1, 37, failure("a = " + std::string(100000, '[')).where);
  std::string tables = "a = ";
  for (int i = 0; i < 10000; ++i) tables += "{a=";
  TEST_ASSERT_TRUE(failure(tables).message.find("nested") != std::string::npos);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_keys_come_in_the_order_of_the_file_with_their_places);
  RUN_TEST(test_every_kind_of_value_is_told_apart);
  RUN_TEST(test_numbers_are_those_that_the_compiler_reads);
  RUN_TEST(test_assertion_of_the_parser_is_a_message_with_a_place);
  RUN_TEST(test_syntax_errors_have_their_places);
  RUN_TEST(test_a_hundred_thousand_brackets_end_in_a_message);
  return UNITY_END();
}
