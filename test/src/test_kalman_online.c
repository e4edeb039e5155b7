/* SPDX-License-Identifier: MIT */
/* The filters that carry P, against the textbook and against each other. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "model.h"
#include "textbook.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

/* A sample makes about 100 roundings of half an EPSILON of the largest entry at most; a filter forgets them
 * in about 20 samples, as its slowest pole is below 0.95. */
#define TOLERANCE (1000 * EPSILON)

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Both filters and the textbook, with the same y and u. */
typedef struct {
    online_t online;
    state_t plain, ud;
    textbook_t textbook;
    double plant[MAX_NX];
    lqg_real u[MAX_NU];
    unsigned long seed;
} run_t;

static void begin_run(run_t *run, const model_t *model)
{
    state_t *plain = &run->plain, *ud = &run->ud;
    memset(run, 0, sizeof *run);
    run->seed = 1;
    prepare_online(model, &run->online);
    plain_init(&run->online.plain, plain);
    ud_init(&run->online.ud, ud);
    textbook_init(model, &run->textbook);
}

static void update_all(run_t *run, const model_t *model)
{
    state_t *plain = &run->plain, *ud = &run->ud;
    lqg_real y[MAX_NY];
    simulate(model, run->plant, run->u, y, &run->seed);
    textbook_update(model, &run->textbook, y, run->u);
    lqg_status_t status = plain_update(&run->online.plain, plain, y);
    status |= ud_update(&run->online.ud, ud, y);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, status);
}

static void predict_all(run_t *run, const model_t *model)
{
    state_t *plain = &run->plain, *ud = &run->ud;
    run->u[0] = (lqg_real)noise(&run->seed);
    textbook_predict(model, &run->textbook, run->u);
    lqg_status_t status = plain_predict(&run->online.plain, plain, run->u);
    status |= ud_predict(&run->online.ud, ud, run->u);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, status);
}

static void compare_all(const run_t *run, unsigned nx, const double x[], const double P[], double largest_x,
                        double largest_P)
{
    for (unsigned i = 0; i < nx; i++) {
        TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * largest_x, x[i], (double)run->plain.x[i]);
        TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * largest_x, x[i], (double)run->ud.x[i]);
        for (unsigned j = 0; j <= i; j++) {
            const double P_ij = P[i * nx + j];
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * largest_P, P_ij, (double)run->plain.P[LQG_TRIANGLE(i) + j]);
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * largest_P, P_ij, ud_covariance(run->ud.U, run->ud.d, nx, i, j));
        }
    }
}

static void follow_textbook(const model_t *model)
{
    run_t run;
    const unsigned nx = model->nx;
    double largest_x = 1, largest_P = 1;

    begin_run(&run, model);
    for (unsigned sample = 0; sample < 500; sample++) {
        for (unsigned i = 0; i < nx; i++) {
            largest_x = larger(largest_x, fabs(run.plant[i]));
            largest_P = larger(largest_P, run.textbook.P_prior[i * nx + i]);
        }
        update_all(&run, model);
        compare_all(&run, nx, run.textbook.x, run.textbook.P, largest_x, largest_P);
        predict_all(&run, model);
        compare_all(&run, nx, run.textbook.x_prior, run.textbook.P_prior, largest_x, largest_P);
    }
}

static void test_online_filters_follow_the_textbook_on_a_double_integrator(void)
{
    follow_textbook(&double_integrator);
}

static void test_online_filters_follow_the_textbook_when_u_reaches_the_outputs(void)
{
    follow_textbook(&two_mass);
}

static void test_online_filters_follow_the_textbook_when_outputs_are_correlated(void)
{
    follow_textbook(&correlated);
}

static void test_online_filters_follow_the_textbook_when_w_and_v_are_correlated(void)
{
    follow_textbook(&cross_noise);
}

static void test_online_filters_follow_the_textbook_with_one_state_and_no_input(void)
{
    follow_textbook(&random_walk);
}

/* The smallest pivot of P = U diag(pivots) Uᵀ, in double. */
static double smallest_pivot(const lqg_real P[], unsigned n)
{
    double left[MAX_NX][MAX_NX], smallest = INFINITY;
    for (unsigned i = 0; i < n; i++)
        for (unsigned j = 0; j <= i; j++)
            left[i][j] = left[j][i] = (double)P[LQG_TRIANGLE(i) + j];
    for (unsigned j = n; j-- > 0;) {
        smallest = left[j][j] < smallest ? left[j][j] : smallest;
        for (unsigned i = 0; i < j; i++)
            for (unsigned k = 0; k < j; k++)
                left[i][k] -= left[i][j] * left[j][k] / left[j][j];
    }
    return smallest;
}

