/* SPDX-License-Identifier: MIT */
/* Recursive least squares against the batch solution, and against what drives it to its limits. */
#include <math.h>
#include <string.h>

#include "model.h"
#include "lqg/rls.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { MAX_NTHETA = 6, SAMPLES = 300 };

/* Rounding errors of up to 300 samples, about ten each, of a problem whose condition stays below 10. */
#define TOLERANCE (30000 * EPSILON)

/* A state as arrays that can be compared and copied. */
typedef struct {
    lqg_real theta[MAX_NTHETA], U[LQG_RLS_U(MAX_NTHETA)], d[MAX_NTHETA];
} rls_arrays_t;

static const lqg_real P0[MAX_NTHETA] = {2, 1, 4, 0.5f, 1, 3};
static const lqg_real theta0[MAX_NTHETA] = {0.5f, -1, 0, 0.25f, 1, -0.5f};

static lqg_status_t update(const lqg_rls_t *rls, rls_arrays_t *s, const lqg_real phi[], lqg_real y)
{
    lqg_real work[MAX_NTHETA];
    lqg_rls_state_t state = {s->theta, s->U, s->d, work};
    return lqg_rls_update(rls, &state, y, phi);
}

static rls_arrays_t begun(const lqg_rls_t *rls)
{
    rls_arrays_t s;
    lqg_rls_state_t state = {s.theta, s.U, s.d, NULL};
    memset(&s, 0, sizeof s);
    lqg_rls_init(rls, &state);
    return s;
}

/* The normal equations: information · θ = vector, P = information⁻¹. */
typedef struct {
    double information[MAX_NTHETA][MAX_NTHETA], vector[MAX_NTHETA];
} batch_t;

static void begin_batch(const lqg_rls_t *rls, batch_t *batch)
{
    memset(batch, 0, sizeof *batch);
    for (unsigned i = 0; i < rls->ntheta; i++) {
        batch->information[i][i] = 1 / (double)P0[i];
        batch->vector[i] = (double)theta0[i] / (double)P0[i];
    }
}

static void add_to_batch(const lqg_rls_t *rls, batch_t *batch, const lqg_real phi[], lqg_real y)
{
    for (unsigned i = 0; i < rls->ntheta; i++) {
        batch->vector[i] = (double)rls->forgetting * batch->vector[i] + (double)phi[i] * (double)y / (double)rls->V;
        for (unsigned j = 0; j < rls->ntheta; j++)
            batch->information[i][j] =
                (double)rls->forgetting * batch->information[i][j] + (double)phi[i] * (double)phi[j] / (double)rls->V;
    }
}

/* right ← information⁻¹ right, by Gaussian elimination: information is positive definite, so no pivoting. */
static void solve(const batch_t *batch, unsigned n, double right[])
{
    double left[MAX_NTHETA][MAX_NTHETA];
    memcpy(left, batch->information, sizeof left);
    for (unsigned k = 0; k < n; k++)
        for (unsigned i = k + 1; i < n; i++) {
            const double factor = left[i][k] / left[k][k];
            for (unsigned j = k; j < n; j++)
                left[i][j] -= factor * left[k][j];
            right[i] -= factor * right[k];
        }
    for (unsigned i = n; i-- > 0;) {
        for (unsigned j = i + 1; j < n; j++)
            right[i] -= left[i][j] * right[j];
        right[i] /= left[i][i];
    }
}

static void assert_batch(const lqg_rls_t *rls, const batch_t *batch, const rls_arrays_t *s)
{
    double theta[MAX_NTHETA];
    memcpy(theta, batch->vector, sizeof theta);
    solve(batch, rls->ntheta, theta);
    for (unsigned j = 0; j < rls->ntheta; j++) {
        double column[MAX_NTHETA] = {0};
        column[j] = 1;
        solve(batch, rls->ntheta, column);
        TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, theta[j], (double)s->theta[j]);
        for (unsigned i = 0; i < rls->ntheta; i++)
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * column[j] + TOLERANCE * 0.01, column[i],
                                      ud_covariance(s->U, s->d, rls->ntheta, i, j));
    }
}

