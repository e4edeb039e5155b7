// SPDX-License-Identifier: MIT
// Numbers whose digits are in the stores of threads.
#include <thread>
#include <vector>

#include <unity.h>

#include "design/number_memory.hpp"
#include "design/numeric/digits.hpp"
#include "design/thread.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

// 1/3, 1/4, … with more and more digits: from one limb to what no store keeps.
std::vector<Real> made_numbers() {
  std::vector<Real> numbers;
  for (int i = 0; i < 400; ++i) {
    const Digits scope(static_cast<unsigned>(10 + 7 * i));
    numbers.push_back(Real(1) / (3 + i));
  }
  return numbers;
}

bool are_whole(const std::vector<Real>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Digits scope(static_cast<unsigned>(10 + 7 * i));
    if (numbers[i] != Real(1) / static_cast<int>(3 + i)) return false;
  }
  return true;
}

void test_no_number_changes_when_others_of_all_lengths_come_and_go() {
  const std::vector<Real> numbers = made_numbers();
  for (int i = 0; i < 3; ++i) TEST_ASSERT_TRUE(are_whole(made_numbers()));
  TEST_ASSERT_TRUE(are_whole(numbers));
}

void test_a_number_keeps_its_value_when_it_gets_more_digits() {
  const Digits scope(15);
  for (const long bits : {64L, 128L, 200L, 1000L, 4000L, 5000L, 60000L}) {
    Real number = Real(5) / 8;
    mpfr_prec_round(number.backend().data(), bits, MPFR_RNDN);
    const std::vector<Real> others = made_numbers();
    TEST_ASSERT_TRUE(number == 0.625);
    mpfr_prec_round(number.backend().data(), 64, MPFR_RNDN);
    TEST_ASSERT_TRUE(number == 0.625 && are_whole(others));
  }
}

void test_numbers_of_one_thread_may_end_in_another() {
  std::vector<Real> numbers;
  bool were_whole = false;
  std::thread maker([&] {
    const ThreadCaches caches;
    numbers = made_numbers();
    were_whole = are_whole(made_numbers());
  });
  maker.join();
  TEST_ASSERT_TRUE(were_whole && are_whole(numbers));
  numbers.clear();
  TEST_ASSERT_TRUE(are_whole(made_numbers()));
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  use_number_stores();
  UNITY_BEGIN();
  RUN_TEST(test_no_number_changes_when_others_of_all_lengths_come_and_go);
  RUN_TEST(test_a_number_keeps_its_value_when_it_gets_more_digits);
  RUN_TEST(test_numbers_of_one_thread_may_end_in_another);
  return UNITY_END();
}
