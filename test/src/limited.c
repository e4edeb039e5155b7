/* SPDX-License-Identifier: MIT */
#include "limited.h"

#include <string.h>

/* Knuth's MMIX generator: an integer in [0, most] */
static int draw(unsigned long long *state, int most)
{
    *state = *state * 6364136223846793005ull + 1442695040888963407ull;
    return (int)((*state >> 33) % (unsigned long long)(most + 1));
}

static unsigned rows_of(kind_t kind, unsigned nu, unsigned nv, int more)
{
    if (kind == BOX || kind == INFINITE || kind == EQUAL_LIMITS)
        return nv;
    if (kind == RATES)
        return 2 * nv - nu;
    return nv + (unsigned)more;
}

/* Row i, behind those of the inputs, made of one or two of these. */
static void derive_row(problem_t *p, kind_t kind, unsigned i)
{
    const unsigned like = i - p->nv;

    if (kind == SOFT)
        p->soft[i] = 1 / 1024.0;
    if (kind == RATES)
        p->soft[i] = 1 / 1048576.0;
    if (kind == SOFT)
        return;
    p->f[i] = (kind == RATES ? p->f[like + p->nu] : 0) + (kind == RATES ? -1 : 1) * p->f[like];
    for (unsigned j = 0; j < p->nv; j++)
        p->M[i][j] = (kind == RATES ? p->M[like + p->nu][j] : 0) + (kind == RATES ? -1 : 1) * p->M[like][j];
    if (kind == NEARLY_SINGULAR)
        p->M[i][0] += 1 / 4096.0;
}

/* Limits within which `feasible` is. */
static void limit_row(problem_t *p, kind_t kind, unsigned i, double feasible, unsigned long long *state)
{
    const double unit = kind == RATES && i >= p->nv ? 0.25 : 1;
    const double low = -unit * (1 + draw(state, 16) / 16.0), high = unit * (1 + draw(state, 16) / 16.0);
    const int choice = draw(state, 3);

    p->low[i] = p->soft[i] > 0 || low < feasible ? low : feasible;
    p->high[i] = p->soft[i] > 0 || high > feasible ? high : feasible;
    if (kind == INFINITE && choice % 2)
        p->low[i] = -INFINITY;
    if (kind == INFINITE && choice > 1)
        p->high[i] = INFINITY;
    if (kind == EQUAL_LIMITS && choice == 0)
        p->low[i] = p->high[i] = feasible;
    if (kind == EQUAL_ROWS && i >= p->nv) {
        p->low[i] = p->low[i - p->nv];
        p->high[i] = p->high[i - p->nv];
    }
}

problem_t random_problem(kind_t kind, unsigned seed)
{
    unsigned long long state = 1000003ull * seed + (unsigned)kind;
    double w[MAX_V];
    problem_t p;

    memset(&p, 0, sizeof p);
    draw(&state, 1);
    p.nu = 1 + (unsigned)draw(&state, 1);
    p.nv = p.nu + 1 + (unsigned)draw(&state, 5);
    p.rows = rows_of(kind, p.nu, p.nv, draw(&state, (int)p.nv));
    for (unsigned i = 0; i < p.rows; i++) {
        p.f[i] = (draw(&state, 128) - 64) / 16.0;
        for (unsigned j = 0; j < p.nv; j++)
            p.M[i][j] = (draw(&state, 32) - 16) / 16.0 + (i == j ? 2 : 0);
    }
    for (unsigned i = p.nv; i < p.rows; i++)
        derive_row(&p, kind, i);
    for (unsigned j = 0; j < p.nv; j++)
        w[j] = (draw(&state, 32) - 16) / 16.0;
    for (unsigned i = 0; i < p.rows; i++) {
        double feasible = p.f[i];
        for (unsigned j = 0; j < p.nv; j++)
            feasible += p.M[i][j] * w[j];
        limit_row(&p, kind, i, feasible, &state);
    }
    return p;
}

void describe(const problem_t *p, description_t *out)
{
    const lqg_mpc_t mpc = {p->rows, p->nu,      p->rows,  500,       out->K,         out->F,
                           out->G,  out->scale, out->low, out->high, out->tolerance, NULL};

    memset(out, 0, sizeof *out);
    out->mpc = mpc;
    for (unsigned i = 0; i < p->rows; i++) {
        out->f[i] = (lqg_real)p->f[i];
        out->low[i] = (lqg_real)p->low[i];
        out->high[i] = (lqg_real)p->high[i];
        out->tolerance[i] = 32 * EPSILON;
        for (unsigned k = 0; k < p->rows; k++) {
            double sum = i == k ? p->soft[i] : 0;
            for (unsigned j = 0; j < p->nv; j++)
                sum += p->M[i][j] * p->M[k][j];
            out->G[i * p->rows + k] = (lqg_real)sum;
        }
        out->scale[i] = (lqg_real)(1 / sqrt((double)out->G[i * p->rows + i]));
        if (i < p->nu)
            out->K[i * p->rows + i] = -1;
        else
            out->F[(i - p->nu) * p->rows + i] = 1;
    }
}

static const lqg_real untouched = 12345;

void begin_scratch(scratch_t *scratch, const lqg_mpc_t *mpc, const lqg_real u_applied[])
{
    const lqg_mpc_state_t state = LQG_MPC_STATE_IN(scratch->memory, scratch->set, u_applied, mpc->rows);

    memset(scratch->memory, 0xff, sizeof scratch->memory);
    memset(scratch->set, 0xff, sizeof scratch->set);
    scratch->memory[LQG_MPC_MEMORY(mpc->rows)] = untouched;
    scratch->set[LQG_MPC_SET(mpc->rows)] = 123;
    scratch->state = state;
}

int is_scratch_intact(const scratch_t *scratch, const lqg_mpc_t *mpc)
{
    return scratch->memory[LQG_MPC_MEMORY(mpc->rows)] == untouched && scratch->set[LQG_MPC_SET(mpc->rows)] == 123;
}
