/* SPDX-License-Identifier: MIT */
/* The gate: what it leaves out and lets in, how it opens and narrows, and what is told of it. */
#include <math.h>
#include <string.h>

#include "loop.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static const model_t *const models[] = {&double_integrator, &two_mass, &correlated, &cross_noise, &random_walk};
enum { MODELS = sizeof models / sizeof *models };

static loop_t tested, other; /* here once for all tests: small targets have little memory */

static const lqg_real widen[MAX_NY] = {1.5f, 1.5f}, narrow[MAX_NY] = {0.5f, 0.5f};
static const lqg_gate_t narrow_gate = {3, NULL, NULL, NULL}, half_gate = {0.5f, NULL, NULL, NULL};
static const lqg_gate_t two_gate = {2, NULL, NULL, NULL}, wide_gate = {1000, NULL, NULL, NULL};
static const lqg_gate_t opening_gate = {3, NULL, widen, narrow}, wide_opening_gate = {1000, NULL, widen, narrow};
static const unsigned long first = 1ul << 0, second = 1ul << 1;

/* Of the loop's constant gain: any variances, as its gain is not the best one either. */
static const lqg_real steady_S[MAX_NY] = {0.5f, 0.25f};

static void set_gate(loop_t *loop, const lqg_gate_t *gate)
{
    loop->steady.kalman.gate = loop->plain.kalman.gate = loop->ud.kalman.gate = gate;
    loop->steady.kalman.S = steady_S;
}

/* A loop some samples after its beginning, from now on with a gate whose widening is 1. */
static void make_gated_loop(loop_t *loop, const model_t *model, unsigned filter, const lqg_gate_t *gate)
{
    make_running_loop(loop, model, filter);
    set_gate(loop, gate);
    for (unsigned i = 0; i < MAX_NY; i++)
        loop->state.widening[i] = 1;
}

/* The first output alone, `sigmas` standard deviations from what is expected. */
static lqg_status_t update_with_outlier(loop_t *loop, double sigmas)
{
    lqg_real y[MAX_NY] = {0}, innovation[MAX_NY] = {0}, S[MAX_NY] = {0};
    const lqg_watch_t look = {innovation, S, NULL};
    const lqg_gate_t *gate = loop->ud.kalman.gate;
    const state_t before = loop->state;

    set_gate(loop, NULL);
    loop_partial_update(loop, y, first, &look); /* of y = 0, to see what is expected */
    set_gate(loop, gate);
    loop->state = before;
    y[0] = (lqg_real)(sigmas * sqrt((double)S[0]) - (double)innovation[0]);
    return loop_partial_update(loop, y, first, NULL);
}

static void test_gate_leaves_out_what_lies_beyond_it_and_counts(void)
{
    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < MODELS; m++) {
            make_gated_loop(&tested, models[m], filter, &narrow_gate);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 2.99));
            make_gated_loop(&tested, models[m], filter, &narrow_gate);
            TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, 3.01));
            TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, -1e6));
            TEST_ASSERT_EQUAL_UINT32(2, tested.state.gated[0]);
            TEST_ASSERT_EQUAL_UINT32(0, tested.state.gated[1]);
        }
}

static void test_gate_may_be_less_than_one_standard_deviation(void)
{
    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_gated_loop(&tested, &two_mass, filter, &half_gate);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, 0.51));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 0.49));
    }
}

/* 2² s = 1² with s = 0.25, all of them exact. */
static void test_output_right_at_the_gate_is_let_in(void)
{
    const lqg_real at[MAX_NY] = {0, 1}, beyond[MAX_NY] = {0, 1.0001f};

    make_loop(&tested, &two_mass, STEADY, LQG_FILTER_FORM);
    set_gate(&tested, &two_gate);
    memset(tested.state.x, 0, sizeof tested.state.x);
    TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, loop_partial_update(&tested, beyond, second, NULL));
    TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_partial_update(&tested, at, second, NULL));
}

