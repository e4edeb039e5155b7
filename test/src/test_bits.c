/* SPDX-License-Identifier: MIT */
/* Every bit of the library, the same on every machine. The numbers are those of x86-64, gcc 12, -O2: run the
 * test to see the new ones after a change that is meant. */
#include "bits.h"
#include "lqg/functions.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

#if defined LQG_REAL_DOUBLE && defined LQG_FUSED
#define EXPECTED 0xba5664090c9b1a54ull
#elif defined LQG_REAL_DOUBLE
#define EXPECTED 0xee2d1f69e8b983feull
#elif defined LQG_FUSED
#define EXPECTED 0x1f80ec005564ac4cull
#else
#define EXPECTED 0xd6aecc610690ff1cull
#endif

/* In halves: Unity for small targets has no 64-bit numbers. */
static void test_1000_samples_of_all_filters_give_the_bits_of_the_pc(void)
{
    const unsigned long long hash = hash_of_all_filters();
    TEST_ASSERT_EQUAL_HEX32(EXPECTED >> 32, hash >> 32);
    TEST_ASSERT_EQUAL_HEX32(EXPECTED & 0xffffffffu, hash & 0xffffffffu);
}

/* In all variants: lqg/functions.h knows none. */
static void test_elementary_functions_give_the_bits_of_the_pc(void)
{
    const unsigned long long hash = hash_of_all_functions();
    TEST_ASSERT_EQUAL_HEX32(0x50ef5698u, hash >> 32);
    TEST_ASSERT_EQUAL_HEX32(0x571ac0fbu, hash & 0xffffffffu);
}

static void test_elementary_functions_of_double_give_the_bits_of_the_pc(void)
{
#if LQG_HAS_DOUBLE
    const unsigned long long hash = hash_of_all_double_functions();
    TEST_ASSERT_EQUAL_HEX32(0x575ba9b0u, hash >> 32);
    TEST_ASSERT_EQUAL_HEX32(0x4961be0bu, hash & 0xffffffffu);
#else
    TEST_IGNORE_MESSAGE("double has 32 bits");
#endif
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_1000_samples_of_all_filters_give_the_bits_of_the_pc);
    RUN_TEST(test_elementary_functions_give_the_bits_of_the_pc);
    RUN_TEST(test_elementary_functions_of_double_give_the_bits_of_the_pc);
    return UNITY_END();
}