static void follow_batch(lqg_real forgetting, lqg_real V, const lqg_real limits[])
{
    for (unsigned ntheta = 1; ntheta <= MAX_NTHETA; ntheta++) {
        const lqg_rls_t rls = {ntheta, forgetting, V, theta0, P0, limits};
        unsigned long seed = ntheta;
        rls_arrays_t s = begun(&rls);
        batch_t batch;

        begin_batch(&rls, &batch);
        for (unsigned sample = 0; sample < SAMPLES; sample++) {
            lqg_real phi[MAX_NTHETA], y = (lqg_real)noise(&seed);
            for (unsigned i = 0; i < ntheta; i++) {
                phi[i] = (lqg_real)noise(&seed);
                y += phi[i] * (lqg_real)(i + 1);
            }
            TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&rls, &s, phi, y));
            add_to_batch(&rls, &batch, phi, y);
            assert_batch(&rls, &batch, &s);
        }
    }
}

static void test_every_sample_is_the_batch_solution_so_far(void)
{
    follow_batch(1, 1, NULL);
}

static void test_every_sample_is_the_weighted_batch_solution_when_old_ones_are_forgotten(void)
{
    follow_batch(0.95f, 0.25f, NULL);
}

static void test_limits_that_are_not_reached_change_nothing(void)
{
    const lqg_real limits[MAX_NTHETA] = {100, 100, 100, 100, 100, 100};
    follow_batch(0.95f, 0.25f, limits);
}

/* y = 1.5 y₁ − 0.7 y₂ + 0.5 u₁, whose gain doubles half-way. */
static void test_forgetting_follows_a_plant_that_changes(void)
{
    const lqg_real forgetful = 0.9f, variances[3] = {100, 100, 100};
    const lqg_rls_t rls = {3, forgetful, 1, NULL, variances, NULL};
    rls_arrays_t s = begun(&rls);
    unsigned long seed = 1;
    lqg_real y1 = 0, y2 = 0;

    for (unsigned sample = 0; sample < 400; sample++) {
        const lqg_real u = (lqg_real)noise(&seed), gain = sample < 200 ? 0.5f : 1, phi[3] = {y1, y2, u};
        const lqg_real y = 1.5f * y1 - 0.7f * y2 + gain * u;
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&rls, &s, phi, y));
        y2 = y1;
        y1 = y;
        if (sample % 200 == 199) {
            /* 0.9¹⁹⁹ of the old plant's share is left: 1e-9 */
            const double left = 1e-8 + 1e4 * EPSILON;
            TEST_ASSERT_DOUBLE_WITHIN(left, (double)1.5f, (double)s.theta[0]);
            TEST_ASSERT_DOUBLE_WITHIN(left, (double)-0.7f, (double)s.theta[1]);
            TEST_ASSERT_DOUBLE_WITHIN(left, (double)gain, (double)s.theta[2]);
        }
    }
}

/* The first parameter alone is excited. */
static void test_limits_hold_what_is_not_excited_and_leave_the_rest_alone(void)
{
    const lqg_real limits[2] = {50, 8}, variances[2] = {1, 1}, phi[2] = {1, 0};
    const lqg_rls_t limited = {2, 0.9f, 1, NULL, variances, limits}, one = {1, 0.9f, 1, NULL, variances, NULL};
    rls_arrays_t s = begun(&limited), alone = begun(&one);

    for (unsigned sample = 0; sample < 10000; sample++) {
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&limited, &s, phi, 3));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&one, &alone, phi, 3));
        TEST_ASSERT_TRUE(s.theta[0] == alone.theta[0] && s.d[0] == alone.d[0] && s.U[0] == 0);
        TEST_ASSERT_TRUE(s.d[1] > 0 && (double)s.d[1] <= 8 * (1 + 4 * EPSILON));
    }
    TEST_ASSERT_DOUBLE_WITHIN(8 * 0.01, 8, (double)s.d[1]);

    /* one sample of the second, and it is known: of an error of 7 is left V λ/(V λ + P) */
    const lqg_real other[2] = {0, 1};
    const double P = (double)s.d[1], left = (double)limited.forgetting;
    update(&limited, &s, other, 7);
    TEST_ASSERT_DOUBLE_WITHIN(100 * EPSILON, 7 * P / (left + P), (double)s.theta[1]);
}