static void test_a_gated_output_does_not_come_in_by_way_of_one_that_is_freed_of_its_noise(void)
{
    const lqg_real y[MAX_NY] = {1e6f, -0.25f}, missing[MAX_NY] = {NAN, -0.25f};

    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        make_gated_loop(&tested, &correlated, filter, &narrow_gate);
        make_running_loop(&other, &correlated, filter);
        TEST_ASSERT_EQUAL_HEX(LQG_OUTPUT_GATED | REJECTED(1), loop_update(&tested, y));
        TEST_ASSERT_EQUAL_HEX(REJECTED(0) | REJECTED(1), loop_update(&other, missing));
        TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
    }
}

/* Of outputs that are used, far off, no number, and not asked for; with a gate and without. */
static void test_heard_tells_which_outputs_were_used(void)
{
    unsigned char heard[MAX_NY];
    const lqg_watch_t watch = {NULL, NULL, heard};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned k = 0; k < 8; k++) {
            const lqg_real y[MAX_NY] = {k & 1 ? (lqg_real)NAN : 1e6f, 0};
            const int has_gate = k & 2, asks_for_both = k & 4;

            heard[0] = heard[1] = 7;
            make_gated_loop(&tested, &two_mass, filter, has_gate ? &wide_opening_gate : NULL);
            (void)loop_partial_update(&tested, y, asks_for_both ? first | second : second, &watch);
            TEST_ASSERT_EQUAL_UINT(asks_for_both && !has_gate && !(k & 1), heard[0]);
            TEST_ASSERT_EQUAL_UINT(1, heard[1]);
        }
}

static void test_a_gated_output_is_one_that_is_not_used(void)
{
    const lqg_real y[MAX_NY] = {1e6f, -0.25f};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_gated_loop(&tested, &two_mass, filter, &wide_gate);
        make_running_loop(&other, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, loop_update(&tested, y));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_partial_update(&other, y, second, NULL));
        TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
    }
}

/* Within 2⁸⁰ = 1.5¹³⁷, whatever the widening was. */
static void test_gate_opens_for_an_output_that_is_left_out_again_and_again_and_narrows_again(void)
{
    const lqg_real begun[] = {1, 0, -4, NAN, INFINITY, -INFINITY};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned b = 0; b < sizeof begun / sizeof *begun; b++) {
            lqg_real *widening = tested.state.widening;
            unsigned samples = 0;
            make_gated_loop(&tested, &two_mass, filter, &opening_gate);
            const state_t before = tested.state;
            widening[0] = begun[b];
            while (update_with_outlier(&tested, 1e6) == LQG_OUTPUT_GATED && samples < 200) {
                TEST_ASSERT_TRUE(widening[0] >= 1);
                samples++;
            }
            TEST_ASSERT_TRUE(samples <= 64); /* (1e6/3)² = 1.5^62.7 */
            const lqg_real opened = widening[0];
            tested.state = before;
            widening[0] = opened;
            for (unsigned k = 0; k < 80; k++)
                TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 0));
            TEST_ASSERT_TRUE(widening[0] == 1);
            TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, 3.1));
        }
}

static void test_gate_is_never_wider_than_the_widest(void)
{
    const lqg_real same[MAX_NY] = {1, 1};
    const lqg_gate_t gate = {3, NULL, same, same};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_gated_loop(&tested, &two_mass, filter, &gate);
        tested.state.widening[0] = INFINITY;
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 0));
        TEST_ASSERT_TRUE(tested.state.widening[0] == (lqg_real)1208925819614629174706176.0f); /* 2⁸⁰ */
    }
}

