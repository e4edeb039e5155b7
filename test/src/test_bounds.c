/* SPDX-License-Identifier: MIT */
/* The bounds of a state and of what is believed: hit exactly, just missed, and left far behind, in each entry. The
 * plant is x⁺ = x + u, y = x, so that a prediction from x = 0 leaves x = u. */
#include <float.h>
#include <math.h>
#include <stddef.h>

#include "lqg/lqg.h"
#include "unity.h"

enum { NX = 3, STEADY = 0, PLAIN = 1, UD = 2, FILTERS = 3 };

static const lqg_real identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, L[9] = {0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f};
static const lqg_real one[3] = {1, 1, 1}, none[6] = {0}, P0[6] = {1, 0, 1, 0, 0, 1}, x0[3] = {1, 2, 0.5f};
static const lqg_real bound[3] = {16, 64, 4}, scale[3] = {1 / 16.0f, 1 / 64.0f, 0.25f}, limit[3] = {8, 2, 32};

#define PLANT {NX, NX, NX, identity, identity, identity, NULL, NULL}
static lqg_kalman_steady_t steady = {PLANT, L, NULL, x0, scale, limit, NULL, NULL};
static lqg_kalman_plain_t plain = {PLANT, NULL, one, none, NULL, NULL, x0, P0, scale, limit, NULL};
static lqg_kalman_ud_t ud = {PLANT, NULL, one, 0, NULL, NULL, NULL, NULL, x0, none, one, scale, limit, NULL};

static lqg_real x[3], P[6], U[3], d[3], work[LQG_KALMAN_UD_WORK(3, 3, 0)];
static unsigned long gated[3];
static lqg_kalman_steady_state_t steady_state = {x, NULL, NULL, {NULL, NULL}, work};
static lqg_kalman_plain_state_t plain_state = {x, P, NULL, NULL, {NULL, NULL}, work};
static lqg_kalman_ud_state_t ud_state = {x, U, d, NULL, NULL, {NULL, gated}, work};

/* What a status says of an output that is rejected. */
#define REJECTED(i) (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i))

static void set_bounds(const lqg_real *scales, const lqg_real *limits)
{
    steady.x_scale = plain.x_scale = ud.x_scale = scales;
    steady.innovation_limit = plain.innovation_limit = ud.innovation_limit = limits;
}

void setUp(void)
{
    set_bounds(scale, limit);
}

void tearDown(void) {}

/* Begins with x̂ = 0. */
static void begin(int filter)
{
    if (filter == STEADY)
        lqg_kalman_steady_init(&steady, &steady_state);
    if (filter == PLAIN)
        lqg_kalman_plain_init(&plain, &plain_state);
    if (filter == UD)
        lqg_kalman_ud_init(&ud, &ud_state);
    x[0] = x[1] = x[2] = 0;
}

static lqg_status_t predict(int filter, const lqg_real u[])
{
    if (filter == STEADY)
        return lqg_kalman_steady_predict(&steady, &steady_state, u);
    if (filter == PLAIN)
        return lqg_kalman_plain_predict(&plain, &plain_state, u);
    return lqg_kalman_ud_predict(&ud, &ud_state, u);
}

static lqg_status_t update(int filter, const lqg_real y[])
{
    if (filter == STEADY)
        return lqg_kalman_steady_update(&steady, &steady_state, y);
    if (filter == PLAIN)
        return lqg_kalman_plain_update(&plain, &plain_state, y);
    return lqg_kalman_ud_update(&ud, &ud_state, y);
}

static lqg_real just_below(lqg_real value)
{
#ifdef LQG_REAL_DOUBLE
    return nextafter(value, 0);
#else
    return nextafterf(value, 0);
#endif
}

static lqg_status_t predict_to(int filter, int i, lqg_real value)
{
    lqg_real u[3] = {0};
    u[i] = value;
    begin(filter);
    return predict(filter, u);
}

static void expect_reset(lqg_status_t status)
{
    TEST_ASSERT_EQUAL_HEX(LQG_STATE_RESET, status);
    for (int i = 0; i < NX; i++)
        TEST_ASSERT_TRUE(x[i] == x0[i]);
}

/* x̂ stays. */
static void expect_P_anew(int filter, lqg_status_t status)
{
    TEST_ASSERT_EQUAL_HEX(LQG_COVARIANCE_RESET, status);
    for (int i = 0; i < NX; i++)
        TEST_ASSERT_TRUE(x[i] == 0 && (filter == PLAIN || d[i] == one[i]));
    for (int i = 0; i < 6; i++)
        TEST_ASSERT_TRUE(filter == UD || P[i] == P0[i]);
}