static void stay_positive(const model_t *model)
{
    run_t run;
    begin_run(&run, model);
    for (unsigned sample = 0; sample < 20000; sample++) {
        update_all(&run, model);
        TEST_ASSERT_TRUE(smallest_pivot(run.plain.P, model->nx) > 0);
        predict_all(&run, model);
        TEST_ASSERT_TRUE(smallest_pivot(run.plain.P, model->nx) > 0);
        for (unsigned i = 0; i < model->nx; i++)
            TEST_ASSERT_TRUE(run.ud.d[i] > 0);
    }
}

static void test_P_stays_positive_definite_in_long_runs(void)
{
    stay_positive(&double_integrator);
    stay_positive(&two_mass);
    stay_positive(&correlated);
    stay_positive(&cross_noise);
    stay_positive(&random_walk);
}

/* After Grewal & Andrews, Kalman Filtering, chapter 6: two outputs that say almost the same, almost without
 * noise. With P0 = I, C = [1 1; 1 1+ε], V = δ² I the posterior is δ² (δ² I + CᵀC)⁻¹, of which no entry is a
 * difference: det(δ² I + CᵀC) = δ⁴ + δ² (4 + 2ε + ε²) + ε². */
static void test_ud_keeps_P_positive_where_plain_loses_it(void)
{
    const lqg_real epsilon = (lqg_real)(sizeof(lqg_real) == sizeof(float) ? 0x1p-9 : 0x1p-23);
    const lqg_real V = EPSILON * EPSILON, V2[2] = {V, V}, C[4] = {1, 1, 1, 1 + epsilon}, A[4] = {1, 0, 0, 1};
    const lqg_real zero[4] = {0}, one[2] = {1, 1}, P0[3] = {1, 0, 1}, y[2] = {0};
    const lqg_plant_t plant = {2, 0, 2, A, NULL, C, NULL, NULL};
    const lqg_kalman_plain_t plain = {plant, NULL, V2, zero, NULL, NULL, NULL, P0, NULL, NULL, NULL};
    const lqg_kalman_ud_t ud = {plant, NULL, V2, 0, NULL, NULL, NULL, NULL, NULL, zero, one, NULL, NULL, NULL};
    state_t s;

    plain_init(&plain, &s);
    plain_update(&plain, &s, y);
    TEST_ASSERT_TRUE(smallest_pivot(s.P, 2) <= 0);

    ud_init(&ud, &s);
    ud_update(&ud, &s, y);
    const double e = (double)epsilon, v = (double)V;
    const double determinant = v * v + v * (4 + 2 * e + e * e) + e * e;
    const double P_00 = v * (v + 1 + (1 + e) * (1 + e)) / determinant, P_11 = v * (v + 2) / determinant;
    TEST_ASSERT_TRUE(s.d[0] > 0 && s.d[1] > 0);
    /* a rounding of C is an error of EPSILON/ε in the difference of its rows */
    TEST_ASSERT_DOUBLE_WITHIN(10 * EPSILON / e * P_00, P_00, ud_covariance(s.U, s.d, 2, 0, 0));
    TEST_ASSERT_DOUBLE_WITHIN(10 * EPSILON / e * P_11, P_11, ud_covariance(s.U, s.d, 2, 1, 1));
}

/* d of a state without noise that dies out sinks through the smallest normal numbers, where 1/d overflows. */
static void test_ud_goes_on_when_the_variance_of_a_state_dies_out(void)
{
    const lqg_real A[4] = {1, 0, 0, 0.5f}, C[2] = {1, 1}, V[1] = {1}, G[2] = {1, 0}, W[1] = {0.5f};
    const lqg_real U0[1] = {0}, d0[2] = {1, 1}, y[1] = {1};
    const lqg_kalman_ud_t kalman = {
        {2, 0, 1, A, NULL, C, NULL, NULL}, NULL, V, 1, G, W, NULL, NULL, NULL, U0, d0, NULL, NULL, NULL};
    state_t s;

    ud_init(&kalman, &s);
    for (unsigned sample = 0; sample < 2000; sample++) {
        TEST_ASSERT_EQUAL_UINT(LQG_OK, ud_update(&kalman, &s, y));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, ud_predict(&kalman, &s, NULL));
    }
    TEST_ASSERT_TRUE(s.d[1] == 0);
    TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, 1, (double)s.x[0]);
}