/* P grows by itself while nothing is heard; of a constant gain the gate does. */
static void test_silence_opens_the_gate_of_a_constant_gain_only(void)
{
    const lqg_real y[MAX_NY] = {NAN, 0};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_gated_loop(&tested, &two_mass, filter, &wide_opening_gate);
        tested.state.widening[0] = tested.state.widening[1] = 4;
        TEST_ASSERT_EQUAL_HEX(REJECTED(0), loop_partial_update(&tested, y, first, NULL));
        TEST_ASSERT_TRUE(tested.state.widening[0] == (filter == STEADY ? 6 : 4));
        TEST_ASSERT_TRUE(tested.state.widening[1] == (filter == STEADY ? 6 : 4));
    }
}

static void test_an_output_that_is_no_number_is_not_the_gate_s_business(void)
{
    const lqg_real y[MAX_NY] = {NAN, NAN};
    lqg_real innovation[MAX_NY] = {7, 7}, S[MAX_NY] = {0};
    const lqg_watch_t watch = {innovation, S, NULL};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_gated_loop(&tested, &two_mass, filter, &narrow_gate);
        TEST_ASSERT_EQUAL_HEX(REJECTED(0) | REJECTED(1), loop_partial_update(&tested, y, LQG_ALL_OUTPUTS, &watch));
        TEST_ASSERT_EQUAL_UINT32(0, tested.state.gated[0] + tested.state.gated[1]);
        TEST_ASSERT_TRUE(innovation[0] == 0 && innovation[1] == 0 && S[0] > 0 && S[1] > 0);
    }
}

static void test_init_and_a_reset_begin_with_the_widening_of_the_description_and_leave_the_count(void)
{
    const lqg_real start[MAX_NY] = {2, 8}, u[MAX_NU] = {NAN};
    const lqg_gate_t gate = {3, start, widen, narrow};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_gated_loop(&tested, &two_mass, filter, &gate);
        tested.state.gated[1] = 5;
        TEST_ASSERT_EQUAL_UINT(LQG_STATE_RESET, loop_predict(&tested, u));
        TEST_ASSERT_TRUE(tested.state.widening[0] == 2 && tested.state.widening[1] == 8);
        TEST_ASSERT_EQUAL_UINT32(5, tested.state.gated[1]);
        tested.state.widening[0] = 7;
        loop_init(&tested);
        TEST_ASSERT_TRUE(tested.state.widening[0] == 2 && tested.state.widening[1] == 8);
        set_gate(&tested, &opening_gate);
        loop_init(&tested);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, 3.1)); /* as with a widening of 1 */
    }
}

static void test_a_gate_that_keeps_its_width_and_is_not_counted_needs_no_memory(void)
{
    LQG_KALMAN_UD_STATE(bare, 4, 1, 2, 4);
    const lqg_real y[MAX_NY] = {1e6f, 0};

    make_loop(&tested, &two_mass, UD, LQG_FILTER_FORM);
    set_gate(&tested, &narrow_gate);
    bare.gate.widening = NULL;
    lqg_kalman_ud_init(&tested.ud.kalman, &bare);
    TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, lqg_kalman_ud_update(&tested.ud.kalman, &bare, y));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gate_leaves_out_what_lies_beyond_it_and_counts);
    RUN_TEST(test_gate_may_be_less_than_one_standard_deviation);
    RUN_TEST(test_output_right_at_the_gate_is_let_in);
    RUN_TEST(test_a_gated_output_does_not_come_in_by_way_of_one_that_is_freed_of_its_noise);
    RUN_TEST(test_heard_tells_which_outputs_were_used);
    RUN_TEST(test_a_gated_output_is_one_that_is_not_used);
    RUN_TEST(test_gate_opens_for_an_output_that_is_left_out_again_and_again_and_narrows_again);
    RUN_TEST(test_gate_is_never_wider_than_the_widest);
    RUN_TEST(test_silence_opens_the_gate_of_a_constant_gain_only);
    RUN_TEST(test_an_output_that_is_no_number_is_not_the_gate_s_business);
    RUN_TEST(test_init_and_a_reset_begin_with_the_widening_of_the_description_and_leave_the_count);
    RUN_TEST(test_a_gate_that_keeps_its_width_and_is_not_counted_needs_no_memory);
    return UNITY_END();
}