static void test_each_state_stays_just_below_its_bound_and_begins_anew_at_it(void)
{
    for (int filter = 0; filter < FILTERS; filter++) {
        plain.P0 = none; /* so that the estimate alone counts */
        ud.d0 = none;
        for (int i = 0; i < NX; i++) {
            for (int sign = -1; sign <= 1; sign += 2) {
                const lqg_real inside = (lqg_real)sign * just_below(bound[i]);
                TEST_ASSERT_EQUAL_HEX(LQG_OK, predict_to(filter, i, inside));
                TEST_ASSERT_TRUE(x[i] == inside);
                expect_reset(predict_to(filter, i, (lqg_real)sign * bound[i]));
            }
        }
        plain.P0 = P0;
        ud.d0 = one;
    }
}

static void test_anything_beyond_begins_anew_and_nothing_tiny_does(void)
{
    const lqg_real huge[] = {(lqg_real)NAN, (lqg_real)INFINITY, -(lqg_real)INFINITY, 1e30f, -1e30f, FLT_MAX};
    const lqg_real tiny[] = {0, -(lqg_real)0, FLT_MIN / 2, -FLT_MIN};
    for (int filter = 0; filter < FILTERS; filter++) {
        for (int i = 0; i < NX; i++) {
            for (unsigned k = 0; k < sizeof huge / sizeof *huge; k++)
                expect_reset(predict_to(filter, i, huge[k]));
            for (unsigned k = 0; k < sizeof tiny / sizeof *tiny; k++)
                TEST_ASSERT_EQUAL_HEX(LQG_OK, predict_to(filter, i, tiny[k]));
        }
    }
}

static void test_states_near_their_bounds_together_are_beyond(void)
{
    const lqg_real u[3] = {12, 48, 0}; /* ¾ of each bound: 9/16 + 9/16 */
    begin(STEADY);
    expect_reset(predict(STEADY, u));
}

static void test_update_keeps_the_bounds(void)
{
    const lqg_real far_off[3] = {0, 0, 31}, y[3] = {0, 0, 10}; /* both believable */
    for (int filter = 0; filter < FILTERS; filter++) {
        begin(filter);
        expect_reset(update(filter, far_off));
        begin(filter);
        x[2] = 2;
        expect_reset(update(filter, y));
    }
}

/* P_ii, or d_i, of one state alone. */
static lqg_status_t predict_with_variance(int filter, int i, lqg_real variance)
{
    begin(filter);
    for (int k = 0; k < 6; k++)
        P[k] = 0;
    d[0] = d[1] = d[2] = 0;
    P[i * (i + 1) / 2 + i] = d[i] = variance;
    return predict(filter, none);
}

static void test_each_variance_stays_just_below_the_square_of_its_bound(void)
{
    for (int filter = PLAIN; filter < FILTERS; filter++) {
        for (int i = 0; i < NX; i++) {
            const lqg_real square = bound[i] * bound[i];
            TEST_ASSERT_EQUAL_HEX(LQG_OK, predict_with_variance(filter, i, just_below(square)));
            expect_P_anew(filter, predict_with_variance(filter, i, square));
            expect_P_anew(filter, predict_with_variance(filter, i, -square));
            expect_P_anew(filter, predict_with_variance(filter, i, -FLT_MIN)); /* however small, without noise */
            expect_P_anew(filter, predict_with_variance(filter, i, (lqg_real)NAN));
            expect_P_anew(filter, predict_with_variance(filter, i, (lqg_real)INFINITY));
        }
    }
}

static void test_factors_have_to_be_finite_only(void)
{
    for (int k = 0; k < 3; k++) {
        begin(UD);
        U[k] = 1e6f; /* finite, whatever its size */
        d[0] = d[1] = d[2] = 1e-20f;
        TEST_ASSERT_EQUAL_HEX(LQG_OK, predict(UD, none));
        begin(UD);
        U[k] = (lqg_real)NAN;
        expect_P_anew(UD, predict(UD, none));
    }
}

/* An update makes no variance larger: it is predict that looks at them. */
static void test_update_by_factors_looks_at_the_estimate_alone(void)
{
    const lqg_real missing[3] = {(lqg_real)NAN, (lqg_real)NAN, (lqg_real)NAN};
    for (int i = 0; i < NX; i++) {
        begin(UD);
        d[i] = 2 * bound[i] * bound[i];
        TEST_ASSERT_EQUAL_HEX(REJECTED(0) | REJECTED(1) | REJECTED(2), update(UD, missing));
        TEST_ASSERT_TRUE(d[i] == 2 * bound[i] * bound[i]);
        TEST_ASSERT_EQUAL_HEX(REJECTED(0), lqg_kalman_ud_update_output(&ud, &ud_state, &missing[0], 0, NULL));
        expect_P_anew(UD, predict(UD, none));
    }
}

