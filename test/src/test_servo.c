/* SPDX-License-Identifier: MIT */
/* The control law with a memory. All numbers are sums of few powers of two: exact, fused or not. */
#include <math.h>

#include "lqg/lqg.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { NX = 2, NU = 2, NR = 2, NY = 3 };

static const lqg_real K[] = {1, 2, -4, 0.5f, -1, 2};                                 /* [x̂; ξ] */
static const lqg_real K_change[] = {1, 2, -4, 0.5f, 0.25f, 0.5f, -1, 2, -1, 0.125f}; /* [x̂; ξ; u[k−1]] */
static const lqg_real Nbar[] = {2, 0.5f, -1, 4}, H[] = {0.25f, -0.5f};
static const unsigned output[] = {2}, reference[] = {1};
static const lqg_real x[NX] = {1, 2}, r[NR] = {1, -2};

#define WITH_INTEGRAL \
    .nx = NX, .nu = NU, .nr = NR, .nxi = 1, .T = 0.5f, .H = H, .output = output, .reference = reference
static const lqg_servo_t integral = {WITH_INTEGRAL, .K = K, .Nbar = Nbar};
static const lqg_servo_t change = {WITH_INTEGRAL, .K = K_change, .Nbar = Nbar, .gives_change = 1};
static const lqg_servo_t without_integral = {.nx = NX, .nu = NU, .K = K};

/* The state of a law, and one number behind each array that nobody may touch. */
typedef struct {
    lqg_real xi[2], error[2], demand[NU + 1], u_applied[NU + 1], u[NU + 1];
} state_t;

static const state_t some = {{0.5f, 77}, {0.25f, 77}, {-1, 3, 77}, {4, -8, 77}, {0, 0, 77}};

/* The library's state over these arrays. */
static lqg_servo_state_t over(state_t *s, const lqg_real references[])
{
    static lqg_real r_of_state[NR];
    const lqg_servo_state_t state = {r_of_state, s->xi, s->error, s->demand, s->u_applied};
    for (unsigned i = 0; references && i < NR; i++)
        r_of_state[i] = references[i];
    return state;
}

static const lqg_servo_state_t nothing = {NULL, NULL, NULL, NULL, NULL};

static void expect(const lqg_real *found, lqg_real first, lqg_real second)
{
    TEST_ASSERT_TRUE(found[0] == first);
    TEST_ASSERT_TRUE(found[1] == second);
}

static void expect_nothing_behind(const state_t *s)
{
    TEST_ASSERT_TRUE(s->xi[1] == 77 && s->error[1] == 77);
    TEST_ASSERT_TRUE(s->demand[NU] == 77 && s->u_applied[NU] == 77 && s->u[NU] == 77);
}

static lqg_status_t control(const lqg_servo_t *servo, state_t *s, const lqg_real *references)
{
    lqg_servo_state_t state = over(s, references);
    const lqg_status_t status = lqg_servo_control(servo, &state, x, s->u);
    expect_nothing_behind(s);
    return status;
}

static lqg_status_t advance(const lqg_servo_t *servo, state_t *s, lqg_real u_0, lqg_real u_1)
{
    const lqg_real u[NU] = {u_0, u_1};
    lqg_servo_state_t state = over(s, NULL);
    const lqg_status_t status = lqg_servo_advance(servo, &state, u);
    expect_nothing_behind(s);
    return status;
}

static lqg_status_t set_input(const lqg_servo_t *servo, state_t *s, const lqg_real *references, lqg_real u_0,
                              lqg_real u_1)
{
    const lqg_real u[NU] = {u_0, u_1};
    lqg_servo_state_t state = over(s, references);
    const lqg_status_t status = lqg_servo_set_input(servo, &state, x, u);
    expect_nothing_behind(s);
    return status;
}

static void observe(const lqg_servo_t *servo, state_t *s, const lqg_real references[], const lqg_real y[])
{
    lqg_servo_state_t state = over(s, references);
    lqg_servo_observe(servo, &state, y);
    expect_nothing_behind(s);
}

