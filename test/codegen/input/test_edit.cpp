// SPDX-License-Identifier: MIT
// Numbers of a design file are set, and nothing else of it changes. The files that it is tried on, every number of each
// of them, are its arguments.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <unity.h>

#include "../random.hpp"
#include "input/design_file.hpp"
#include "input/edit.hpp"

using namespace lqg::input;

namespace {

std::vector<std::string> design_files;

std::string edited(const std::string& text, const std::vector<Change>& changes) {
  const auto result = set_numbers(text, changes);
  if (const auto* failure = std::get_if<EditFailure>(&result))
    TEST_FAIL_MESSAGE((failure->key + ": " + failure->message).c_str());
  return std::get<std::string>(result);
}

EditFailure refusal(const std::string& text, const std::vector<Change>& changes) {
  const auto result = set_numbers(text, changes);
  if (std::holds_alternative<std::string>(result)) TEST_FAIL_MESSAGE("not refused");
  return std::get<EditFailure>(result);
}

void expect(const char* after, const char* before, const std::string& key, double value) {
  TEST_ASSERT_EQUAL_STRING(after, edited(before, {{key, value}}).c_str());
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

const PlacedNumber& at(const std::vector<PlacedNumber>& numbers, const std::string& key) {
  for (const PlacedNumber& number : numbers)
    if (number.key == key) return number;
  TEST_FAIL_MESSAGE(key.c_str());
  return numbers.front();
}

void test_keys_of_all_kinds_of_places_are_those_of_findings() {
  const std::string text =
      "t = 1\n[a]\nx.y = 2\nb = { c = [3, -4], d = { e = 5 } }\nm = [[6, 7],\n  [8]]\n[[s]]\nf = 9\n[[s]]\nf = 10\n";
  const char* keys[] = {"t",         "a.x.y",     "a.b.c[0]",  "a.b.c[1]", "a.b.d.e",
                        "a.m[0][0]", "a.m[0][1]", "a.m[1][0]", "s[0].f",   "s[1].f"};
  const std::vector<PlacedNumber> numbers = numbers_of(text);
  TEST_ASSERT_EQUAL_UINT(10, numbers.size());
  for (std::size_t i = 0; i < 10; ++i) {
    TEST_ASSERT_EQUAL_STRING(keys[i], numbers[i].key.c_str());
    TEST_ASSERT_EQUAL_STRING(std::to_string(static_cast<int>(numbers[i].value)).c_str(),
                             text.substr(numbers[i].begin, numbers[i].length).c_str());
  }
}

void test_comments_layout_and_line_ends_stay() {
  expect("# é → 1\r\n[a]   # 2\r\n\tQ  = [ 1,  # first\r\n  7 , # ] second 2\r\n]# 2\r\n",
         "# é → 1\r\n[a]   # 2\r\n\tQ  = [ 1,  # first\r\n  2 , # ] second 2\r\n]# 2\r\n", "a.Q[1]", 7);
  expect("n = \"λ = 2 # }\"\nb = { s = \"→\", u = [12, 3] }", "n = \"λ = 2 # }\"\nb = { s = \"→\", u = [12, 2] }",
         "b.u[1]", 3);
  expect("\xEF\xBB\xBFx = 3", "\xEF\xBB\xBFx = 2", "x", 3);
  expect("x=3#2", "x=2#2", "x", 3);
}

void test_style_of_the_number_before_is_kept() {
  expect("x = 3", "x = 2", "x", 3);
  expect("x = 3.0", "x = 2.0", "x", 3);
  expect("x = 0.1", "x = 2", "x", 0.1);
  expect("x = 3e5", "x = 2e6", "x", 3e5);
  expect("x = 1.25e-7", "x = 1E+2", "x", 1.25e-7);
  expect("x = 1e0", "x = 1e-3", "x", 1);
  expect("x = 123456", "x = 1_000_000", "x", 123456);
  expect("x = 17", "x = 0xFE5", "x", 17);
  expect("x = 17", "x = 0o17", "x", 17);
  expect("x = -2.5", "x = +1.0", "x", -2.5);
  expect("x = 0.0", "x = 1.5", "x", 0);
  expect("x = -0.0", "x = 1", "x", -0.0);
}

void test_no_long_row_of_zeros_is_written() {
  expect("x = 2e-9", "x = 1", "x", 2e-9);
  expect("x = 1e300", "x = 1.0", "x", 1e300);
  expect("x = 0.0001", "x = 1", "x", 1e-4);
  expect("x = 9999999", "x = 1", "x", 9999999);
}

void test_infinite_numbers_come_and_go() {
  const double infinity = std::numeric_limits<double>::infinity();
  expect("x = [-inf, 1]", "x = [-12, 1]", "x[0]", -infinity);
  expect("x = 300", "x = inf", "x", 300);
  expect("x = -3", "x = -inf", "x", -3);
}

void test_the_same_value_leaves_its_spelling() {
  expect("x = 1_000.00", "x = 1_000.00", "x", 1000);
  expect("x = 0xFF", "x = 0xFF", "x", 255);
}

void test_many_changes_at_once_do_not_move_each_other() {
  TEST_ASSERT_EQUAL_STRING("Q = [100.5, 2, 1e-9]\nR = 3\n",
                           edited("Q = [1, 2, 1e5]\nR = 1\n", {{"R", 3}, {"Q[2]", 1e-9}, {"Q[0]", 100.5}}).c_str());
}

void test_what_is_no_number_of_the_file_is_refused_with_its_key() {
  for (const char* key : {"y", "x[3]", "x", "name", "", "x[0][0]", "x[-1]", "x[00]"}) {
    const EditFailure failure = refusal("name = \"2\"\nx = [1, 2]\n", {{key, 3}});
    TEST_ASSERT_EQUAL_STRING(key, failure.key.c_str());
    TEST_ASSERT_TRUE(failure.message.find("expected") != std::string::npos);
  }
  refusal("x = 1", {{"x", std::nan("")}});
  refusal("x = 1", {{"x", 2}, {"x", 3}});
  refusal("x = [ = 1", {{"x", 2}});
  refusal("x = 1979-05-27\n", {{"x", 2}});
}

void test_a_number_that_is_two_keys_apart_in_quotes_is_left_out() {
  TEST_ASSERT_EQUAL_UINT(1, numbers_of("\"a.b\" = 1\na.c = 2\n").size());
}

// Of any finite bit pattern: it is read back exactly, in every style.
void test_any_double_reads_back_exactly() {
  lqg_test::Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const double value = random.pattern<double>();
    if (std::isnan(value)) continue;
    for (const char* text : {"x = 1", "x = 1.0", "x = 1e3", "x = [inf]"}) {
      const std::string key = text[4] == '[' ? "x[0]" : "x";
      TEST_ASSERT_TRUE(same_bits(value, at(numbers_of(edited(text, {{key, value}})), key).value));
    }
  }
}

// Every number of `text`: the new text is the old one with another word at that place, which reads as the value.
void check_every_number(const std::string& text, lqg_test::Random& random) {
  for (const PlacedNumber& number : numbers_of(text)) {
    const double value = number.value * (1 + 0.5 * random.uniform()) + (number.value == 0 ? random.uniform() : 0);
    const std::string after = edited(text, {{number.key, value}});
    TEST_ASSERT_TRUE_MESSAGE(same_bits(value, at(numbers_of(after), number.key).value), number.key.c_str());
    const std::size_t behind = text.size() - number.begin - number.length;
    TEST_ASSERT_EQUAL_STRING(text.substr(0, number.begin).c_str(), after.substr(0, number.begin).c_str());
    TEST_ASSERT_TRUE(after.size() >= number.begin + behind);
    TEST_ASSERT_EQUAL_STRING(text.substr(text.size() - behind).c_str(), after.substr(after.size() - behind).c_str());
  }
}

void test_every_number_of_every_design_is_set_and_all_else_stays() {
  lqg_test::Random random(2);
  TEST_ASSERT_TRUE(design_files.size() > 5);
  for (const std::string& path : design_files) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    TEST_ASSERT_TRUE_MESSAGE(numbers_of(text.str()).size() > 10, path.c_str());
    check_every_number(text.str(), random);
  }
}

