/* SPDX-License-Identifier: MIT */
/* The control law and its limits, and a status in words. */
#include <math.h>
#include <string.h>

#include "lqg/lqg.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static const lqg_real K[6] = {1, 2, -4, 0.5f, 0, 8};
static const lqg_real u_min[2] = {-10, -1}, u_max[2] = {10, 2};
static const lqg_lqr_t unlimited = {3, 2, K, NULL, NULL}, limited = {3, 2, K, u_min, u_max};

static void test_control_is_minus_K_x(void)
{
    const lqg_real x[3] = {1, 2, 3};
    lqg_real u[2];
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_lqr_control(&unlimited, x, u));
    TEST_ASSERT_TRUE(u[0] == 7 && u[1] == -24.5f);
}

static void test_control_within_limits_is_untouched_even_on_the_limit(void)
{
    const lqg_real x[3] = {0, 5, 0.125f}; /* u_0 = −9.5, u_1 = −1: on the limit */
    lqg_real u[2];
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_lqr_control(&limited, x, u));
    TEST_ASSERT_TRUE(u[0] == -9.5f && u[1] == -1);
}

static void test_control_stops_at_its_limits_and_says_so(void)
{
    const lqg_real high[3] = {0, 0, -3}, low[3] = {0, 0, 3};
    lqg_real u[2];
    TEST_ASSERT_EQUAL_UINT(LQG_INPUT_LIMITED, lqg_lqr_control(&limited, high, u));
    TEST_ASSERT_TRUE(u[0] == -10 && u[1] == 2);
    TEST_ASSERT_EQUAL_UINT(LQG_INPUT_LIMITED, lqg_lqr_control(&limited, low, u));
    TEST_ASSERT_TRUE(u[0] == 10 && u[1] == -1);
}

static void test_control_with_one_limit_only(void)
{
    const lqg_lqr_t lower = {3, 2, K, u_min, NULL}, upper = {3, 2, K, NULL, u_max};
    const lqg_real x[3] = {0, 0, -3};
    lqg_real u[2];
    TEST_ASSERT_EQUAL_UINT(LQG_INPUT_LIMITED, lqg_lqr_control(&lower, x, u));
    TEST_ASSERT_TRUE(u[0] == -10 && u[1] == 24);
    TEST_ASSERT_EQUAL_UINT(LQG_INPUT_LIMITED, lqg_lqr_control(&upper, x, u));
    TEST_ASSERT_TRUE(u[0] == -12 && u[1] == 2);
}

static void test_control_with_infinite_limits_has_none(void)
{
    const lqg_real low[2] = {-INFINITY, -INFINITY}, high[2] = {INFINITY, INFINITY}, x[3] = {0, 0, -300};
    const lqg_lqr_t lqr = {3, 2, K, low, high};
    lqg_real u[2];
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_lqr_control(&lqr, x, u));
    TEST_ASSERT_TRUE(u[0] == -1200 && u[1] == 2400);
}

static void test_control_is_finite_whatever_x_is(void)
{
    const lqg_real hostile[] = {NAN, INFINITY, -INFINITY};
    const lqg_lqr_t *regulators[] = {&unlimited, &limited};
    for (unsigned which = 0; which < 2; which++)
        for (unsigned value = 0; value < 3; value++)
            for (unsigned at = 0; at < 3; at++) {
                lqg_real x[3] = {1, 1, 1}, u[2] = {NAN, NAN};
                x[at] = hostile[value];
                TEST_ASSERT_TRUE(lqg_lqr_control(regulators[which], x, u) & LQG_INPUT_LIMITED);
                TEST_ASSERT_TRUE(isfinite(u[0]) && isfinite(u[1]));
                TEST_ASSERT_TRUE(u[0] == 0); /* every x has a part in u_0 */
            }
}

static void test_a_value_out_of_nothing_respects_limits_that_exclude_zero(void)
{
    const lqg_real low[2] = {3, 3}, high[2] = {5, 5}, x[3] = {NAN, NAN, NAN};
    const lqg_lqr_t lqr = {3, 2, K, low, high};
    lqg_real u[2];
    TEST_ASSERT_EQUAL_UINT(LQG_INPUT_LIMITED, lqg_lqr_control(&lqr, x, u));
    TEST_ASSERT_TRUE(u[0] == 3 && u[1] == 3);
}

static void test_every_status_has_its_own_sentence_and_the_gravest_wins(void)
{
    const lqg_status_t rising[] = {LQG_OK,
                                   LQG_INPUT_LIMITED,
                                   LQG_NOT_OPTIMAL,
                                   LQG_OUTPUT_GATED,
                                   LQG_OUTPUT_REJECTED,
                                   LQG_REFERENCE_NOT_FINITE,
                                   LQG_INNOVATION_NOT_POSITIVE,
                                   LQG_COVARIANCE_RESET,
                                   LQG_STATE_RESET};
    lqg_status_t all = LQG_OK;
    TEST_ASSERT_EQUAL_STRING("all is well", lqg_status_text(LQG_OK));
    for (unsigned i = 0; i < sizeof rising / sizeof *rising; i++) {
        all |= rising[i];
        TEST_ASSERT_EQUAL_STRING(lqg_status_text(rising[i]), lqg_status_text(all));
        for (unsigned j = 0; j < i; j++)
            TEST_ASSERT_TRUE(strcmp(lqg_status_text(rising[i]), lqg_status_text(rising[j])) != 0);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_control_is_minus_K_x);
    RUN_TEST(test_control_within_limits_is_untouched_even_on_the_limit);
    RUN_TEST(test_control_stops_at_its_limits_and_says_so);
    RUN_TEST(test_control_with_one_limit_only);
    RUN_TEST(test_control_with_infinite_limits_has_none);
    RUN_TEST(test_control_is_finite_whatever_x_is);
    RUN_TEST(test_a_value_out_of_nothing_respects_limits_that_exclude_zero);
    RUN_TEST(test_every_status_has_its_own_sentence_and_the_gravest_wins);
    return UNITY_END();
}
