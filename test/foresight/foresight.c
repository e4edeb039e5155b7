/* SPDX-License-Identifier: MIT */
/* The compiled header of a design whose limits are foreseen. plant.h, which foresight.py writes, has both.
 *
 *     foresight answers|conditions|starts NUMBER
 *
 * answers: prints random states, u[k−1] and references, each with u. conditions: every answer is the optimum by the
 * conditions of Karush, Kuhn and Tucker, as the problem is convex; it counts how many changes of the set of active
 * limits were needed. starts: how many random starts the loop settles from, and how many with the law clipped. */
#include <float.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

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

enum { LONGEST = 20000 }; /* samples of a loop */

/* ---- what the header asks the library ------------------------------------------------------------------ */

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

/* ---- random states ------------------------------------------------------------------------------------- */

static double uniform(void)
{
    static uint64_t word = 1;

    word = word * 6364136223846793005u + 1442695040888963407u;
    return ((double)(word >> 11) + 0.5) / 9007199254740992.0;
}

static double normal(void)
{
    const double size = sqrt(-2 * log(uniform()));

    return size * cos(6.283185307179586 * uniform());
}

struct start {
    double x[NX], r[NR + 1];
};

/* x − Nx r is equally dear in all directions; the law goes 2^least to 2^most times as far as a limit, in the median. */
static void draw(struct start *start, double least, double most)
{
    const double scale = exp2(least + (most - least) * uniform());
    double white[NX];

    for (int i = 0; i < NX; i++)
        white[i] = normal();
    for (int j = 0; j < NR; j++) {
        double typical_r = 0;
        for (int i = 0; i < NX; i++)
            if (Nx[i * NR + j] != 0)
                typical_r = fmax(typical_r, typical[i] / fabs(Nx[i * NR + j]));
        start->r[j] = typical_r * normal();
    }
    for (int i = 0; i < NX; i++) {
        start->x[i] = 0;
        for (int j = 0; j < NX; j++)
            start->x[i] += scale * start_factor[i * NX + j] * white[j];
        for (int j = 0; j < NR; j++)
            start->x[i] += Nx[i * NR + j] * start->r[j];
    }
}

static void set_controller(OF(t) * controller, const struct start *start)
{
    OF(init)(controller);
    for (int i = 0; i < NX; i++)
        controller->x[i] = (real)start->x[i];
#if defined HAS_REFERENCES
    for (int j = 0; j < NR; j++)
        controller->r[j] = (real)start->r[j];
#endif
}

/* One answer; u[k−1] is anywhere within its limits. */
static void answer(OF(t) * controller, real last[NU], real u[NU])
{
    struct start start;

    draw(&start, -2, 4);
    set_controller(controller, &start);
    for (int i = 0; i < NU; i++)
        last[i] = 0;
#ifdef LIMITS_CHANGE
    for (int i = 0; i < NU; i++) {
        last[i] = (real)(u_min[i] + (u_max[i] - u_min[i]) * uniform());
        controller->u_applied[i] = last[i];
    }
#endif
    (void)OF(control)(controller, u);
}

static void print_answers(long number)
{
    for (long n = 0; n < number; n++) {
        OF(t) controller;
        real last[NU], u[NU];
        answer(&controller, last, u);
        for (int i = 0; i < NX; i++)
            printf("%.17g ", (double)controller.x[i]);
        for (int i = 0; i < NU; i++)
            printf("%.17g ", (double)last[i]);
#ifdef HAS_REFERENCES
        for (int j = 0; j < NR; j++)
            printf("%.17g ", (double)controller.r[j]);
#endif
        for (int i = 0; i < NU; i++)
            printf("%.17g%s", (double)u[i], i + 1 < NU ? " " : "\n");
    }
}

static int check_conditions(long number)
{
    seen.is_on = 1;
    for (long n = 0; n < number; n++) {
        OF(t) controller;
        real last[NU], u[NU];
        answer(&controller, last, u);
    }
    printf(
        "%lu states, %lu with an active limit: %u changes at most where %u may be, %lu given up; rounding is %.2g of "
        "what is allowed, %lu wrong\n",
        seen.states, seen.active, seen.most, LAW_LIMITS.iterations, seen.given_up, seen.residual, seen.wrong);
    return seen.wrong > 0 || seen.given_up > 0 || seen.active < seen.states / 4;
}

/* ---- closed loops -------------------------------------------------------------------------------------- */

/* What the rest costs, without limits. */
static double cost_of(const double x[NX], const double r[NR + 1])
{
    double from[NX], cost = 0;

    for (int i = 0; i < NX; i++) {
        from[i] = x[i];
        for (int j = 0; j < NR; j++)
            from[i] -= Nx[i * NR + j] * r[j];
    }
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NX; j++)
            cost += from[i] * X[i * NX + j] * from[j];
    return cost;
}

/* The law, clipped: the change of u first, then its size, which has priority. */
static void clip_law(const double x[NX], const double r[NR + 1], real u[NU])
{
    for (int i = 0; i < NU; i++) {
        double law = 0;
        for (int j = 0; j < NX; j++) {
            double from = x[j];
            for (int k = 0; k < NR; k++)
                from -= Nx[j * NR + k] * r[k];
            law -= K[i * NX + j] * from;
        }
        for (int k = 0; k < NR; k++)
            law += Nu[i * NR + k] * r[k];
#ifdef LIMITS_CHANGE
        law = fmin(fmax(law, (double)u[i] - u_change[i]), (double)u[i] + u_change[i]);
#endif
        u[i] = (real)fmin(fmax(law, u_min[i]), u_max[i]);
    }
}

static int settles(const struct start *start, int is_clipped)
{
    static const struct drawn nothing;
    static const struct visitor nobody;
    const double first = cost_of(start->x, start->r);
    struct loop loop;

    memset(&loop, 0, sizeof loop);
    set_controller(&loop.controller, start);
    memcpy(loop.x, start->x, sizeof loop.x);
    for (int k = 0; k < LONGEST; k++) {
        const double cost = cost_of(loop.x, start->r);
        if (cost < 1e-6 * first)
            return 1;
        if (!(cost < 1e6 * first))
            return 0;
        if (is_clipped) {
            clip_law(loop.x, start->r, loop.u);
            advance_plant(&loop, &nothing);
        } else {
            (void)run_sample(&loop, &nothing, nobody);
        }
    }
    return 0;
}

static int run_starts(long number)
{
    long with_foresight = 0, with_clipping = 0;

    for (long n = 0; n < number; n++) {
        struct start start;
        draw(&start, 0, 3);
        for (int i = 0; i < NX; i++)
            start.x[i] = fmin(fmax(start.x[i], state_limits[2 * i]), state_limits[2 * i + 1]);
        with_foresight += settles(&start, 0);
        with_clipping += settles(&start, 1);
    }
    printf("settled: foreseen %ld, clipped %ld of %ld\n", with_foresight, with_clipping, number);
    return with_foresight < with_clipping;
}

int main(int count, char **words)
{
    const long number = count > 2 ? strtol(words[2], NULL, 10) : 0;

    if (number > 0 && strcmp(words[1], "answers") == 0)
        print_answers(number);
    else if (number > 0 && strcmp(words[1], "conditions") == 0)
        return check_conditions(number);
    else if (number > 0 && strcmp(words[1], "starts") == 0)
        return run_starts(number);
    else
        return 2;
    return 0;
}
