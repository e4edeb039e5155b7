// SPDX-License-Identifier: MIT
// What differs between files, and what does not.
#include <string>

#include <unity.h>

#include "view/differences.hpp"

using namespace lqg::view;

namespace {

void expect(const std::vector<Difference>& found, std::size_t line, const char* key, const char* left,
            const char* right) {
  TEST_ASSERT_TRUE(line < found.size());
  TEST_ASSERT_EQUAL_STRING(key, found[line].key.c_str());
  TEST_ASSERT_EQUAL_STRING(left, found[line].values[0].c_str());
  TEST_ASSERT_EQUAL_STRING(right, found[line].values[1].c_str());
}

void test_comments_layout_order_and_spelling_are_no_difference() {
  TEST_ASSERT_EQUAL_UINT(
      0,
      differences({"a = 1000 # x\n[t]\nb = [1, 2]\nc = \"x\"\n", "a = 1e3\n[t]\nc = 'x'\nb = [1.0,\n 0x2]\n"}).size());
}

void test_values_stand_as_they_are_written() {
  const auto found = differences(
      {"a = \"x\"\nb = 1e-5\nd = true\n[t]\nc = [1, 2.50]\n", "a = \"y\"\nb = 0.1\nd = false\n[t]\nc = [1, 3]\n"});
  TEST_ASSERT_EQUAL_UINT(4, found.size());
  expect(found, 0, "a", "\"x\"", "\"y\"");
  expect(found, 1, "b", "1e-5", "0.1");
  expect(found, 2, "d", "true", "false");
  expect(found, 3, "t.c[1]", "2.50", "3");
}

void test_a_key_that_one_file_lacks_is_a_difference() {
  const auto found = differences({"a = 1\n", "b = 2\na = 1\n[[s]]\nf = 3\n"});
  TEST_ASSERT_EQUAL_UINT(2, found.size());
  expect(found, 0, "b", "–", "2");
  expect(found, 1, "s[0].f", "–", "3");
}

void test_parameters_differ_by_their_values_and_expressions() {
  const std::string head = "[parameters]\nR = { value = ",
                    tail = ", unit = \"ohm\" }\nL = \"R/2\"\n[plant]\nA = [[\"R\"]]\n";
  const auto found = differences({head + "2" + tail, head + "2.5" + tail, head + "\"2*L\"" + tail});
  TEST_ASSERT_EQUAL_UINT(1, found.size());
  expect(found, 0, "parameters.R.value", "2", "2.5");
  TEST_ASSERT_EQUAL_STRING("\"2*L\"", found[0].values[2].c_str());
}

void test_many_differences_of_a_matrix_are_one_line() {
  const auto found = differences({"A = [[1, 2, 3, 4], [5, 6, 7, 8], [1, 2, 3, 4], [5, 6, 7, 8]]\n",
                                  "A = [[1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 8]]\n"});
  TEST_ASSERT_EQUAL_UINT(1, found.size());
  expect(found, 0, "A", "its numbers", "14 differ");
}

void test_the_third_file_alone_can_differ() {
  const auto found = differences({"a = 1\n", "a = 1\n", "a = 2\n"});
  TEST_ASSERT_EQUAL_UINT(1, found.size());
  TEST_ASSERT_EQUAL_STRING("1", found[0].values[1].c_str());
  TEST_ASSERT_EQUAL_STRING("2", found[0].values[2].c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_comments_layout_order_and_spelling_are_no_difference);
  RUN_TEST(test_values_stand_as_they_are_written);
  RUN_TEST(test_a_key_that_one_file_lacks_is_a_difference);
  RUN_TEST(test_parameters_differ_by_their_values_and_expressions);
  RUN_TEST(test_many_differences_of_a_matrix_are_one_line);
  RUN_TEST(test_the_third_file_alone_can_differ);
  return UNITY_END();
}