static double correlation(const rls_arrays_t *s)
{
    return ud_covariance(s->U, s->d, 2, 0, 1) /
           sqrt(ud_covariance(s->U, s->d, 2, 0, 0) * ud_covariance(s->U, s->d, 2, 1, 1));
}

static void test_limits_keep_correlations(void)
{
    const lqg_real limits[2] = {4, 5}, variances[2] = {4, 4}, both[2] = {1, 1}, none[2] = {0};
    const lqg_rls_t rls = {2, 0.75f, 1, NULL, variances, limits};
    rls_arrays_t s = begun(&rls);

    update(&rls, &s, both, 1);
    const double before = correlation(&s);
    TEST_ASSERT_TRUE(before < -0.5);
    for (unsigned sample = 0; sample < 20; sample++) {
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&rls, &s, none, 0));
        TEST_ASSERT_TRUE(ud_covariance(s.U, s.d, 2, 0, 0) <= 4 * (1 + 10 * EPSILON));
        TEST_ASSERT_TRUE(ud_covariance(s.U, s.d, 2, 1, 1) <= 5 * (1 + 10 * EPSILON));
        TEST_ASSERT_DOUBLE_WITHIN(400 * EPSILON, before, correlation(&s));
    }
}

/* Three variances that depend on each other grow without excitation until each is at its limit. */
static void test_limits_hold_variances_that_are_correlated(void)
{
    const lqg_real limits[3] = {4, 5, 6}, variances[3] = {4, 4, 4}, none[3] = {0};
    const lqg_real excited[2][3] = {{1, 1, 1}, {1, -1, 0.5f}};
    const lqg_rls_t rls = {3, 0.9f, 1, NULL, variances, limits};
    rls_arrays_t s = begun(&rls);

    for (unsigned sample = 0; sample < 2; sample++)
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&rls, &s, excited[sample], 1));
    TEST_ASSERT_TRUE(s.U[0] != 0 && s.U[1] != 0 && s.U[2] != 0);
    for (unsigned sample = 0; sample < 200; sample++) {
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&rls, &s, none, 0));
        for (unsigned i = 0; i < 3; i++)
            TEST_ASSERT_TRUE(ud_covariance(s.U, s.d, 3, i, i) <= (double)limits[i] * (1 + 100 * EPSILON));
    }
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * (double)limits[i], (double)limits[i], ud_covariance(s.U, s.d, 3, i, i));
}

static void test_parameter_that_is_not_finite_begins_all_anew(void)
{
    const lqg_real phi[2] = {1, 2};
    const lqg_rls_t rls = {2, 0.9f, 1, theta0, P0, NULL};
    rls_arrays_t s = begun(&rls);
    const rls_arrays_t first = s;

    update(&rls, &s, phi, 1);
    s.theta[1] = NAN;
    TEST_ASSERT_EQUAL_UINT(REJECTED(0) | LQG_STATE_RESET, update(&rls, &s, phi, 1));
    TEST_ASSERT_EQUAL_MEMORY(&first, &s, sizeof s);
}

static void test_init_begins_within_the_limits(void)
{
    const lqg_real limits[2] = {50, 8}, variances[2] = {1e6f, 1};
    const lqg_rls_t rls = {2, 0.9f, 1, NULL, variances, limits};
    const rls_arrays_t s = begun(&rls);
    TEST_ASSERT_TRUE(s.d[0] == 50 && s.d[1] == 1 && s.theta[0] == 0);
}

