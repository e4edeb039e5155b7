// SPDX-License-Identifier: MIT
// What may reach the TOML parser, and what a message may show.
#include <string>

#include <unity.h>

#include "input/text.hpp"

using namespace lqg::input;

namespace {

void expect_clean(const std::string& text) {
  const auto faults = check_text(text);
  TEST_ASSERT_TRUE_MESSAGE(faults.empty(), faults.empty() ? "" : faults[0].message.c_str());
}

void expect_fault(const std::string& text, int line, int column, const char* message) {
  const auto faults = check_text(text);
  TEST_ASSERT_EQUAL_UINT_MESSAGE(1, faults.size(), text.c_str());
  TEST_ASSERT_EQUAL_INT_MESSAGE(line, faults[0].where.line, text.c_str());
  TEST_ASSERT_EQUAL_INT_MESSAGE(column, faults[0].where.column, text.c_str());
  TEST_ASSERT_EQUAL_STRING(message, faults[0].message.c_str());
}

void expect_not_ascii(const std::string& text, int line, int column) {
  const auto faults = check_text(text);
  TEST_ASSERT_EQUAL_UINT_MESSAGE(1, faults.size(), text.c_str());
  TEST_ASSERT_EQUAL_INT_MESSAGE(line, faults[0].where.line, text.c_str());
  TEST_ASSERT_EQUAL_INT_MESSAGE(column, faults[0].where.column, text.c_str());
  TEST_ASSERT_EQUAL_STRING_LEN("expected ASCII", faults[0].message.c_str(), 14);
}

void test_letters_of_any_language_stand_in_comments_and_strings() {
  expect_clean("# é\na = \"µ\" # °\nb = '±' \r\n");
  expect_clean("a=\"é\"\nb = [\"é\",'é']\nc = {d=\"é\"}\n\"é\" = 1\na.\"é\" = 1\n");
  expect_clean("\xEF\xBB\xBFname = \"é\"\n");
}

void test_letters_beyond_ascii_are_refused_everywhere_else() {
  expect_not_ascii("a = −1\n", 1, 5);
  expect_not_ascii("é = 1\n", 1, 1);
  expect_not_ascii("# °\na = \"é\" é\n", 2, 9);
  expect_not_ascii("a = \"x\\\"\" é\n", 1, 11);
  expect_not_ascii("a = 'x\\' é\n", 1, 10);
  expect_not_ascii("a = \"open\né", 2, 1);
}

// The parser skips white space after a backslash at a line's end, and takes any character for a candidate.
void test_letters_beyond_ascii_are_refused_in_strings_of_several_lines() {
  expect_not_ascii("a = \"\"\"x\né\"\"\"\n", 2, 1);
  expect_not_ascii("a = '''é'''\n", 1, 8);
  expect_clean("a = \"\"\"x\"\"\"\nb = \"é\"\n");
  expect_clean("a = \"\"\"x\\\"\"\"\"\nb = \"é\"\n");
  expect_clean("a = \"\"\"x\"\"\"\"\"\nb = \"é\"\n");
  expect_clean("a = '''\\'''\nb = 'é'\nc = \"\"\nd = 'é'\n");
}

void test_string_inside_of_a_number_is_refused() {
  const char* message = "expected a number, found a string right after its digits";
  expect_fault("a = 1\"x\"\n", 1, 6, message);
  expect_fault("a = [1, -2'x']\n", 1, 11, message);
  expect_fault("a = 1=[\"x\"]\n", 1, 8, message);
  expect_clean("a = [1, \"x\"]\na1=\"x\"\na.b1 = \"x\"\na = {b = 1, c = \"x\"}\n");
}

void test_control_characters_are_refused_but_tab_and_line_end() {
  expect_fault(std::string("a = 1\0", 6), 1, 6, "expected text, found the control character U+0000");
  expect_fault("# \x1B[31m\n", 1, 3, "expected text, found the control character U+001B");
  expect_fault("a = \"\x7F\"", 1, 6, "expected text, found the control character U+007F");
  expect_clean("\ta = 1\r\n");
}

void test_bytes_that_are_not_utf8_are_refused_even_in_comments() {
  expect_fault("# \xE9t\n", 1, 3, "expected UTF-8, found the byte 0xE9");
  expect_fault("# \xC0\x80\n", 1, 3, "expected UTF-8, found the byte 0xC0");
  expect_fault("# \xED\xA0\x80\n", 1, 3, "expected UTF-8, found the byte 0xED");
  expect_fault("# \xF4\x90\x80\x80\n", 1, 3, "expected UTF-8, found the byte 0xF4");
  expect_fault("# \xE2\x82", 1, 3, "expected UTF-8, found the byte 0xE2");
}

void test_each_line_has_a_fault_of_its_own() {
  const auto faults = check_text("a = −1 − 2\nb = 1\nc = −1\n");
  TEST_ASSERT_EQUAL_UINT(2, faults.size());
  TEST_ASSERT_EQUAL_INT(1, faults[0].where.line);
  TEST_ASSERT_EQUAL_INT(3, faults[1].where.line);
}

void test_key_of_many_parts_is_refused_and_a_row_of_many_numbers_is_not() {
  expect_fault("a.a.a.a.a.a.a.a.a = 1\n", 1, 16, "expected a key of at most 8 parts");
  expect_fault("[a . a . a . a.a.a.a.a.a]\n", 1, 23, "expected a key of at most 8 parts");
  expect_clean("a.a.a.a.a.a.a.a = 1\n");
  expect_clean("a = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]\n");
  expect_clean("a = \"1.2.3.4.5.6.7.8.9.10\" # 1.2.3.4.5.6.7.8.9\n");
}

void test_decode_takes_the_shortest_form_only() {
  TEST_ASSERT_EQUAL_UINT(0x24, decode("$", 0).code);
  TEST_ASSERT_EQUAL_UINT(0x20AC, decode("x€", 1).code);
  TEST_ASSERT_EQUAL_UINT(0x1F600, decode("\xF0\x9F\x98\x80", 0).code);
  TEST_ASSERT_EQUAL_UINT(4, decode("\xF0\x9F\x98\x80", 0).length);
  TEST_ASSERT_EQUAL_UINT(0, decode("\xE0\x80\x80", 0).length);
  TEST_ASSERT_EQUAL_UINT(0, decode("\xF0\x80\x80\x80", 0).length);
  TEST_ASSERT_EQUAL_UINT(0, decode("\x80", 0).length);
  TEST_ASSERT_EQUAL_UINT(0, decode("\xC3", 0).length);
}

void test_printable_is_one_line_whatever_comes_in() {
  TEST_ASSERT_EQUAL_STRING("a\\u000Ab\\u001Bµ\\xFF", printable("a\nb\x1Bµ\xFF").c_str());
  TEST_ASSERT_EQUAL_STRING("\\u202Ex\\u2028", printable("\u202Ex\u2028").c_str());
}

void test_quoted_is_cut_between_characters() {
  std::string greek, expected;
  for (int i = 0; i < 60; ++i) expected += "µ";
  greek = expected + "µ";
  TEST_ASSERT_EQUAL_STRING(("\"" + expected + "\"").c_str(), in_quotes(expected).c_str());
  TEST_ASSERT_EQUAL_STRING(("\"" + expected + "…\"").c_str(), in_quotes(greek).c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_letters_of_any_language_stand_in_comments_and_strings);
  RUN_TEST(test_letters_beyond_ascii_are_refused_everywhere_else);
  RUN_TEST(test_letters_beyond_ascii_are_refused_in_strings_of_several_lines);
  RUN_TEST(test_string_inside_of_a_number_is_refused);
  RUN_TEST(test_control_characters_are_refused_but_tab_and_line_end);
  RUN_TEST(test_bytes_that_are_not_utf8_are_refused_even_in_comments);
  RUN_TEST(test_each_line_has_a_fault_of_its_own);
  RUN_TEST(test_key_of_many_parts_is_refused_and_a_row_of_many_numbers_is_not);
  RUN_TEST(test_decode_takes_the_shortest_form_only);
  RUN_TEST(test_printable_is_one_line_whatever_comes_in);
  RUN_TEST(test_quoted_is_cut_between_characters);
  return UNITY_END();
}
