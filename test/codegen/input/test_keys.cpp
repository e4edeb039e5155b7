// SPDX-License-Identifier: MIT
// The table of keys, and what an unknown one may have meant.
#include <set>
#include <string>

#include <unity.h>

#include "input/keys.hpp"

using namespace lqg::input;

namespace {

void expect(const char* table, const char* name, const char* message) {
  TEST_ASSERT_EQUAL_STRING(message, suggest(table, name).message.c_str());
}

void test_every_key_stands_once_and_below_its_table() {
  std::set<std::string> seen;
  for (const KeyRule& rule : key_rules()) {
    TEST_ASSERT_TRUE_MESSAGE(seen.insert(rule.path).second, rule.path.c_str());
    const std::string parent = parent_of(rule.path);
    TEST_ASSERT_TRUE_MESSAGE(parent.empty() || seen.count(parent) == 1, rule.path.c_str());
    TEST_ASSERT_EQUAL_PTR(&rule, find_rule(rule.path));
  }
  TEST_ASSERT_NULL(find_rule("plant.Q"));
}

void test_misspelt_key_names_the_nearest_of_its_table() {
  expect("plant", "sampletime", "unknown key, did you mean `sample_time`?");
  expect("plant", "smaple_time", "unknown key, did you mean `sample_time`?");
  expect("kalman", "measurment_noise", "unknown key, did you mean `measurement_noise`?");
  expect("kalman", "gian", "unknown key, did you mean `gain`?");
  expect("", "kalmann", "unknown key, did you mean `kalman`?");
  expect("observer", "pols", "unknown key, did you mean `poles`?");
}

void test_capitals_alone_are_the_nearest() {
  expect("plant", "a", "unknown key, did you mean `A`?");
  expect("lqr", "q", "unknown key, did you mean `Q`?");
  expect("kalman", "Gain", "unknown key, did you mean `gain`?");
}

void test_key_of_another_table_names_that_table() {
  expect("plant", "Q", "unknown key here; `Q` belongs to [lqr]");
  expect("lqr", "gain", "unknown key here; `gain` belongs to [kalman]");
  expect("", "sample_time", "unknown key here; `sample_time` belongs to [plant]");
  expect("plant", "name", "unknown key here; `name` belongs at the top, before the first table");
  expect("plant", "lqr", "unknown key here; `lqr` is a table of its own");
  expect("lqr", "process_noise", "unknown key here; `process_noise` belongs to [kalman]");
}

// MATLAB: lqr, kalman, ss, margin. python-control: lqe(A, G, C, QN, RN), dt.
void test_word_of_another_tool_names_the_key() {
  expect("plant", "Ts", "unknown key, did you mean `sample_time`?");
  expect("", "dt", "unknown key, did you mean `sample_time` in [plant]?");
  expect("kalman", "QN", "unknown key, did you mean `process_noise`?");
  expect("kalman", "ltrsyn", "unknown key, did you mean `recovery`?");
  expect("lqr", "LTR", "unknown key, did you mean `recovery` in [kalman]?");
  expect("kalman", "recovry", "unknown key, did you mean `recovery`?");
  expect("kalman", "R", "unknown key, did you mean `measurement_noise`?");
  expect("lqr", "RN", "unknown key, did you mean `measurement_noise` in [kalman]?");
  expect("require", "phase_margin", "unknown key, did you mean `phase_margin_deg`?");
  expect("lqr", "K",
         "unknown key, K is what lqgen computes: did you mean `Q` and `R` in [lqr], or `poles` in [pole_placement]?");
  for (const char* table : {"plant", "lqr", "kalman", "limits", "require"})
    for (const char* word : {"Ts", "QN", "umax", "phase_margin", "x0"})
      TEST_ASSERT_NOT_NULL_MESSAGE(find_rule(suggest(table, word).path), word);
}

void test_key_like_no_other_gets_no_advice() {
  expect("plant", "mass", "unknown key");
  expect("lqr", "k", "unknown key");
  expect("", "", "unknown key");
  expect("plant", std::string(100000, 'A').c_str(), "unknown key");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_every_key_stands_once_and_below_its_table);
  RUN_TEST(test_misspelt_key_names_the_nearest_of_its_table);
  RUN_TEST(test_capitals_alone_are_the_nearest);
  RUN_TEST(test_key_of_another_table_names_that_table);
  RUN_TEST(test_word_of_another_tool_names_the_key);
  RUN_TEST(test_key_like_no_other_gets_no_advice);
  return UNITY_END();
}