static void test_nothing_changes_to_the_bit_when_a_sample_is_hostile(void)
{
    const lqg_real hostile[] = {NAN, INFINITY, -INFINITY, 1e30f * 1e8f};
    const lqg_real limits[3] = {1, 1, 1}, honest[3] = {1, -1, 0.5f};
    const lqg_rls_t rls = {3, 0.5f, 1, theta0, P0, limits};
    rls_arrays_t s = begun(&rls);
    update(&rls, &s, honest, 1);
    const rls_arrays_t before = s;

    for (unsigned h = 0; h < sizeof hostile / sizeof *hostile; h++)
        for (unsigned i = 0; i < 4; i++) {
            lqg_real phi[3] = {1, -1, 0.5f}, y = 1;
            const int squares_overflow = sizeof(lqg_real) == sizeof(float) || h < 3;
            *(i < 3 ? &phi[i] : &y) = h < 3 || i < 3 ? hostile[h] : INFINITY;
            if (squares_overflow) {
                TEST_ASSERT_EQUAL_UINT(REJECTED(0), update(&rls, &s, phi, y));
                TEST_ASSERT_TRUE(memcmp(&before, &s, sizeof s) == 0);
            }
        }
}

static void test_begins_anew_when_forgetting_without_limits_overflows(void)
{
    const lqg_real none[2] = {0};
    const lqg_rls_t rls = {2, 0.5f, 1, theta0, P0, NULL};
    rls_arrays_t s = begun(&rls);
    const rls_arrays_t first = s;
    unsigned resets = 0;

    for (unsigned sample = 0; sample < 3000; sample++) {
        const lqg_status_t status = update(&rls, &s, none, 1);
        TEST_ASSERT_TRUE(status == LQG_OK || status == LQG_COVARIANCE_RESET);
        TEST_ASSERT_TRUE(status == LQG_OK || memcmp(&first, &s, sizeof s) == 0);
        resets += status == LQG_COVARIANCE_RESET;
    }
    TEST_ASSERT_TRUE(resets > 1);
}

static void test_a_parameter_without_variance_stays(void)
{
    const lqg_real variances[2] = {1, 0}, phi[2] = {1, 2};
    const lqg_rls_t rls = {2, 0.9f, 1, theta0, variances, NULL};
    rls_arrays_t s = begun(&rls);
    for (unsigned sample = 0; sample < 1000; sample++) /* 0.9¹⁰⁰⁰ of the guess is left: nothing */
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&rls, &s, phi, 1));
    TEST_ASSERT_TRUE(s.theta[1] == theta0[1]);
    TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, 1 - 2 * (double)theta0[1], (double)s.theta[0]);
}

static void test_memory_of_the_macro_holds_a_state_without_overlap(void)
{
    enum { NTHETA = 3 };
    const lqg_rls_t rls = {NTHETA, 0.75f, 1, theta0, P0, NULL};
    lqg_real memory[LQG_RLS_MEMORY(NTHETA) + 1];
    lqg_rls_state_t state = LQG_RLS_STATE_IN(memory, NTHETA);
    rls_arrays_t s = begun(&rls);

    memory[LQG_RLS_MEMORY(NTHETA)] = 77;
    lqg_rls_init(&rls, &state);
    for (unsigned k = 0; k < 20; k++) {
        const lqg_real phi[NTHETA] = {1, (lqg_real)(k % 2), (lqg_real)(k % 3)};
        TEST_ASSERT_EQUAL_UINT(update(&rls, &s, phi, 1), lqg_rls_update(&rls, &state, 1, phi));
    }
    TEST_ASSERT_EQUAL_MEMORY(s.theta, state.theta, NTHETA * sizeof *s.theta);
    TEST_ASSERT_EQUAL_MEMORY(s.U, state.U, LQG_RLS_U(NTHETA) * sizeof *s.U);
    TEST_ASSERT_EQUAL_MEMORY(s.d, state.d, NTHETA * sizeof *s.d);
    TEST_ASSERT_TRUE(memory[LQG_RLS_MEMORY(NTHETA)] == 77);
}

