/* SPDX-License-Identifier: MIT */
/* The filter with constant gain. */
#include <string.h>

#include <math.h>

#include "model.h"
#include "textbook.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

/* About 100 roundings a sample, each forgotten within about 20 samples; see test_kalman_online.c. */
#define TOLERANCE (1000 * EPSILON)

typedef struct {
    lqg_real L[MAX_NX * MAX_NY], M[MAX_NX * MAX_NY];
    lqg_kalman_steady_t kalman;
} steady_t;

/* The gains to which the textbook's filter settles; matrices shared with `model`'s rounded ones in `rounded`.
 * */
static void settle(const model_t *model, lqg_plant_t plant, steady_t *steady, textbook_t *textbook)
{
    const lqg_real u[MAX_NU] = {0}, y[MAX_NY] = {0};
    const unsigned nx = model->nx, ny = model->ny;
    int crossed = 0;

    textbook_init(model, textbook);
    for (unsigned sample = 0; sample < 3000; sample++) {
        textbook_update(model, textbook, y, u);
        textbook_predict(model, textbook, u);
    }
    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j < ny; j++) {
            double M_ij = 0;
            for (unsigned k = 0; k < ny; k++)
                M_ij += model->S[i * ny + k] * textbook->S_inverse[k * ny + j];
            steady->L[i * ny + j] = (lqg_real)textbook->L[i * ny + j];
            steady->M[i * ny + j] = (lqg_real)M_ij;
            crossed |= M_ij != 0;
        }
    const lqg_kalman_steady_t kalman = {plant, steady->L, crossed ? steady->M : NULL, NULL, NULL, NULL, NULL, NULL};
    steady->kalman = kalman;
}

/* C and D of the outputs as they are, not decorrelated. */
static lqg_plant_t rounded_plant(const model_t *model, online_t *to)
{
    const unsigned nx = model->nx, nu = model->nu, ny = model->ny;
    int direct = 0;
    prepare_online(model, to);
    for (unsigned i = 0; i < ny * nx; i++)
        to->C[i] = (lqg_real)model->C[i];
    for (unsigned i = 0; i < ny * nu; i++) {
        to->D[i] = (lqg_real)model->D[i];
        direct |= model->D[i] != 0;
    }
    const lqg_plant_t plant = {nx, nu, ny, to->A, nu ? to->B : NULL, to->C, direct ? to->D : NULL, NULL};
    return plant;
}

static void follow_settled_textbook(const model_t *model)
{
    online_t rounded;
    steady_t steady;
    textbook_t textbook;
    state_t s;
    double plant[MAX_NX] = {0};
    lqg_real u[MAX_NU] = {0}, y[MAX_NY];
    unsigned long seed = 7;
    double largest = 1;

    settle(model, rounded_plant(model, &rounded), &steady, &textbook);
    memset(textbook.x_prior, 0, sizeof textbook.x_prior);
    steady_init(&steady.kalman, &s);

    for (unsigned sample = 0; sample < 500; sample++) {
        simulate(model, plant, u, y, &seed);
        for (unsigned i = 0; i < model->nx; i++)
            largest = plant[i] > largest ? plant[i] : -plant[i] > largest ? -plant[i] : largest;

        textbook_update(model, &textbook, y, u);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, steady_update(&steady.kalman, &s, y));
        for (unsigned i = 0; i < model->nx; i++)
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * largest, textbook.x[i], (double)s.x[i]);

        u[0] = (lqg_real)noise(&seed);
        textbook_predict(model, &textbook, u);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, steady_predict(&steady.kalman, &s, u));
        for (unsigned i = 0; i < model->nx; i++)
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * largest, textbook.x_prior[i], (double)s.x[i]);
    }
}

static void test_steady_filter_is_the_settled_one_of_a_double_integrator(void)
{
    follow_settled_textbook(&double_integrator);
}

static void test_steady_filter_is_the_settled_one_when_u_reaches_the_outputs(void)
{
    follow_settled_textbook(&two_mass);
}

static void test_steady_filter_is_the_settled_one_when_outputs_are_correlated(void)
{
    follow_settled_textbook(&correlated);
}

static void test_steady_filter_is_the_settled_one_when_w_and_v_are_correlated(void)
{
    follow_settled_textbook(&cross_noise);
}

