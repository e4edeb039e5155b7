/* Two lemmas that README.md uses, tried on every 251st float and on the edges of the range. */
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_v_minus_v_is_zero_exactly_when_v_is_finite);
    RUN_TEST(test_a_sum_is_finite_only_when_both_terms_are);
    return UNITY_END();
}