static void expect_begun_anew(const state_t *s)
{
    TEST_ASSERT_TRUE(s->xi[0] == 0 && s->error[0] == 0);
    expect(s->demand, 0, 0);
    expect(s->u_applied, 0, 0);
}

/* ---- init and observe ------------------------------------------------------------------------------------------- */

static void test_init_is_zero_and_no_further_than_its_arrays(void)
{
    state_t s = some;
    lqg_servo_state_t state = over(&s, r);
    lqg_servo_init(&integral, &state);
    expect_begun_anew(&s);
    expect(state.r, 0, 0);
    expect_nothing_behind(&s);
}

static void test_init_needs_no_arrays_where_there_is_nothing_to_remember(void)
{
    state_t s = some;
    lqg_servo_state_t state = nothing;
    lqg_servo_init(&without_integral, &state);
    state.u_applied = s.u_applied;
    lqg_servo_init(&without_integral, &state);
    expect(s.u_applied, 0, 0);
}

static void test_observe_takes_the_output_and_the_reference_of_the_integral(void)
{
    const lqg_real y[NY] = {100, 200, 3};
    state_t s = some;
    observe(&integral, &s, r, y);
    TEST_ASSERT_TRUE(s.error[0] == -5);
    expect_nothing_behind(&s);
}

static void test_observe_leaves_out_what_is_not_finite(void)
{
    const lqg_real bad[] = {(lqg_real)NAN, (lqg_real)INFINITY, -(lqg_real)INFINITY};
    for (unsigned i = 0; i < sizeof bad / sizeof *bad; i++) {
        const lqg_real y[NY] = {0, 0, bad[i]}, wanted[NR] = {0, bad[i]}, fine[NY] = {0};
        state_t s = some;
        observe(&integral, &s, r, y);
        TEST_ASSERT_TRUE(s.error[0] == 0);
        s = some;
        observe(&integral, &s, wanted, fine);
        TEST_ASSERT_TRUE(s.error[0] == 0);
    }
}

static void test_observe_counts_an_error_below_its_limit_of_either_sign(void)
{
    static const lqg_real limit[] = {4};
    lqg_servo_t servo = integral;
    servo.error_limit = limit;
    for (lqg_real sign = -1; sign <= 1; sign += 2) {
        const lqg_real inside[NY] = {0, 0, -2 + sign * 3.5f}, at[NY] = {0, 0, -2 + sign * 4};
        state_t s = some;
        observe(&servo, &s, r, inside);
        TEST_ASSERT_TRUE(s.error[0] == -sign * 3.5f);
        observe(&servo, &s, r, at);
        TEST_ASSERT_TRUE(s.error[0] == 0);
    }
}

static void test_memory_of_the_macro_holds_a_state_without_overlap(void)
{
    LQG_SERVO_STATE(state, NU, NR, 1);
    state_t s = some;
    lqg_real u[NU];
    lqg_servo_init(&integral, &state);
    state.r[0] = r[0], state.r[1] = r[1];
    state.xi[0] = s.xi[0], state.error[0] = s.error[0];
    TEST_ASSERT_EQUAL_HEX(control(&integral, &s, r), lqg_servo_control(&integral, &state, x, u));
    expect(u, s.u[0], s.u[1]);
    TEST_ASSERT_EQUAL_HEX(advance(&integral, &s, 3, 1), lqg_servo_advance(&integral, &state, (lqg_real[]){3, 1}));
    TEST_ASSERT_TRUE(state.xi[0] == s.xi[0]);
    expect(state.r, r[0], r[1]);
    expect(state.demand, 3, 1);
    expect(state.u_applied, 3, 1);
}

/* ---- control ---------------------------------------------------------------------------------------------------- */

static void test_control_is_minus_K_z_plus_Nbar_r_of_every_input(void)
{
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, control(&integral, &s, r));
    expect(s.u, -2, -8.5f);
    expect(s.demand, -2, -8.5f);
    expect(s.u_applied, 4, -8);
}

