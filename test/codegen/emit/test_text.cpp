// SPDX-License-Identifier: MIT
// Placeholders, names, numbers and matrices as text.
#include <cmath>
#include <stdexcept>

#include <unity.h>

#include "controller/model_of.hpp"
#include "design/numeric/digits.hpp"
#include "emit/recorded/place_names.hpp"
#include "emit/text/wording.hpp"

using namespace lqg::emit;

namespace {

void expect_filled(const char* expected, const char* text) {
  TEST_ASSERT_EQUAL_STRING(expected, fill(text, {{"name", "two_mass"}, {"x", ""}, {"twice", "{name}"}}).c_str());
}

void test_fill_replaces_what_it_knows() {
  expect_filled("two_mass_init(two_mass_t)", "{name}_init({name}_t)");
  expect_filled("[]", "[{x}]");
  expect_filled("", "");
}

void test_fill_leaves_braces_of_C_alone() {
  expect_filled("void f(void) { return; }", "void f(void) { return; }");
  expect_filled("{\n    two_mass();\n}\n", "{\n    {name}();\n}\n");
  expect_filled("{{1, 2}, two_mass}", "{{1, 2}, {name}}");
  expect_filled("{unknown} {", "{unknown} {");
}

void test_fill_does_not_look_into_what_it_put_in() { expect_filled("{name}", "{twice}"); }

const Conditions conditions = {{"has.gate", true}, {"size.nr", false}, {"order", true}};

void expect_kept(const char* expected, const char* text) {
  TEST_ASSERT_EQUAL_STRING(expected, keep_lines(text, conditions).c_str());
}

void test_lines_without_a_mark_are_kept() {
  expect_kept("", "");
  expect_kept("a;\n\n    b;  // ? not a mark\n", "a;\n\n    b;  // ? not a mark\n");
  expect_kept("no end", "no end");
}

void test_marked_lines_are_kept_without_the_mark_where_the_condition_holds() {
  expect_kept("    gate();\n", "    gate();    //? has.gate\n    r();       //? size.nr\n");
  expect_kept("    no_r();\n", "    no_gate();   //? not has.gate\n    no_r();      //? not size.nr\n");
  expect_kept("a\nb", "a\nb  //? has.gate");
  expect_kept("a\n", "a\nb  //? not order");
}

void test_a_line_that_is_a_mark_alone_is_an_empty_one_or_none() {
  expect_kept("a\n\nb\n", "a\n    //? has.gate\nb\n");
  expect_kept("a\n\nb\n", "a\n//? has.gate\nb\n");
  expect_kept("a\nb\n", "a\n    //? size.nr\nb\n");
}

void test_a_condition_that_nobody_knows_is_an_error() {
  for (const char* text : {"a  //? has.gates\n", "a  //? not has.gates\n", "a  //? \n"}) {
    bool noticed = false;
    try {
      keep_lines(text, conditions);
    } catch (const std::out_of_range&) {
      noticed = true;
    }
    TEST_ASSERT_TRUE(noticed);
  }
}

void test_upper_turns_small_letters_only() { TEST_ASSERT_EQUAL_STRING("TWO_MASS_2", upper("two_Mass_2").c_str()); }

void test_numbers_are_rounded_once_to_the_precision_of_the_target() {
  const lqg::design::Digits digits(50);
  const lqg::design::Real third = lqg::design::Real(1) / 3;
  TEST_ASSERT_EQUAL_STRING("0.33333334", number(third, false).c_str());
  TEST_ASSERT_EQUAL_STRING("0.3333333333333333", number(third, true).c_str());
  // Just above the middle of two floats, by less than a double tells: rounded by way of double it would be 1.
  const lqg::design::Real above = 1 + pow(lqg::design::Real(2), -24) + pow(lqg::design::Real(2), -60);
  TEST_ASSERT_EQUAL_STRING("1.0000001", number(above, false).c_str());
}

void test_matrices_stand_in_aligned_columns() {
  const lqg::design::Digits digits(50);
  lqg::design::RealMatrix matrix(2, 2);
  matrix << 1, -0.25, 100, 0;
  TEST_ASSERT_EQUAL_STRING(
      "  A = [   1.0  -0.25 ]\n"
      "      [ 100.0    0.0 ]\n",
      matrix_lines("A", matrix, true).c_str());
  TEST_ASSERT_EQUAL_STRING(
      "  E[w wᵀ] = [   1.0  -0.25 ]\n"
      "            [ 100.0    0.0 ]\n",
      matrix_lines("E[w wᵀ]", matrix, true).c_str());
}

void test_arrays_are_written_row_after_row() {
  const lqg::design::Digits digits(50);
  lqg::design::RealMatrix matrix(2, 2);
  matrix << 1, -0.25, 100, 0;
  TEST_ASSERT_EQUAL_STRING("    1.0f, -0.25f,\n    100.0f, 0.0f\n", array_values(matrix, false).c_str());
}

void test_numbers_for_people_have_four_digits() {
  TEST_ASSERT_EQUAL_STRING("0.1235", decimal(0.123456).c_str());
  TEST_ASSERT_EQUAL_STRING("1.235e-07", decimal(1.23456e-7).c_str());
  TEST_ASSERT_EQUAL_STRING("4", decimal(4).c_str());
}

void test_indices_of_more_than_ten_rows_cannot_be_misread() {
  TEST_ASSERT_EQUAL_STRING("", index_suffix(-1, -1, 12).c_str());
  TEST_ASSERT_EQUAL_STRING("_3", index_suffix(3, -1, 4).c_str());
  TEST_ASSERT_EQUAL_STRING("_31", index_suffix(3, 1, 4).c_str());
  TEST_ASSERT_EQUAL_STRING("_11_1", index_suffix(11, 1, 12).c_str());
  TEST_ASSERT_EQUAL_STRING("_1_11", index_suffix(1, 11, 12).c_str());
}

void test_a_limit_is_rounded_to_the_inside() {
  for (const double limit : {0.1, -0.1, 0.7, 1e-50, -1e-50, 1.0, 1e10 / 3}) {
    TEST_ASSERT_TRUE(lqg::controller::limit_of_target(limit, -1, false) <= limit);
    TEST_ASSERT_TRUE(lqg::controller::limit_of_target(limit, +1, false) >= limit);
    for (const int inward : {-1, +1}) {
      const double found = lqg::controller::limit_of_target(limit, inward, false);
      TEST_ASSERT_TRUE(found == static_cast<double>(static_cast<float>(found)));
      TEST_ASSERT_TRUE(lqg::controller::limit_of_target(limit, inward, true) == limit);
      const float next = std::nextafter(static_cast<float>(found), inward < 0 ? INFINITY : -INFINITY);
      TEST_ASSERT_TRUE(inward < 0 ? static_cast<double>(next) > limit : static_cast<double>(next) < limit);
    }
  }
  TEST_ASSERT_TRUE(std::isinf(lqg::controller::limit_of_target(INFINITY, -1, false)));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_fill_replaces_what_it_knows);
  RUN_TEST(test_fill_leaves_braces_of_C_alone);
  RUN_TEST(test_fill_does_not_look_into_what_it_put_in);
  RUN_TEST(test_lines_without_a_mark_are_kept);
  RUN_TEST(test_marked_lines_are_kept_without_the_mark_where_the_condition_holds);
  RUN_TEST(test_a_line_that_is_a_mark_alone_is_an_empty_one_or_none);
  RUN_TEST(test_a_condition_that_nobody_knows_is_an_error);
  RUN_TEST(test_upper_turns_small_letters_only);
  RUN_TEST(test_numbers_are_rounded_once_to_the_precision_of_the_target);
  RUN_TEST(test_matrices_stand_in_aligned_columns);
  RUN_TEST(test_arrays_are_written_row_after_row);
  RUN_TEST(test_numbers_for_people_have_four_digits);
  RUN_TEST(test_indices_of_more_than_ten_rows_cannot_be_misread);
  RUN_TEST(test_a_limit_is_rounded_to_the_inside);
  return UNITY_END();
}
