// SPDX-License-Identifier: MIT
// Limits as deviations from an operating point, at the edge of rounding.
#include <cmath>
#include <limits>
#include <random>

#include <unity.h>

#include "controller/operating_point.hpp"

using lqg::controller::deviation_limit;

namespace {

template <class T>
void expect_the_limit(T limit, T point, int inward) {
  const T found = static_cast<T>(
      deviation_limit(static_cast<double>(limit), static_cast<double>(point), inward, sizeof(T) == sizeof(double)));
  const T outside = inward < 0 ? std::numeric_limits<T>::infinity() : -std::numeric_limits<T>::infinity();
  const auto is_within = [&](T deviation) {
    const T sum = point + deviation;
    return inward < 0 ? sum <= limit : sum >= limit;
  };
  TEST_ASSERT_TRUE(is_within(found));
  const T difference = limit - point;
  if (point + difference == limit)
    TEST_ASSERT_TRUE(found == difference);
  else
    TEST_ASSERT_FALSE(is_within(std::nextafter(found, outside)));
}

template <class T>
void expect_limits_to_hold() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-40, 40);
  const auto number = [&] { return static_cast<T>(std::ldexp(mantissa(random), exponent(random))); };
  for (int n = 0; n < 20000; ++n) {
    const T point = number(),
            limit =
                n % 2 ? number() : static_cast<T>(static_cast<double>(point) * (1 + std::ldexp(mantissa(random), -10)));
    for (const int inward : {-1, +1}) expect_the_limit(limit, point, inward);
  }
  for (const T limit : {T(0), T(-0.0), std::numeric_limits<T>::max(), std::numeric_limits<T>::denorm_min(), T(12)})
    for (const T point : {T(0), T(0.1), T(-7.3), T(1e20)})
      for (const int inward : {-1, +1}) expect_the_limit(limit, point, inward);
}

void test_a_limit_is_reached_where_it_can_be_and_never_left() {
  expect_limits_to_hold<float>();
  expect_limits_to_hold<double>();
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_limit_is_reached_where_it_can_be_and_never_left);
  return UNITY_END();
}