static void test_control_without_Nbar_hears_r_by_the_integral_alone(void)
{
    lqg_servo_t servo = integral;
    state_t s = some;
    servo.Nbar = NULL;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, control(&servo, &s, r));
    expect(s.u, -3, 0.5f);
}

static void test_control_gives_a_change_on_top_of_the_last_input(void)
{
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, control(&change, &s, r));
    expect(s.u, 2, -11.5f);
}

static void test_control_without_integral_needs_no_memory(void)
{
    static const lqg_real K_of_x[] = {1, 2, 0.5f, -1};
    lqg_servo_t servo = without_integral;
    lqg_servo_state_t state = nothing;
    lqg_real u[NU];
    servo.K = K_of_x;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_servo_control(&servo, &state, x, u));
    expect(u, -5, 1.5f);
}

static void test_a_reference_that_is_not_finite_counts_as_zero_each_by_itself(void)
{
    const lqg_real first[NR] = {(lqg_real)NAN, -2}, second[NR] = {1, (lqg_real)INFINITY};
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_REFERENCE_NOT_FINITE, control(&integral, &s, first));
    expect(s.u, -4, -7.5f);
    TEST_ASSERT_EQUAL_HEX(LQG_REFERENCE_NOT_FINITE, control(&integral, &s, second));
    expect(s.u, -1, -0.5f);
}

static void test_a_law_that_is_not_finite_gives_zero_and_says_so(void)
{
    const lqg_real bad[] = {(lqg_real)NAN, (lqg_real)INFINITY, -(lqg_real)INFINITY};
    for (unsigned i = 0; i < sizeof bad / sizeof *bad; i++) {
        state_t s = some;
        s.xi[0] = bad[i];
        TEST_ASSERT_EQUAL_HEX(LQG_INPUT_LIMITED, control(&integral, &s, r));
        expect(s.u, 0, 0);
        expect(s.demand, 0, 0);
    }
}

/* The law asks for −2 and −8.5. */
static void expect_limited(const lqg_servo_t *servo, lqg_status_t status, lqg_real u_0, lqg_real u_1)
{
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(status, control(servo, &s, r));
    expect(s.u, u_0, u_1);
    expect(s.demand, -2, -8.5f);
}

static void test_each_input_has_its_own_limits_on_either_side(void)
{
    static const lqg_real low[] = {-1, -9}, high[] = {1, 9}, lower[] = {-9, -30}, upper[] = {-3, -8.75f};
    lqg_servo_t servo = integral;
    servo.u_min = low, servo.u_max = high;
    expect_limited(&servo, LQG_INPUT_LIMITED, -1, -8.5f);
    servo.u_min = lower, servo.u_max = upper;
    expect_limited(&servo, LQG_INPUT_LIMITED, -3, -8.75f);
    servo.u_min = NULL;
    expect_limited(&servo, LQG_INPUT_LIMITED, -3, -8.75f);
    servo.u_min = low, servo.u_max = NULL;
    expect_limited(&servo, LQG_INPUT_LIMITED, -1, -8.5f);
}

static void test_on_its_limit_an_input_is_not_limited(void)
{
    static const lqg_real at[] = {-2, -8.5f};
    lqg_servo_t servo = integral;
    servo.u_min = servo.u_max = at;
    expect_limited(&servo, LQG_OK, -2, -8.5f);
    servo.u_min = NULL;
    expect_limited(&servo, LQG_OK, -2, -8.5f);
    servo.u_min = at, servo.u_max = NULL;
    expect_limited(&servo, LQG_OK, -2, -8.5f);
}