static void test_steady_filter_is_the_settled_one_with_one_state_and_no_input(void)
{
    follow_settled_textbook(&random_walk);
}

/* Small integers: every operation is exact. */
static const lqg_real A[4] = {1, 2, 0, 1}, B[2] = {1, 3}, C[4] = {1, 0, 1, 1}, D[2] = {2, 1};
static const lqg_real L[4] = {0.5f, 0.25f, -1, 2}, M[4] = {1, 0, 0, 2}, x0[2] = {1, -1};
static const lqg_kalman_steady_t exact = {{2, 1, 2, A, B, C, D, NULL}, L, M, x0, NULL, NULL, NULL, NULL};

/* The memory of `exact`. */
static lqg_real x[2], u_applied[1], innovation[2], work[LQG_KALMAN_STEADY_WORK(2, 2)];
static lqg_kalman_steady_state_t state = {x, u_applied, innovation, {NULL, NULL}, work};

static void test_update_and_predict_compute_their_equations(void)
{
    const lqg_real y[2] = {5, 3}, u[1] = {2};

    lqg_kalman_steady_init(&exact, &state);
    lqg_kalman_steady_update(&exact, &state, y);
    TEST_ASSERT_TRUE(innovation[0] == 5 - 1 && innovation[1] == 3 - 0);
    TEST_ASSERT_TRUE(x[0] == 1 + 0.5f * 4 + 0.25f * 3 && x[1] == -1 - 4 + 2 * 3);

    lqg_kalman_steady_predict(&exact, &state, u);
    TEST_ASSERT_TRUE(x[0] == 3.75f + 2 * 1 + 2 + 4 && x[1] == 1 + 3 * 2 + 2 * 3);
    TEST_ASSERT_TRUE(u_applied[0] == 2 && innovation[0] == 0 && innovation[1] == 0);

    /* from now on D u counts: y = C x + D u leaves x̂ where it is */
    const lqg_real expected[2] = {11.75f + 2 * 2, 11.75f + 13 + 2};
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_update(&exact, &state, expected));
    TEST_ASSERT_TRUE(x[0] == 11.75f && x[1] == 13);
}

static void test_update_by_one_output_takes_its_column_of_L_and_keeps_its_innovation(void)
{
    const lqg_real three = 3, five = 5;

    lqg_kalman_steady_init(&exact, &state);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_update_output(&exact, &state, &three, 1, NULL));
    TEST_ASSERT_TRUE(x[0] == 1 + 0.25f * 3 && x[1] == -1 + 2 * 3);
    TEST_ASSERT_TRUE(innovation[0] == 0 && innovation[1] == 3);

    lqg_kalman_steady_init(&exact, &state);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_update_output(&exact, &state, &five, 0, NULL));
    TEST_ASSERT_TRUE(x[0] == 1 + 0.5f * 4 && x[1] == -1 - 4);
    TEST_ASSERT_TRUE(innovation[0] == 4 && innovation[1] == 0);
}

static void test_update_by_one_output_needs_no_innovation_where_w_and_v_are_independent(void)
{
    const lqg_kalman_steady_t kalman = {{2, 1, 2, A, B, C, NULL, NULL}, L, NULL, x0, NULL, NULL, NULL, NULL};
    lqg_kalman_steady_state_t bare = {x, NULL, NULL, {NULL, NULL}, NULL};
    const lqg_real three = 3;

    lqg_kalman_steady_init(&kalman, &bare);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_update_output(&kalman, &bare, &three, 1, NULL));
    TEST_ASSERT_TRUE(x[0] == 1.75f && x[1] == 5);
}

static void test_update_by_one_output_tells_all_that_happened(void)
{
    const lqg_real missing = (lqg_real)NAN, three = 3;

    lqg_kalman_steady_init(&exact, &state);
    TEST_ASSERT_EQUAL_HEX(REJECTED(1), lqg_kalman_steady_update_output(&exact, &state, &missing, 1, NULL));
    TEST_ASSERT_TRUE(x[0] == 1 && x[1] == -1 && innovation[1] == 0);
    x[0] = (lqg_real)NAN;
    TEST_ASSERT_EQUAL_HEX(REJECTED(1) | LQG_STATE_RESET,
                          lqg_kalman_steady_update_output(&exact, &state, &three, 1, NULL));
    TEST_ASSERT_TRUE(x[0] == 1 && x[1] == -1);
}

