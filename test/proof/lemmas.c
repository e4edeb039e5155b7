/* SPDX-License-Identifier: MIT */
/* Four lemmas that README.md uses, tried on every 251st float and on the edges of the range. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "finite.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void test_v_minus_v_is_zero_exactly_when_v_is_finite(void)
{
    for (uint64_t bits = 0; bits <= UINT32_MAX; bits += 251) {
        const volatile float v = float_of((uint32_t)bits);
        TEST_ASSERT_TRUE((v - v == 0) == FINITE(v));
    }
    const float edges[] = {0, -0.0f, FLT_MIN, FLT_MIN / 2, FLT_MAX, -FLT_MAX, INFINITY, -INFINITY, NAN, -NAN};
    for (unsigned i = 0; i < sizeof edges / sizeof *edges; i++) {
        const volatile float v = edges[i];
        TEST_ASSERT_TRUE((v - v == 0) == FINITE(v));
    }
}

static void test_a_sum_is_finite_only_when_both_terms_are(void)
{
    for (uint64_t bits = 0; bits <= UINT32_MAX; bits += 65521) {
        const volatile float a = float_of((uint32_t)bits);
        for (unsigned i = 0; i < 2048; i++) {
            const volatile float b = float_of(i << 21); /* both signs, every exponent */
            const float sum = a + b;
            TEST_ASSERT_TRUE(!FINITE(sum) || (FINITE(a) && FINITE(b)));
        }
    }
}

/* Of every binade the numbers next to its edges, and some in between. */
static void test_a_square_is_below_a_power_of_four_exactly_when_the_number_is_below_its_root(void)
{
    for (int e = -62; e <= 62; e++) {
        const float bound = ldexpf(1, e), square = ldexpf(1, 2 * e);
        for (uint32_t step = 0; step < 1000; step++) {
            const volatile float below = float_of(0x3f7fffffu - step) * bound,
                                 above = float_of(0x3f800000u + step) * bound;
            const float of_below = below * below, of_above = above * above;
            TEST_ASSERT_TRUE(of_below < square && !(of_above < square));
            TEST_ASSERT_TRUE(fmaf(below, below, 0) < square && !(fmaf(above, above, 0) < square));
        }
    }
}

static void test_a_sum_without_negative_terms_is_at_least_each_of_them(void)
{
    for (uint64_t bits = 0; bits < 0x7f800000u; bits += 65521) {
        const volatile float a = float_of((uint32_t)bits);
        for (unsigned i = 0; i < 1024; i++) {
            const volatile float b = float_of(i << 21); /* every exponent; some are NaN */
            const float sum = a + b, scaled = fmaf(b, b, a);
            TEST_ASSERT_TRUE(!(sum == sum) || (sum >= a && sum >= b));
            TEST_ASSERT_TRUE(!(scaled == scaled) || (scaled >= a && scaled >= b * b));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_v_minus_v_is_zero_exactly_when_v_is_finite);
    RUN_TEST(test_a_sum_is_finite_only_when_both_terms_are);
    RUN_TEST(test_a_square_is_below_a_power_of_four_exactly_when_the_number_is_below_its_root);
    RUN_TEST(test_a_sum_without_negative_terms_is_at_least_each_of_them);
    return UNITY_END();
}