/* The last input was 4 and −8. */
static void test_the_rate_limit_counts_from_the_last_input_of_each(void)
{
    static const lqg_real step[] = {2, 0.25f}, exact[] = {6, 0.5f}, other_way[] = {1, 1};
    state_t s = some;
    lqg_servo_t servo = integral;
    servo.u_step = step;
    expect_limited(&servo, LQG_INPUT_LIMITED, 2, -8.25f);
    servo.u_step = exact;
    expect_limited(&servo, LQG_OK, -2, -8.5f);
    servo.u_step = other_way;
    s.u_applied[0] = -20, s.u_applied[1] = -20;
    TEST_ASSERT_EQUAL_HEX(LQG_INPUT_LIMITED, control(&servo, &s, r));
    expect(s.u, -19, -19);
}

static void test_limits_win_over_the_rate_limit(void)
{
    static const lqg_real step[] = {2, 0.25f}, low[] = {-30, -30}, high[] = {1.5f, -9};
    lqg_servo_t servo = integral;
    servo.u_step = step, servo.u_min = low, servo.u_max = high;
    expect_limited(&servo, LQG_INPUT_LIMITED, 1.5f, -9);
}

static void test_a_limited_input_is_told_whichever_it_is_and_whichever_limit(void)
{
    static const lqg_real step[] = {6, 0.25f}, low[] = {-2, -30}, high[] = {9, 9};
    lqg_servo_t servo = integral;
    servo.u_step = step, servo.u_min = low, servo.u_max = high;
    expect_limited(&servo, LQG_INPUT_LIMITED, -2, -8.25f); /* by its rate alone, the second one alone */
}

/* ---- advance ---------------------------------------------------------------------------------------------------- */

/* ξ + H (u − v) + T (r − y) = 0.5 + 0.25 (3 + 1) − 0.5 (1 − 3) + 0.5 · 0.25 */
static void test_advance_corrects_the_integral_by_what_was_applied(void)
{
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, advance(&integral, &s, 3, 1));
    TEST_ASSERT_TRUE(s.xi[0] == 2.625f);
    TEST_ASSERT_TRUE(s.error[0] == 0);
    expect(s.demand, 3, 1);
    expect(s.u_applied, 3, 1);
}

static void test_advance_twice_counts_neither_error_nor_correction_again(void)
{
    state_t s = some;
    (void)advance(&integral, &s, 3, 1);
    TEST_ASSERT_EQUAL_HEX(LQG_OK, advance(&integral, &s, 3, 1));
    TEST_ASSERT_TRUE(s.xi[0] == 2.625f);
}

static void test_advance_without_a_last_input_to_keep(void)
{
    state_t s = some;
    const lqg_real u[NU] = {3, 1}, bad[NU] = {(lqg_real)NAN, 1};
    lqg_servo_state_t state = over(&s, NULL), none = nothing;
    state.u_applied = NULL;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_servo_advance(&integral, &state, u));
    TEST_ASSERT_TRUE(s.xi[0] == 2.625f);
    expect(s.u_applied, 4, -8);
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_servo_advance(&without_integral, &none, bad));
}

static void test_advance_without_integral_keeps_the_input_alone(void)
{
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, advance(&without_integral, &s, 3, 1));
    expect(s.u_applied, 3, 1);
    expect(s.demand, -1, 3);
    TEST_ASSERT_TRUE(s.xi[0] == 0.5f);
}

static void test_advance_begins_anew_when_an_input_is_not_finite(void)
{
    const lqg_real bad[] = {(lqg_real)NAN, (lqg_real)INFINITY, -(lqg_real)INFINITY};
    for (unsigned i = 0; i < sizeof bad / sizeof *bad; i++) {
        state_t s = some;
        TEST_ASSERT_EQUAL_HEX(LQG_STATE_RESET, advance(&integral, &s, bad[i], 1));
        expect_begun_anew(&s);
        s = some;
        TEST_ASSERT_EQUAL_HEX(LQG_STATE_RESET, advance(&integral, &s, 1, bad[i]));
        expect_begun_anew(&s);
        s = some;
        TEST_ASSERT_EQUAL_HEX(LQG_STATE_RESET, advance(&without_integral, &s, 1, bad[i]));
        expect(s.u_applied, 0, 0);
    }
}