/* The noise of the last output is made independent by the first one alone. */
static void test_an_output_is_not_updated_alone_when_any_other_makes_it_independent(void)
{
    static const lqg_real by_first[9] = {1, 0, 0, 0, 1, 0, 0.5f, 0, 1}, by_second[9] = {1, 0, 0, 0, 1, 0, 0, 0.5f, 1};
    const lqg_real *both[] = {by_first, by_second};
    for (int k = 0; k < 2; k++) {
        lqg_kalman_plain_t kalman = plain;
        kalman.E = both[k];
        begin(PLAIN);
        for (unsigned i = 0; i < NX; i++)
            TEST_ASSERT_EQUAL_HEX(i < 2 ? LQG_OK : REJECTED(i),
                                  lqg_kalman_plain_update_output(&kalman, &plain_state, &one[i], i, NULL));
        TEST_ASSERT_TRUE(x[0] != 0 && x[1] != 0 && x[2] == 0);
    }
}

/* x̂ and all that an update could touch. */
static int state_changes(int filter, int i, lqg_real y_i, lqg_status_t expected)
{
    lqg_real y[3] = {0, 0, 0};
    begin(filter);
    y[i] = y_i;
    TEST_ASSERT_EQUAL_HEX(expected, update(filter, y));
    return x[0] != 0 || x[1] != 0 || x[2] != 0;
}

static void test_an_innovation_at_its_limit_is_left_out_and_one_just_below_is_not(void)
{
    static const lqg_real wide[3] = {1 / 1024.0f, 1 / 1024.0f, 1 / 1024.0f};
    set_bounds(wide, limit);
    for (int filter = 0; filter < FILTERS; filter++) {
        for (int i = 0; i < NX; i++) {
            for (int sign = -1; sign <= 1; sign += 2) {
                const lqg_real at = (lqg_real)sign * limit[i];
                TEST_ASSERT_FALSE(state_changes(filter, i, at, REJECTED(i)));
                TEST_ASSERT_TRUE(state_changes(filter, i, just_below(at), LQG_OK));
            }
            TEST_ASSERT_FALSE(state_changes(filter, i, (lqg_real)NAN, REJECTED(i)));
            TEST_ASSERT_FALSE(state_changes(filter, i, 1e30f, REJECTED(i)));
            TEST_ASSERT_FALSE(state_changes(filter, i, -(lqg_real)INFINITY, REJECTED(i)));
        }
    }
}

/* What is not believed is not gated, either: one reason is enough. */
static void test_an_innovation_that_is_not_believed_is_not_counted_by_the_gate(void)
{
    static const lqg_gate_t gate = {3, NULL, NULL, NULL};
    lqg_real innovation[3];
    const lqg_watch_t watch = {innovation, NULL, NULL};
    const lqg_real y[3] = {1e6f, 1.0f, 20};

    ud.gate = &gate;
    begin(UD);
    TEST_ASSERT_EQUAL_HEX(REJECTED(0) | LQG_OUTPUT_GATED,
                          lqg_kalman_ud_partial_update(&ud, &ud_state, y, LQG_ALL_OUTPUTS, &watch));
    ud.gate = NULL;
    TEST_ASSERT_TRUE(gated[0] == 0 && gated[1] == 0 && gated[2] == 1);
    TEST_ASSERT_TRUE(innovation[0] == 0 && innovation[1] == 1 && innovation[2] == 20);
}

static void test_without_bounds_finite_is_enough(void)
{
    set_bounds(NULL, NULL);
    for (int filter = 0; filter < FILTERS; filter++) {
        for (int i = 0; i < NX; i++) {
            TEST_ASSERT_EQUAL_HEX(LQG_OK, predict_to(filter, i, 1e30f));
            expect_reset(predict_to(filter, i, (lqg_real)NAN));
            TEST_ASSERT_TRUE(state_changes(filter, i, 1e30f, LQG_OK));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_state_stays_just_below_its_bound_and_begins_anew_at_it);
    RUN_TEST(test_anything_beyond_begins_anew_and_nothing_tiny_does);
    RUN_TEST(test_states_near_their_bounds_together_are_beyond);
    RUN_TEST(test_update_keeps_the_bounds);
    RUN_TEST(test_each_variance_stays_just_below_the_square_of_its_bound);
    RUN_TEST(test_factors_have_to_be_finite_only);
    RUN_TEST(test_update_by_factors_looks_at_the_estimate_alone);
    RUN_TEST(test_an_output_is_not_updated_alone_when_any_other_makes_it_independent);
    RUN_TEST(test_an_innovation_at_its_limit_is_left_out_and_one_just_below_is_not);
    RUN_TEST(test_an_innovation_that_is_not_believed_is_not_counted_by_the_gate);
    RUN_TEST(test_without_bounds_finite_is_enough);
    return UNITY_END();
}
