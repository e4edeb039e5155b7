/* SPDX-License-Identifier: MIT */
/* The law with limits that are foreseen: optimal by its own conditions and by another solver, and well-behaved whatever
 * it is given. */
#include <string.h>

#include "limited.h"
#include "lqg/lqg.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { REFERENCES = 40, PROBLEMS = 150000 };
#include "mpc_reference.h"

#ifdef LQG_REAL_DOUBLE
static const int is_double = 1;
#else
static const int is_double = 0;
#endif

/* Rounding of a few hundred operations on numbers of this size; a problem that is nearly singular has a condition of
 * 10⁸. */
static double tolerance_of(kind_t kind, double size)
{
    return (kind == NEARLY_SINGULAR ? 3e5 : 3e3) * (double)EPSILON * size;
}

static unsigned active_rows(const scratch_t *scratch, unsigned rows)
{
    unsigned count = 0;
    for (unsigned i = 0; i < rows; i++)
        count += scratch->state.side[i] != 0;
    return count;
}

/* The conditions of Karush, Kuhn and Tucker, in doubles: sufficient, as the problem is convex. */
static void expect_optimal(kind_t kind, const description_t *d, const scratch_t *scratch, const lqg_real u[])
{
    const unsigned rows = d->mpc.rows, length = active_rows(scratch, rows);
    const lqg_mpc_state_t *s = &scratch->state;

    for (unsigned i = 0; i < rows; i++) {
        double z = (double)d->f[i], size = 1 + fabs(z);
        for (unsigned k = 0; k < length; k++) {
            const double part = (double)d->G[i * rows + s->active[k]] * (double)s->m[k];
            z += part;
            size += fabs(part);
        }
        const double allowed = tolerance_of(kind, size);
        if (s->side[i] == 1)
            TEST_ASSERT_TRUE(fabs(z - (double)d->low[i]) <= allowed);
        else if (s->side[i] == 2)
            TEST_ASSERT_TRUE(fabs(z - (double)d->high[i]) <= allowed);
        else
            TEST_ASSERT_TRUE(z >= (double)d->low[i] - allowed && z <= (double)d->high[i] + allowed);
        if (i < d->mpc.nu)
            TEST_ASSERT_TRUE(fabs(z - (double)u[i]) <= allowed);
    }
    for (unsigned k = 0; k < length; k++)
        TEST_ASSERT_TRUE(s->side[s->active[k]] == 1 ? s->m[k] >= 0 : s->m[k] <= 0);
}

static void expect_within_limits(const description_t *d, const lqg_real u[])
{
    for (unsigned i = 0; i < d->mpc.nu; i++) {
        TEST_ASSERT_TRUE(isfinite(u[i]));
        TEST_ASSERT_TRUE(u[i] >= d->low[i] && u[i] <= d->high[i]);
    }
}

/* Floats may give up where rows are soft beside a million times as hard ones: one problem in ten thousand. */
static void test_every_answer_meets_the_conditions_of_an_optimum(void)
{
    for (int kind = 0; kind < KINDS; kind++) {
        unsigned given_up = 0;
        for (unsigned seed = 0; seed < PROBLEMS; seed++) {
            const problem_t problem = random_problem((kind_t)kind, seed);
            static description_t d;
            static scratch_t scratch;
            lqg_real u[MAX_U];
            describe(&problem, &d);
            begin_scratch(&scratch, &d.mpc, NULL);
            const lqg_status_t status = lqg_mpc_control(&d.mpc, &scratch.state, d.f, u);
            TEST_ASSERT_TRUE(is_scratch_intact(&scratch, &d.mpc));
            expect_within_limits(&d, u);
            if (status & LQG_NOT_OPTIMAL)
                given_up++;
            else
                expect_optimal((kind_t)kind, &d, &scratch, u);
        }
        TEST_ASSERT_TRUE(given_up <= (is_double ? 0 : PROBLEMS / 10000));
    }
}

static void test_u_is_that_of_another_solver(void)
{
    for (int kind = 0; kind < KINDS; kind++)
        for (unsigned seed = 0; seed < REFERENCES; seed++) {
            const problem_t problem = random_problem((kind_t)kind, seed);
            description_t d;
            scratch_t scratch;
            lqg_real u[MAX_U];
            describe(&problem, &d);
            begin_scratch(&scratch, &d.mpc, NULL);
            TEST_ASSERT_FALSE(lqg_mpc_control(&d.mpc, &scratch.state, d.f, u) & LQG_NOT_OPTIMAL);
            for (unsigned i = 0; i < problem.nu; i++)
                TEST_ASSERT_TRUE(fabs((double)u[i] - reference[kind][seed][i]) <= (is_double ? 1e-9 : 5e-3));
        }
}