static void test_advance_begins_anew_at_the_bound_of_the_integral(void)
{
    static const lqg_real scale[] = {0.25f};
    lqg_servo_t servo = integral;
    state_t s = some;
    servo.xi_scale = scale;
    s.error[0] = 6; /* 0.5 + 0.5 · 6 = 3.5 */
    TEST_ASSERT_EQUAL_HEX(LQG_OK, advance(&servo, &s, -1, 3));
    TEST_ASSERT_TRUE(s.xi[0] == 3.5f);
    s.error[0] = 1; /* at 4 */
    TEST_ASSERT_EQUAL_HEX(LQG_STATE_RESET, advance(&servo, &s, -1, 3));
    expect_begun_anew(&s);
}

/* {0.5, −2} + H (u − v) + T (r − y) with u − v = {4, −2} */
static void test_advance_takes_its_own_row_of_H_for_each_integral(void)
{
    static const lqg_real H_two[] = {0.25f, -0.5f, 2, 1};
    const lqg_servo_t servo = {.nx = NX, .nu = NU, .nr = NR, .nxi = 2, .T = 0.5f, .H = H_two};
    lqg_real xi[] = {0.5f, -2}, error[] = {0.25f, 8}, demand[] = {-1, 3};
    lqg_servo_state_t state = {NULL, xi, error, demand, NULL};
    const lqg_real u[NU] = {3, 1};
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_servo_advance(&servo, &state, u));
    expect(xi, 2.625f, 8);
    expect(error, 0, 0);
}

/* ---- set_input -------------------------------------------------------------------------------------------------- */

/* H_input for a law that one ξ can lead to any u of one input: −Kξ⁺. H is another one. */
static void test_after_set_input_the_law_goes_on_at_that_input(void)
{
    static const lqg_real K_one[] = {1, 2, -4}, H_one[] = {7}, H_input[] = {0.25f};
    const lqg_real u[1] = {10};
    const lqg_servo_t servo = {.nx = NX,
                               .nu = 1,
                               .nr = NR,
                               .nxi = 1,
                               .T = 1,
                               .K = K_one,
                               .Nbar = Nbar,
                               .H = H_one,
                               .H_input = H_input,
                               .output = output,
                               .reference = reference};
    state_t s = some;
    lqg_real next[1];
    lqg_servo_state_t state = over(&s, r);
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_servo_set_input(&servo, &state, x, u));
    TEST_ASSERT_TRUE(s.xi[0] == 3.5f); /* 0.5 + 0.25 (10 + 2) */
    TEST_ASSERT_TRUE(s.demand[0] == 10 && s.u_applied[0] == 10);
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_servo_control(&servo, &state, x, next));
    TEST_ASSERT_TRUE(next[0] == 10);
    TEST_ASSERT_TRUE(s.error[0] == 0.25f);
}

/* v = {−2, −8.5}: ξ = 0.5 + 0.25 (2 + 2) − 0.5 (−6.5 + 8.5) */
static void test_set_input_corrects_the_integral_by_all_inputs(void)
{
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, set_input(&integral, &s, r, 2, -6.5f));
    TEST_ASSERT_TRUE(s.xi[0] == 0.5f);
    expect(s.demand, 2, -6.5f);
    expect(s.u_applied, 2, -6.5f);
}

/* The last input is the one that was set: v = u − K z + Nbar r = {8 − 3 − (4 + 4) + 1, 16 + 0.5 − (−8 + 2) − 9}. */
static void test_set_input_of_a_law_of_changes_begins_with_that_input(void)
{
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, set_input(&change, &s, r, 8, 16));
    TEST_ASSERT_TRUE(s.xi[0] == 0.5f + 0.25f * 10 - 0.5f * 2.5f);
    expect(s.u_applied, 8, 16);
}