// The reader of designs and the editor call a number by the same key.
void test_each_number_of_a_design_has_the_place_that_findings_name() {
  for (const std::string& path : design_files) {
    const DesignFile file = read_design_file(path);
    for (const PlacedNumber& number : numbers_of(file.text)) {
      const Location where = locate(file, number.key);
      const std::string before = file.text.substr(0, number.begin);
      TEST_ASSERT_TRUE_MESSAGE(where.line <= 1 + std::count(before.begin(), before.end(), '\n'), number.key.c_str());
      TEST_ASSERT_TRUE_MESSAGE(where.line > 1, number.key.c_str());
    }
  }
}

void test_a_number_that_is_not_there_is_added_where_its_table_begins() {
  expect("[plant]  # the motor\ndelay = 0.001\nA = [[1]]\n", "[plant]  # the motor\nA = [[1]]\n", "plant.delay", 1e-3);
  expect("[plant]\r\ndelay = 2\r\nA = 1\r\n", "[plant]\r\nA = 1\r\n", "plant.delay", 2);
  expect("[lqr]\nbryson = { rho = 0.5, states = [1] }\n", "[lqr]\nbryson = { states = [1] }\n", "lqr.bryson.rho", 0.5);
  const std::string both = edited("x = 1\n[a]\ny = 2\n[b]\nz = 3\n", {{"a.n", 4}, {"x", 5}, {"b.m", 6}, {"b.z", 7}});
  TEST_ASSERT_EQUAL_STRING("x = 5\n[a]\nn = 4\ny = 2\n[b]\nm = 6\nz = 7\n", both.c_str());
}

void test_a_number_is_not_added_where_its_table_has_no_place_of_its_own() {
  for (const char* text : {"plant.A = 1\n", "[[plant]]\nA = 1\n", "x = 1\n", "[plant.more]\nA = 1\n", "[plant]"})
    TEST_ASSERT_EQUAL_STRING("plant.delay", refusal(text, {{"plant.delay", 1}}).key.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  design_files.assign(argv + 1, argv + argc);
  UNITY_BEGIN();
  RUN_TEST(test_keys_of_all_kinds_of_places_are_those_of_findings);
  RUN_TEST(test_comments_layout_and_line_ends_stay);
  RUN_TEST(test_style_of_the_number_before_is_kept);
  RUN_TEST(test_no_long_row_of_zeros_is_written);
  RUN_TEST(test_infinite_numbers_come_and_go);
  RUN_TEST(test_the_same_value_leaves_its_spelling);
  RUN_TEST(test_many_changes_at_once_do_not_move_each_other);
  RUN_TEST(test_what_is_no_number_of_the_file_is_refused_with_its_key);
  RUN_TEST(test_a_number_that_is_two_keys_apart_in_quotes_is_left_out);
  RUN_TEST(test_a_number_that_is_not_there_is_added_where_its_table_begins);
  RUN_TEST(test_a_number_is_not_added_where_its_table_has_no_place_of_its_own);
  RUN_TEST(test_any_double_reads_back_exactly);
  RUN_TEST(test_every_number_of_every_design_is_set_and_all_else_stays);
  RUN_TEST(test_each_number_of_a_design_has_the_place_that_findings_name);
  return UNITY_END();
}