/* u_0 and u_1, two samples of one input, and what the law does with them. */
static const lqg_real K[2] = {1, 0.5f}, F[2] = {-0.5f, 0.25f}, G[4] = {2, 0.5f, 0.5f, 2},
                      scale[2] = {0.7071068f, 0.7071068f};
static const lqg_real low[2] = {-1, -1}, high[2] = {1, 2}, tolerance[2] = {0, 0}, u_step[1] = {0.25f};
static const lqg_mpc_t two_samples = {2, 1, 2, 8, K, F, G, scale, low, high, tolerance, NULL};

static lqg_status_t control(const lqg_mpc_t *mpc, const lqg_real u_applied[], const lqg_real x[], lqg_real u[])
{
    scratch_t scratch;
    begin_scratch(&scratch, mpc, u_applied);
    const lqg_status_t status = lqg_mpc_control(mpc, &scratch.state, x, u);
    TEST_ASSERT_TRUE(is_scratch_intact(&scratch, mpc));
    return status;
}

static void test_while_no_limit_is_in_the_way_u_is_the_law_bit_for_bit(void)
{
    const lqg_lqr_t lqr = {2, 1, K, NULL, NULL};
    for (int i = -40; i <= 40; i++) {
        const lqg_real x[2] = {(lqg_real)i / 83, (lqg_real)(i * i) / 3001};
        lqg_real u[1], law[1];
        TEST_ASSERT_EQUAL_HEX(LQG_OK, control(&two_samples, NULL, x, u));
        (void)lqg_lqr_control(&lqr, x, law);
        TEST_ASSERT_TRUE(memcmp(u, law, sizeof u) == 0);
    }
}

static void test_a_limit_of_u_is_met_exactly_and_told(void)
{
    const lqg_real x[2] = {-3, 0.1f};
    lqg_real u[1];
    TEST_ASSERT_EQUAL_HEX(LQG_INPUT_LIMITED, control(&two_samples, NULL, x, u));
    TEST_ASSERT_TRUE(u[0] == 1);
}

/* f = (0, −5): the second row needs m = 2, which moves the first by G_01 m. */
static void test_a_limit_ahead_moves_u_now(void)
{
    const lqg_real x[2] = {6.6666667f, -13.333333f};
    lqg_real u[1];
    TEST_ASSERT_EQUAL_HEX(LQG_INPUT_LIMITED, control(&two_samples, NULL, x, u));
    TEST_ASSERT_TRUE(u[0] == 1);
    const lqg_real nearer[2] = {2, -4};
    TEST_ASSERT_EQUAL_HEX(LQG_OK, control(&two_samples, NULL, nearer, u));
    TEST_ASSERT_TRUE(fabs((double)u[0] - 0.25) < 1e-6);
}

static void test_where_changes_are_too_few_u_is_the_law_clipped(void)
{
    lqg_mpc_t hasty = two_samples;
    const lqg_real ahead[2] = {2, -4}, far[2] = {-3, 0};
    lqg_real u[1];
    hasty.iterations = 0;
    TEST_ASSERT_EQUAL_HEX(LQG_NOT_OPTIMAL, control(&hasty, NULL, ahead, u));
    TEST_ASSERT_TRUE(u[0] == 0);
    TEST_ASSERT_EQUAL_HEX(LQG_NOT_OPTIMAL | LQG_INPUT_LIMITED, control(&hasty, NULL, far, u));
    TEST_ASSERT_TRUE(u[0] == 1);
    hasty.iterations = 1;
    TEST_ASSERT_EQUAL_HEX(LQG_OK, control(&hasty, NULL, ahead, u));
}

static void test_the_number_of_changes_is_a_bound_for_every_problem(void)
{
    for (unsigned iterations = 0; iterations < 12; iterations++)
        for (unsigned seed = 0; seed < 200; seed++) {
            const problem_t problem = random_problem(RATES, seed);
            description_t d;
            lqg_real u[MAX_U];
            describe(&problem, &d);
            d.mpc.iterations = iterations;
            const lqg_status_t status = control(&d.mpc, NULL, d.f, u);
            expect_within_limits(&d, u);
            for (unsigned i = 0; (status & LQG_NOT_OPTIMAL) && i < problem.nu; i++) {
                const lqg_real above = d.f[i] > d.high[i] ? d.high[i] : d.f[i];
                TEST_ASSERT_TRUE(u[i] == (above < d.low[i] ? d.low[i] : above));
            }
        }
}