static void test_set_input_tells_of_a_reference_that_is_not_finite(void)
{
    const lqg_real bad[NR] = {(lqg_real)INFINITY, -2};
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_REFERENCE_NOT_FINITE, set_input(&integral, &s, bad, 2, -6.5f));
    TEST_ASSERT_TRUE(s.xi[0] == 0.5f + 0.25f * 6 - 0.5f * 1); /* v = {−4, −7.5} */
}

static void test_set_input_without_integral_keeps_the_input_alone(void)
{
    const lqg_real u[NU] = {3, 1};
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, set_input(&without_integral, &s, NULL, 3, 1));
    expect(s.u_applied, 3, 1);
    expect(s.demand, -1, 3);
    lqg_servo_state_t state = over(&s, r);
    state.u_applied = NULL;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_servo_set_input(&integral, &state, x, u));
    expect(s.u_applied, 3, 1);
}

static void test_set_input_begins_anew_when_the_input_or_the_integral_is_nowhere(void)
{
    static const lqg_real scale[] = {0.25f};
    lqg_servo_t servo = integral;
    state_t s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_STATE_RESET, set_input(&integral, &s, r, (lqg_real)NAN, 0));
    expect_begun_anew(&s);
    servo.xi_scale = scale;
    s = some;
    TEST_ASSERT_EQUAL_HEX(LQG_STATE_RESET, set_input(&servo, &s, r, 12, -8.5f)); /* 0.5 + 0.25 · 14 = 4 */
    expect_begun_anew(&s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_init_is_zero_and_no_further_than_its_arrays);
    RUN_TEST(test_init_needs_no_arrays_where_there_is_nothing_to_remember);
    RUN_TEST(test_observe_takes_the_output_and_the_reference_of_the_integral);
    RUN_TEST(test_observe_leaves_out_what_is_not_finite);
    RUN_TEST(test_observe_counts_an_error_below_its_limit_of_either_sign);
    RUN_TEST(test_memory_of_the_macro_holds_a_state_without_overlap);
    RUN_TEST(test_control_is_minus_K_z_plus_Nbar_r_of_every_input);
    RUN_TEST(test_control_without_Nbar_hears_r_by_the_integral_alone);
    RUN_TEST(test_control_gives_a_change_on_top_of_the_last_input);
    RUN_TEST(test_control_without_integral_needs_no_memory);
    RUN_TEST(test_a_reference_that_is_not_finite_counts_as_zero_each_by_itself);
    RUN_TEST(test_a_law_that_is_not_finite_gives_zero_and_says_so);
    RUN_TEST(test_each_input_has_its_own_limits_on_either_side);
    RUN_TEST(test_on_its_limit_an_input_is_not_limited);
    RUN_TEST(test_the_rate_limit_counts_from_the_last_input_of_each);
    RUN_TEST(test_limits_win_over_the_rate_limit);
    RUN_TEST(test_a_limited_input_is_told_whichever_it_is_and_whichever_limit);
    RUN_TEST(test_advance_corrects_the_integral_by_what_was_applied);
    RUN_TEST(test_advance_twice_counts_neither_error_nor_correction_again);
    RUN_TEST(test_advance_without_a_last_input_to_keep);
    RUN_TEST(test_advance_without_integral_keeps_the_input_alone);
    RUN_TEST(test_advance_takes_its_own_row_of_H_for_each_integral);
    RUN_TEST(test_advance_begins_anew_when_an_input_is_not_finite);
    RUN_TEST(test_advance_begins_anew_at_the_bound_of_the_integral);
    RUN_TEST(test_after_set_input_the_law_goes_on_at_that_input);
    RUN_TEST(test_set_input_corrects_the_integral_by_all_inputs);
    RUN_TEST(test_set_input_of_a_law_of_changes_begins_with_that_input);
    RUN_TEST(test_set_input_tells_of_a_reference_that_is_not_finite);
    RUN_TEST(test_set_input_without_integral_keeps_the_input_alone);
    RUN_TEST(test_set_input_begins_anew_when_the_input_or_the_integral_is_nowhere);
    return UNITY_END();
}