static void test_init_copies_the_description(void)
{
    run_t run;
    begin_run(&run, &correlated);
    for (unsigned i = 0; i < 3; i++) {
        TEST_ASSERT_TRUE(run.plain.x[i] == (lqg_real)correlated.x0[i]);
        TEST_ASSERT_TRUE(run.ud.x[i] == (lqg_real)correlated.x0[i]);
        for (unsigned j = 0; j <= i; j++) {
            const double P_ij = correlated.P0[i * 3 + j];
            TEST_ASSERT_TRUE(run.plain.P[LQG_TRIANGLE(i) + j] == (lqg_real)P_ij);
            TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, P_ij, ud_covariance(run.ud.U, run.ud.d, 3, i, j));
        }
    }
}

/* Three outputs and an E whose entries below the diagonal differ, against E y without an E: both sums are exact. */
static void test_E_mixes_each_output_with_those_before_it(void)
{
    static const lqg_real one[1] = {1}, C[3] = {1, 2, 0.5f}, V[3] = {1, 2, 4};
    static const lqg_real E[9] = {1, 0, 0, 0.5f, 1, 0, 0.25f, -2, 1};
    const lqg_real y[3] = {3, -1, 8}, mixed[3] = {3, 0.5f, 10.75f};
    const lqg_kalman_ud_t with = {.plant = {1, 0, 3, one, NULL, C, NULL, NULL}, .E = E, .V = V, .d0 = one};
    lqg_kalman_ud_t without = with;
    LQG_KALMAN_UD_STATE(one_by_E, 1, 0, 3, 0);
    LQG_KALMAN_UD_STATE(one_by_hand, 1, 0, 3, 0);

    without.E = NULL;
    lqg_kalman_ud_init(&with, &one_by_E);
    lqg_kalman_ud_init(&without, &one_by_hand);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_ud_update(&with, &one_by_E, y));
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_ud_update(&without, &one_by_hand, mixed));
    TEST_ASSERT_TRUE(one_by_E.x[0] == one_by_hand.x[0] && one_by_E.d[0] == one_by_hand.d[0] && one_by_E.x[0] != 0);
}

/* 1/d is not finite for a d that small: U says that its state has nothing in common with the others. */
static void test_variance_too_small_to_divide_by_is_that_of_a_state_by_itself(void)
{
    static const lqg_real identity[4] = {1, 0, 0, 1}, C[2] = {1, 0}, V[1] = {1}, G[2] = {1, 1};
    static const lqg_real d0[2] = {1, 0}, U0[1] = {0};
    const lqg_real tiny = (sizeof(lqg_real) == sizeof(float) ? (lqg_real)FLT_MIN : (lqg_real)DBL_MIN) / 16;
    const lqg_kalman_ud_t kalman = {
        .plant = {2, 0, 1, identity, NULL, C, NULL, NULL}, .V = V, .nw = 1, .G = G, .W = &tiny, .U0 = U0, .d0 = d0};
    state_t s;

    ud_init(&kalman, &s);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, ud_predict(&kalman, &s, NULL));
    TEST_ASSERT_TRUE(s.d[1] == tiny && s.U[0] == 0 && s.d[0] == 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_online_filters_follow_the_textbook_on_a_double_integrator);
    RUN_TEST(test_online_filters_follow_the_textbook_when_u_reaches_the_outputs);
    RUN_TEST(test_online_filters_follow_the_textbook_when_outputs_are_correlated);
    RUN_TEST(test_online_filters_follow_the_textbook_when_w_and_v_are_correlated);
    RUN_TEST(test_online_filters_follow_the_textbook_with_one_state_and_no_input);
    RUN_TEST(test_P_stays_positive_definite_in_long_runs);
    RUN_TEST(test_ud_keeps_P_positive_where_plain_loses_it);
    RUN_TEST(test_ud_goes_on_when_the_variance_of_a_state_dies_out);
    RUN_TEST(test_init_copies_the_description);
    RUN_TEST(test_E_mixes_each_output_with_those_before_it);
    RUN_TEST(test_variance_too_small_to_divide_by_is_that_of_a_state_by_itself);
    return UNITY_END();
}