static void test_predict_takes_the_kept_input_itself(void)
{
    lqg_kalman_steady_init(&exact, &state);
    u_applied[0] = 2;
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_predict(&exact, &state, u_applied));
    TEST_ASSERT_TRUE(x[0] == 1 - 2 + 2 && x[1] == -1 + 6 && u_applied[0] == 2);
}

static void test_init_without_x0_begins_at_zero(void)
{
    const lqg_kalman_steady_t kalman = {{2, 1, 2, A, B, C, NULL, NULL}, L, NULL, NULL, NULL, NULL, NULL, NULL};
    x[0] = x[1] = 7;
    lqg_kalman_steady_init(&kalman, &state);
    TEST_ASSERT_TRUE(x[0] == 0 && x[1] == 0);
}

/* One output more than the status has bits for, each with a state of its own. */
static void test_status_tells_which_outputs_are_rejected_and_the_last_bit_is_of_all_the_others(void)
{
    enum { N = 9 };
    static lqg_real identity[N * N], y[N];
    static const lqg_kalman_steady_t many = {
        {N, 0, N, identity, NULL, identity, NULL, NULL}, identity, NULL, NULL, NULL, NULL, NULL, NULL};
    LQG_KALMAN_STEADY_STATE(states, N, 0, N);

    for (unsigned i = 0; i < N; i++)
        identity[i * N + i] = 1;
    lqg_kalman_steady_init(&many, &states);
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_kalman_steady_update(&many, &states, y));
    for (unsigned i = 0; i < N; i++) {
        y[i] = (lqg_real)INFINITY;
        TEST_ASSERT_EQUAL_HEX(1u | 0x100u << (i < 7 ? i : 7), lqg_kalman_steady_update(&many, &states, y));
        y[i] = 0;
    }
    y[2] = y[5] = (lqg_real)NAN;
    TEST_ASSERT_EQUAL_HEX(REJECTED(2) | REJECTED(5), lqg_kalman_steady_update(&many, &states, y));
}

/* 33 outputs: only those with a bit can be left out. */
static void test_outputs_beyond_the_bits_of_used_are_always_used(void)
{
    enum { N = 34 };
    static lqg_real identity[N * N], y[N];
    static const lqg_kalman_steady_t many = {
        {N, 0, N, identity, NULL, identity, NULL, NULL}, identity, NULL, NULL, NULL, NULL, NULL, NULL};
    LQG_KALMAN_STEADY_STATE(states, N, 0, N);

    for (unsigned i = 0; i < N; i++) {
        identity[i * N + i] = 1;
        y[i] = 1;
    }
    lqg_kalman_steady_init(&many, &states);
    TEST_ASSERT_EQUAL_HEX(LQG_OK, lqg_kalman_steady_partial_update(&many, &states, y, 1ul << 31 | 1ul << 3, NULL));
    for (unsigned i = 0; i < N; i++)
        TEST_ASSERT_TRUE(states.x[i] == (i == 3 || i >= 31 ? 1 : 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_steady_filter_is_the_settled_one_of_a_double_integrator);
    RUN_TEST(test_steady_filter_is_the_settled_one_when_u_reaches_the_outputs);
    RUN_TEST(test_steady_filter_is_the_settled_one_when_outputs_are_correlated);
    RUN_TEST(test_steady_filter_is_the_settled_one_when_w_and_v_are_correlated);
    RUN_TEST(test_steady_filter_is_the_settled_one_with_one_state_and_no_input);
    RUN_TEST(test_update_and_predict_compute_their_equations);
    RUN_TEST(test_update_by_one_output_takes_its_column_of_L_and_keeps_its_innovation);
    RUN_TEST(test_update_by_one_output_needs_no_innovation_where_w_and_v_are_independent);
    RUN_TEST(test_update_by_one_output_tells_all_that_happened);
    RUN_TEST(test_predict_takes_the_kept_input_itself);
    RUN_TEST(test_init_without_x0_begins_at_zero);
    RUN_TEST(test_status_tells_which_outputs_are_rejected_and_the_last_bit_is_of_all_the_others);
    RUN_TEST(test_outputs_beyond_the_bits_of_used_are_always_used);
    return UNITY_END();
}
