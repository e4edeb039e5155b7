/* SPDX-License-Identifier: MIT */
/* What a compiled header asks the library, and whether the answer is the optimum: by the conditions of Karush, Kuhn and
 * Tucker. plant.h, which foresight.py writes, has the header. */
#ifndef LQG_TEST_WATCHED_H
#define LQG_TEST_WATCHED_H

#include <float.h>
#include <stdio.h>

#include "lqg/mpc.h"

static lqg_status_t library_limit(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[])
{
    return lqg_mpc_limit(mpc, state, x, u);
}

static lqg_status_t watched_limit(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[]);
#undef lqg_mpc_limit
#define lqg_mpc_limit watched_limit
#include "closed_loop.h"

#ifdef LQG_REAL_DOUBLE
#define EPSILON DBL_EPSILON
#else
#define EPSILON FLT_EPSILON
#endif

static struct {
    int is_on;
    unsigned long states, active, given_up, wrong;
    unsigned most;   /* changes */
    double residual; /* largest, as a share of what rounding may do */
} seen;

static void say_wrong(const char *what, unsigned row, double by)
{
    if (seen.wrong++ < 10)
        printf("state %lu: %s, row %u, by %g of what is allowed\n", seen.states, what, row, by);
}

static lqg_real clipped(lqg_real value, lqg_real low, lqg_real high)
{
    return value < low ? low : value > high ? high : value;
}

/* The row's z = f + G m, with more digits where the machine has them. *size: what its terms, and those of
 * L diag(d) Lᵀ m, add up to at most; of these rounding is a share (N. J. Higham, Accuracy and Stability of Numerical
 * Algorithms, 2nd edition, theorem 8.5). */
static long double row_value(const lqg_mpc_t *mpc, const lqg_mpc_state_t *state, unsigned row, unsigned length,
                             const lqg_real x[], const lqg_real law[], double *size)
{
    const lqg_real *G = mpc->G + row * mpc->rows;
    long double z = row < mpc->nu ? (long double)law[row] : 0;

    *size = row < mpc->nu ? fabs((double)law[row]) : 0;
    for (unsigned j = 0; row >= mpc->nu && j < mpc->nx; j++) {
        const long double part = (long double)mpc->F[(row - mpc->nu) * mpc->nx + j] * x[j];
        z += part;
        *size += fabs((double)part);
    }
    for (unsigned k = 0; k < length; k++) {
        const unsigned j = state->active[k];
        z += (long double)G[j] * state->m[k];
        *size += sqrt((double)G[row] * (double)mpc->G[j * mpc->rows + j]) * fabs((double)state->m[k]);
    }
    return z;
}

static void check_row(const lqg_mpc_t *mpc, const lqg_mpc_state_t *state, unsigned i, unsigned length,
                      const lqg_real x[], const lqg_real law[], const lqg_real u[])
{
    const double low = (double)state->low[i], high = (double)state->high[i];
    double size;
    const double z = (double)row_value(mpc, state, i, length, x, law, &size);
    const double allowed = (length + mpc->nx) * (double)EPSILON * size;

    const double off = state->side[i] == 0 ? fmax(0, fmax(low - z, z - high) - (double)mpc->tolerance[i])
                                           : fabs(z - (state->side[i] == 1 ? low : high));

    if (off > 0)
        seen.residual = fmax(seen.residual, off / allowed);
    if (!(off <= allowed))
        say_wrong(state->side[i] ? "an active limit is not met" : "a limit is exceeded", i, off / allowed);
    if (i >= mpc->nu)
        return;
    if (!(u[i] >= state->low[i] && u[i] <= state->high[i]))
        say_wrong("u is beyond its limits", i, 0);
    if (!(fabs((double)u[i] - fmin(fmax(z, low), high)) <= allowed))
        say_wrong("u is not that of the multipliers", i, fabs((double)u[i] - z) / allowed);
    if (length == 0 && !(u[i] == clipped(law[i], state->low[i], state->high[i])))
        say_wrong("no limit is active and u is not the law", i, 0);
}

/* As many changes as have been enough until now, or more. */
static void count_changes(const lqg_mpc_t *mpc, const lqg_mpc_state_t *state, const lqg_real x[], const lqg_real law[])
{
    static lqg_real memory[LQG_MPC_MEMORY(ROWS)];
    static unsigned char set[LQG_MPC_SET(ROWS)];
    lqg_mpc_state_t scratch = LQG_MPC_STATE_IN(memory, set, state->u_applied, ROWS);
    lqg_mpc_t fewer = *mpc;
    lqg_real u[NU];

    for (fewer.iterations = seen.most; fewer.iterations < mpc->iterations; fewer.iterations++) {
        memcpy(u, law, sizeof u);
        if (!(library_limit(&fewer, &scratch, x, u) & LQG_NOT_OPTIMAL))
            break;
    }
    seen.most = fewer.iterations;
}

static void look(const lqg_mpc_t *mpc, const lqg_mpc_state_t *state, const lqg_real x[], const lqg_real law[],
                 const lqg_real u[], lqg_status_t status)
{
    unsigned length = 0;

    seen.states++;
    for (unsigned i = 0; i < mpc->rows; i++)
        length += state->side[i] != 0;
    seen.active += length > 0;
    if (status & LQG_NOT_OPTIMAL) {
        seen.given_up++;
        for (unsigned i = 0; i < mpc->nu; i++)
            if (!(u[i] == clipped(law[i], state->low[i], state->high[i])))
                say_wrong("given up, and u is not the law, clipped", i, 0);
        return;
    }
    for (unsigned i = 0; i < mpc->rows; i++)
        check_row(mpc, state, i, length, x, law, u);
    for (unsigned k = 0; k < length; k++)
        if (!(state->side[state->active[k]] == 1 ? state->m[k] >= 0 : state->m[k] <= 0))
            say_wrong("a multiplier has the wrong sign", state->active[k], 0);
    if (length)
        count_changes(mpc, state, x, law);
}

static lqg_status_t watched_limit(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[])
{
    lqg_real law[NU];

    memcpy(law, u, sizeof law);
    const lqg_status_t status = library_limit(mpc, state, x, u);
    if (seen.is_on)
        look(mpc, state, x, law, u, status);
    return status;
}

#endif
