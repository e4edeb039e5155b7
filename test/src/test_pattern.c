/* SPDX-License-Identifier: MIT */
/* A plant whose A is given by the entries of a pattern is the plant with all entries, to the bit. */
#include <string.h>

#include "lqg/lqg.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { MOST = 9, SAMPLES = 60, NY = 2, NW = 2 };

/* Each state is driven by the next; the last one by none, and one row by all. */
static lqg_real entry_of_chain(unsigned i, unsigned j, unsigned nx)
{
    if (i == 1)
        return j == 0 ? (lqg_real)-0.03f : (lqg_real)0.05f * (lqg_real)(1 + j % 3);
    if (i == nx - 1)
        return 0;
    return i == j ? (lqg_real)0.9f : j == i + 1 ? (lqg_real)0.125f : 0;
}

typedef struct {
    lqg_real A[MOST * MOST], entries[MOST * MOST], C[NY * MOST], G[MOST * NW], W[LQG_TRIANGLE(MOST)];
    lqg_real P0[LQG_TRIANGLE(MOST)], U0[LQG_STRICT_TRIANGLE(MOST)], d0[MOST], L[MOST * NY];
    unsigned char pattern[MOST * (MOST + 1)];
    lqg_plant_t dense, sparse;
} chain_t;

static void write_rows(chain_t *chain, unsigned nx)
{
    unsigned at = 0, entries = 0;

    for (unsigned i = 0; i < nx; i++) {
        const unsigned row = at++;
        for (unsigned j = 0; j < nx; j++) {
            chain->A[i * nx + j] = entry_of_chain(i, j, nx);
            if (entry_of_chain(i, j, nx) != 0) {
                chain->entries[entries++] = entry_of_chain(i, j, nx);
                chain->pattern[at++] = (unsigned char)j;
            }
        }
        chain->pattern[row] = (unsigned char)(at - row - 1);
    }
}

static void make_chain(chain_t *chain, unsigned nx)
{
    static const chain_t nothing;

    *chain = nothing;
    write_rows(chain, nx);
    for (unsigned i = 0; i < nx; i++) {
        chain->C[i] = i == 0 ? 1 : 0;
        chain->C[nx + i] = (lqg_real)0.25f * (lqg_real)(i % 4);
        chain->G[i * NW + i % NW] = 1;
        chain->W[LQG_TRIANGLE(i) + i] = (lqg_real)0.01f;
        chain->P0[LQG_TRIANGLE(i) + i] = 1;
        chain->d0[i] = 1;
        chain->L[i * NY] = (lqg_real)0.1f;
        chain->L[i * NY + 1] = (lqg_real)-0.05f;
    }
    const lqg_plant_t dense = {nx, 0, NY, chain->A, NULL, chain->C, NULL, NULL};
    const lqg_plant_t sparse = {nx, 0, NY, chain->entries, NULL, chain->C, NULL, chain->pattern};
    chain->dense = dense;
    chain->sparse = sparse;
}

static void measure(unsigned sample, lqg_real y[])
{
    y[0] = (lqg_real)(sample % 7) - 3;
    y[1] = (lqg_real)(sample % 5) / 4;
}

static void assert_same_bits(const lqg_real a[], const lqg_real b[], unsigned length)
{
    TEST_ASSERT_EQUAL_MEMORY(a, b, length * sizeof *a);
}

static const lqg_real V[NY] = {(lqg_real)0.1f, (lqg_real)0.2f}, w[NW] = {(lqg_real)0.01f, (lqg_real)0.02f};

LQG_KALMAN_PLAIN_STATE(plain_a, MOST, 0, NY);
LQG_KALMAN_PLAIN_STATE(plain_b, MOST, 0, NY);
LQG_KALMAN_UD_STATE(ud_a, MOST, 0, NY, NW);
LQG_KALMAN_UD_STATE(ud_b, MOST, 0, NY, NW);
LQG_KALMAN_STEADY_STATE(steady_a, MOST, 0, NY);
LQG_KALMAN_STEADY_STATE(steady_b, MOST, 0, NY);

static void run_plain(const chain_t *chain, const lqg_plant_t *plant, lqg_kalman_plain_state_t *state)
{
    const lqg_kalman_plain_t kalman = {*plant, NULL, V, chain->W, NULL, NULL, NULL, chain->P0, NULL, NULL, NULL};
    lqg_real y[NY];

    lqg_kalman_plain_init(&kalman, state);
    for (unsigned sample = 0; sample < SAMPLES; sample++) {
        measure(sample, y);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_plain_update(&kalman, state, y));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_plain_predict(&kalman, state, NULL));
    }
}

static void run_ud(const chain_t *chain, const lqg_plant_t *plant, lqg_kalman_ud_state_t *state)
{
    const lqg_kalman_ud_t kalman = {*plant, NULL, V,         NW,        chain->G, w,    NULL,
                                    NULL,   NULL, chain->U0, chain->d0, NULL,     NULL, NULL};
    lqg_real y[NY];

    lqg_kalman_ud_init(&kalman, state);
    for (unsigned sample = 0; sample < SAMPLES; sample++) {
        measure(sample, y);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_ud_update(&kalman, state, y));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_ud_predict(&kalman, state, NULL));
    }
}

static void run_steady(const chain_t *chain, const lqg_plant_t *plant, lqg_kalman_steady_state_t *state)
{
    const lqg_kalman_steady_t kalman = {*plant, chain->L, NULL, NULL, NULL, NULL, NULL, NULL};
    lqg_real y[NY];

    lqg_kalman_steady_init(&kalman, state);
    for (unsigned sample = 0; sample < SAMPLES; sample++) {
        measure(sample, y);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_update(&kalman, state, y));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_predict(&kalman, state, NULL));
    }
}

/* From the least number of states that a pattern may have on: whole groups of four, and what is left of the last. */
static void test_a_pattern_changes_no_bit_for_four_to_nine_states(void)
{
    static chain_t chain;

    for (unsigned nx = 4; nx <= MOST; nx++) {
        make_chain(&chain, nx);
        run_plain(&chain, &chain.dense, &plain_a);
        run_plain(&chain, &chain.sparse, &plain_b);
        assert_same_bits(plain_a.x, plain_b.x, nx);
        assert_same_bits(plain_a.P, plain_b.P, LQG_TRIANGLE(nx));
        run_ud(&chain, &chain.dense, &ud_a);
        run_ud(&chain, &chain.sparse, &ud_b);
        assert_same_bits(ud_a.x, ud_b.x, nx);
        assert_same_bits(ud_a.U, ud_b.U, LQG_STRICT_TRIANGLE(nx));
        assert_same_bits(ud_a.d, ud_b.d, nx);
        run_steady(&chain, &chain.dense, &steady_a);
        run_steady(&chain, &chain.sparse, &steady_b);
        assert_same_bits(steady_a.x, steady_b.x, nx);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_pattern_changes_no_bit_for_four_to_nine_states);
    return UNITY_END();
}