static void test_limits_that_contradict_each_other_are_told(void)
{
    static const lqg_real equal[4] = {1, 1, 1, 1}, ones[2] = {1, 1}, apart[2] = {-1, 1}, above[2] = {0, 2};
    const lqg_mpc_t mpc = {2, 1, 2, 8, K, F, equal, ones, apart, above, tolerance, NULL};
    const lqg_real x[2] = {-3, 0};
    lqg_real u[1];
    TEST_ASSERT_EQUAL_HEX(LQG_NOT_OPTIMAL | LQG_INPUT_LIMITED, control(&mpc, NULL, x, u));
    TEST_ASSERT_TRUE(u[0] == 0);
}

static void test_a_change_of_u_is_limited_but_its_size_has_priority(void)
{
    static const struct {
        lqg_real applied, law, u;
    } cases[] = {{0, 5, 0.25f}, {0, -5, -0.25f},     {0.9f, 5, 1}, {-2, 5, -1},
                 {7, -5, 1},    {0, 0.125f, 0.125f}, {NAN, 5, 1},  {INFINITY, -5, 1}};
    lqg_mpc_t mpc = two_samples;
    mpc.u_step = u_step;
    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
        const lqg_real x[2] = {-cases[i].law, 0};
        lqg_real u[1] = {cases[i].applied};
        (void)control(&mpc, u, x, u); /* u may be u_applied */
        TEST_ASSERT_TRUE(u[0] == cases[i].u);
    }
}

static void test_limit_gives_what_control_gives_of_a_law_that_is_given(void)
{
    for (unsigned seed = 0; seed < 1000; seed++) {
        const problem_t problem = random_problem(SOFT, seed);
        description_t d;
        scratch_t scratch;
        lqg_real u[MAX_U], other[MAX_U];
        describe(&problem, &d);
        const lqg_status_t status = control(&d.mpc, NULL, d.f, u);
        memcpy(other, d.f, sizeof other);
        d.mpc.K = NULL;
        begin_scratch(&scratch, &d.mpc, NULL);
        TEST_ASSERT_EQUAL_HEX(status, lqg_mpc_limit(&d.mpc, &scratch.state, d.f, other));
        TEST_ASSERT_TRUE(memcmp(u, other, problem.nu * sizeof *u) == 0);
    }
}

static void test_u_is_finite_and_within_its_limits_whatever_x_is(void)
{
    static const lqg_real hostile[] = {NAN,   INFINITY, -INFINITY, LARGEST, -LARGEST, LARGEST / 1024,
                                       1e30f, -1e19f,   1e-40f};
    enum { HOSTILE = sizeof hostile / sizeof *hostile };
    for (int kind = 0; kind < KINDS; kind++)
        for (unsigned seed = 0; seed < 20; seed++)
            for (unsigned at = 0; at < HOSTILE * (HOSTILE + 1); at++) {
                const problem_t problem = random_problem((kind_t)kind, seed);
                description_t d;
                lqg_real u[MAX_U];
                describe(&problem, &d);
                d.f[seed % problem.rows] = hostile[at % HOSTILE];
                if (at / HOSTILE < HOSTILE)
                    d.f[(seed + 1) % problem.rows] = hostile[at / HOSTILE];
                (void)control(&d.mpc, NULL, d.f, u);
                expect_within_limits(&d, u);
            }
}

static void test_a_law_that_is_not_finite_is_told_and_counts_as_0(void)
{
    const lqg_real x[2] = {NAN, 0};
    lqg_real u[1];
    TEST_ASSERT_EQUAL_HEX(LQG_NOT_OPTIMAL | LQG_INPUT_LIMITED, control(&two_samples, NULL, x, u));
    TEST_ASSERT_TRUE(u[0] == 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_answer_meets_the_conditions_of_an_optimum);
    RUN_TEST(test_u_is_that_of_another_solver);
    RUN_TEST(test_while_no_limit_is_in_the_way_u_is_the_law_bit_for_bit);
    RUN_TEST(test_a_limit_of_u_is_met_exactly_and_told);
    RUN_TEST(test_a_limit_ahead_moves_u_now);
    RUN_TEST(test_where_changes_are_too_few_u_is_the_law_clipped);
    RUN_TEST(test_the_number_of_changes_is_a_bound_for_every_problem);
    RUN_TEST(test_limits_that_contradict_each_other_are_told);
    RUN_TEST(test_a_change_of_u_is_limited_but_its_size_has_priority);
    RUN_TEST(test_limit_gives_what_control_gives_of_a_law_that_is_given);
    RUN_TEST(test_u_is_finite_and_within_its_limits_whatever_x_is);
    RUN_TEST(test_a_law_that_is_not_finite_is_told_and_counts_as_0);
    return UNITY_END();
}