/* What lies behind the parameters is neither read, a NaN would come in, nor written. */
static void test_nothing_behind_the_parameters_is_touched(void)
{
    enum { NTHETA = 3 };
    const lqg_real limits[MAX_NTHETA] = {3, 3, 3, NAN, NAN, NAN}, variances[MAX_NTHETA] = {2, 1, 4, NAN, NAN, NAN};
    const lqg_real start[MAX_NTHETA] = {0, 0, 0, NAN, NAN, NAN};
    const lqg_rls_t rls = {NTHETA, 0.75f, 1, start, variances, limits};
    rls_arrays_t s, untouched;
    lqg_real work[MAX_NTHETA], exact[NTHETA];
    lqg_real theta[NTHETA], U[LQG_RLS_U(NTHETA)], d[NTHETA]; /* nothing behind them */
    lqg_rls_state_t long_state = {s.theta, s.U, s.d, work}, exact_state = {theta, U, d, exact};

    memset(&untouched, 0xff, sizeof untouched); /* NaNs */
    s = untouched;
    lqg_rls_init(&rls, &long_state);
    lqg_rls_init(&rls, &exact_state);
    for (unsigned k = 0; k < 20; k++) {
        const lqg_real phi[MAX_NTHETA] = {1, (lqg_real)(k % 2), (lqg_real)(k % 3), NAN, NAN, NAN};
        memset(work, 0xff, sizeof work);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_rls_update(&rls, &long_state, 1, phi));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_rls_update(&rls, &exact_state, 1, phi));
    }
    TEST_ASSERT_EQUAL_MEMORY(theta, s.theta, sizeof theta);
    TEST_ASSERT_EQUAL_MEMORY(U, s.U, sizeof U);
    TEST_ASSERT_EQUAL_MEMORY(d, s.d, sizeof d);
    TEST_ASSERT_EQUAL_MEMORY(untouched.theta + NTHETA, s.theta + NTHETA, sizeof s.theta - NTHETA * sizeof *s.theta);
    TEST_ASSERT_EQUAL_MEMORY(untouched.U + LQG_RLS_U(NTHETA), s.U + LQG_RLS_U(NTHETA),
                             sizeof s.U - LQG_RLS_U(NTHETA) * sizeof *s.U);
    TEST_ASSERT_EQUAL_MEMORY(untouched.d + NTHETA, s.d + NTHETA, sizeof s.d - NTHETA * sizeof *s.d);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_sample_is_the_batch_solution_so_far);
    RUN_TEST(test_every_sample_is_the_weighted_batch_solution_when_old_ones_are_forgotten);
    RUN_TEST(test_limits_that_are_not_reached_change_nothing);
    RUN_TEST(test_forgetting_follows_a_plant_that_changes);
    RUN_TEST(test_limits_hold_what_is_not_excited_and_leave_the_rest_alone);
    RUN_TEST(test_limits_keep_correlations);
    RUN_TEST(test_limits_hold_variances_that_are_correlated);
    RUN_TEST(test_parameter_that_is_not_finite_begins_all_anew);
    RUN_TEST(test_init_begins_within_the_limits);
    RUN_TEST(test_nothing_changes_to_the_bit_when_a_sample_is_hostile);
    RUN_TEST(test_begins_anew_when_forgetting_without_limits_overflows);
    RUN_TEST(test_a_parameter_without_variance_stays);
    RUN_TEST(test_memory_of_the_macro_holds_a_state_without_overlap);
    RUN_TEST(test_nothing_behind_the_parameters_is_touched);
    return UNITY_END();
}
