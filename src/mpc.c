/* SPDX-License-Identifier: MIT */
/* The control law with limits that are foreseen: a dual active set. */
#include "lqg/mpc.h"

#include "kernel.h"

#ifdef LQG_REAL_DOUBLE
#define SINGULAR 1.4210854715202004e-14 /* 2⁻⁴⁶: a pivot below this share of its G_ii is 0 */
#define ROUNDING 1.7763568394002505e-15 /* 2⁻⁴⁹: what of a violation may be rounding, as a share of f_i */
#else
#define SINGULAR 9.53674316e-07f /* 2⁻²⁰ */
#define ROUNDING 9.53674316e-07f
#endif

/* No multiplier goes farther along a direction. */
#define FARTHEST ((lqg_real)1.329227995784916e36) /* 2¹²⁰ */

/* Of a row: not active, or at which of its limits. */
enum { NOT_ACTIVE, AT_LOW, AT_HIGH };

LQG_STRICT_BEGIN

static void check_contract(const lqg_mpc_t *mpc, const lqg_mpc_state_t *state)
{
    (void)mpc;
    (void)state;
    LQG_ASSERT(mpc && state);
    LQG_ASSERT(mpc->nx >= 1 && mpc->nu >= 1 && mpc->rows >= mpc->nu && mpc->rows <= 255);
    LQG_ASSERT((mpc->F || mpc->rows == mpc->nu) && mpc->G && mpc->scale && mpc->low && mpc->high && mpc->tolerance);
    LQG_ASSERT(state->u_applied || !mpc->u_step);
}

/* The limits of this sample: those of the size of u, narrowed by those of its change as far as they agree. A u[k−1]
 * that is NaN narrows nothing. */
static void narrow(const lqg_mpc_t *mpc, lqg_mpc_state_t *state)
{
    LQG_STRICT_BODY
    lqg_real *low = state->narrowed, *high = low + mpc->rows;

    for (unsigned i = 0; i < mpc->rows; i++) {
        const lqg_real least = mpc->low[i], most = mpc->high[i];
        low[i] = least;
        high[i] = most;
        if (i < mpc->nu) {
            const lqg_real lowest = state->u_applied[i] - mpc->u_step[i];
            const lqg_real highest = state->u_applied[i] + mpc->u_step[i];
            if (lowest > least)
                low[i] = lowest < most ? lowest : most;
            if (highest < most)
                high[i] = highest > least ? highest : least;
        }
    }
    state->low = low;
    state->high = high;
}

/* The limit that row, which is active, is at. */
static lqg_real limit_of(const lqg_mpc_state_t *state, unsigned row)
{
    return (state->side[row] == AT_LOW ? state->low : state->high)[row];
}

/* z_i = f_i + Σ_k G_ik m_k over the active rows */
static lqg_real foreseen(const lqg_mpc_t *mpc, const lqg_mpc_state_t *state, unsigned length, unsigned row)
{
    LQG_STRICT_BODY
    const lqg_real *G = mpc->G + row * mpc->rows;
    lqg_real z = state->f[row];

    for (unsigned k = 0; k < length; k++)
        z = multiply_add(G[state->active[k]], state->m[k], z);
    return z;
}

/* The row that is furthest beyond a limit, in units of √G_ii; it gets its side. `rows` when there is none. */
static unsigned most_violated(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, unsigned length)
{
    LQG_STRICT_BODY
    unsigned worst = mpc->rows;
    unsigned char side = NOT_ACTIVE;
    lqg_real largest = 0;

    for (unsigned i = 0; i < mpc->rows; i++) {
        if (state->side[i] != NOT_ACTIVE)
            continue;
        const lqg_real z = foreseen(mpc, state, length, i);
        const lqg_real below = state->low[i] - z, above = z - state->high[i];
        const lqg_real violation = below > above ? below : above;
        if (!(violation > mpc->tolerance[i]) || !(violation * mpc->scale[i] > largest) ||
            !(violation > ROUNDING * absolute(state->f[i])))
            continue;
        largest = violation * mpc->scale[i];
        worst = i;
        side = below > above ? AT_LOW : AT_HIGH;
    }
    if (worst < mpc->rows)
        state->side[worst] = side;
    return worst;
}

/* Row k of L. */
static inline lqg_real *row_of(lqg_real L[], unsigned k)
{
    return L + k * (k - 1) / 2;
}

/* y_k = limit − f − Σ_j L_kj y_j */
static void substitute(lqg_mpc_state_t *state, unsigned k)
{
    LQG_STRICT_BODY
    const unsigned row = state->active[k];
    const lqg_real right = limit_of(state, row) - state->f[row];

    state->y[k] = k ? subtract_row_product(right, row_of(state->L, k), 0, k, state->y) : right;
}

/* G of the active rows, and of `row` behind them: a row more of L and d. */
static void append(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, unsigned length, unsigned row)
{
    LQG_STRICT_BODY
    const lqg_real *G = mpc->G + row * mpc->rows;
    lqg_real *last = state->L + (length ? length * (length - 1) / 2 : 0), *product = state->next;
    lqg_real d = G[row];

    for (unsigned j = 0; j < length; j++) {
        const lqg_real g = G[state->active[j]];
        product[j] = j ? subtract_row_product(g, row_of(state->L, j), 0, j, product) : g;
        last[j] = product[j] / state->d[j];
        d = multiply_subtract(last[j], product[j], d);
    }
    state->d[length] = d > SINGULAR * G[row] ? d : 0;
    state->m[length] = 0;
    state->active[length] = (unsigned char)row;
    substitute(state, length);
}

/* L and d without row and column k: what column k leaves to the rows below it is d_k l lᵀ. Of the `length` rows before
 * one less is left. */
static void drop(lqg_mpc_state_t *state, unsigned length, unsigned k)
{
    LQG_STRICT_BODY
    lqg_real *p = state->next, *beta = state->y, alpha = state->d[k];

    state->side[state->active[k]] = NOT_ACTIVE;
    for (unsigned i = k + 1; i < length; i++) {
        const lqg_real *from = row_of(state->L, i);
        lqg_real *to = state->L + (i - 1) * (i > 1 ? i - 2 : 0) / 2, rest = from[k];
        copy(to, from, k);
        for (unsigned j = k + 1; j < i; j++) {
            rest = multiply_subtract(p[j], from[j], rest);
            to[j - 1] = multiply_add(beta[j], rest, from[j]);
        }
        const lqg_real part = alpha * rest, d = multiply_add(part, rest, state->d[i]);
        p[i] = rest;
        beta[i] = 0;
        if (d > 0) {
            beta[i] = part / d;
            alpha = alpha * state->d[i] / d;
        }
        state->d[i - 1] = d;
        state->m[i - 1] = state->m[i];
        state->active[i - 1] = state->active[i];
    }
    for (unsigned j = k; j + 1 < length; j++)
        substitute(state, j);
}

/* next: the m with which the active rows are at their limits; or where the last of them depends on the others, the
 * direction in which m changes without a change of theirs. */
static void solve_active(lqg_mpc_state_t *state, unsigned length, int is_singular)
{
    LQG_STRICT_BODY
    lqg_real *next = state->next;

    for (unsigned j = 0; j < length; j++)
        next[j] = is_singular ? 0 : state->y[j] / state->d[j];
    if (is_singular)
        next[length - 1] = state->side[state->active[length - 1]] == AT_LOW ? 1 : -1;
    for (unsigned j = length; j > 1; j--) {
        const lqg_real *row = row_of(state->L, j - 1), known = next[j - 1];
        for (unsigned i = 0; i < j - 1; i++)
            next[i] = multiply_subtract(row[i], known, next[i]);
    }
}

/* m to where the active rows are at their limits, or as far as no multiplier changes its sign: then the answer is the
 * one that would, else `length`. 256: limits contradict each other. */
static unsigned advance(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, unsigned length)
{
    LQG_STRICT_BODY
    lqg_real *m = state->m, *next = state->next;
    const unsigned last = length ? state->active[length - 1] : 0;
    const int is_singular = length && !(state->d[length - 1] > SINGULAR * mpc->G[last * mpc->rows + last]);
    lqg_real share = is_singular ? FARTHEST : 1;
    unsigned blocking = length;

    solve_active(state, length, is_singular);
    for (unsigned k = 0; k < length; k++) {
        if (state->side[state->active[k]] == AT_LOW ? !(next[k] < 0) : !(next[k] > 0))
            continue;
        const lqg_real possible = m[k] / (is_singular ? -next[k] : m[k] - next[k]);
        if (possible < share) {
            share = possible;
        } else {
            if (blocking != length)
                continue;
        }
        blocking = k;
    }
    if (!(share > 0)) /* rounding has left a multiplier with the other sign: back would be no step */
        share = 0;
    if (blocking == length && is_singular)
        return 256;
    for (unsigned k = 0; k < length; k++) {
        const lqg_real step = is_singular ? next[k] : next[k] - m[k];
        m[k] = blocking == length ? next[k] : multiply_add(share, step, m[k]);
    }
    return blocking;
}

/* The row that was appended last has to leave before its multiplier moved: its violation, the largest, was nothing but
 * rounding. */
static inline int is_rounding(const lqg_mpc_state_t *state, unsigned length, unsigned blocking)
{
    return length && blocking == length - 1 && state->m[blocking] == 0;
}

/* Whether the multipliers of the optimum were found; *length: how many rows are active. */
static int find_optimum(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, unsigned *length)
{
    unsigned n = 0, blocking = 0;

    for (unsigned changes = 0; changes <= mpc->iterations && blocking <= n; changes++) {
        const int is_solved = blocking == n, is_done = is_rounding(state, n, blocking);
        const unsigned row = is_solved && n < mpc->rows ? most_violated(mpc, state, n) : mpc->rows;
        if (blocking < n)
            drop(state, n--, blocking);
        if (is_done || (is_solved && row == mpc->rows)) {
            *length = n;
            return 1;
        }
        if (changes == mpc->iterations)
            break;
        if (row < mpc->rows)
            append(mpc, state, n++, row);
        blocking = advance(mpc, state, n);
    }
    return 0;
}

/* u of the optimum, or the law where it was not found, finite and within its limits. */
static lqg_status_t take(const lqg_mpc_t *mpc, const lqg_mpc_state_t *state, int is_optimal, unsigned length,
                         lqg_real u[])
{
    LQG_STRICT_BODY
    lqg_status_t status = is_optimal ? LQG_OK : LQG_NOT_OPTIMAL;

    for (unsigned i = 0; i < mpc->nu; i++) {
        const int is_active = is_optimal && state->side[i] != NOT_ACTIVE;
        const lqg_real wanted = is_active ? limit_of(state, i) : foreseen(mpc, state, length, i);
        lqg_real limited = is_finite(wanted) ? wanted : 0;
        if (!is_finite(wanted))
            status |= LQG_NOT_OPTIMAL;
        limited = limited < state->low[i] ? state->low[i] : limited;
        limited = limited > state->high[i] ? state->high[i] : limited;
        if (is_active || limited != wanted)
            status |= LQG_INPUT_LIMITED;
        u[i] = limited;
    }
    return status;
}

/* f, of which the law's u is there, and that u. Whether it is finite and within all limits: nothing is left to do. */
static int foresee(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[])
{
    LQG_STRICT_BODY
    const unsigned nx = mpc->nx, rows = mpc->rows;
    const lqg_real *F = mpc->F, *low = state->low, *high = state->high;
    lqg_real *z = state->f;
    int all_within = 1;
    unsigned i = 0;

    for (; i < mpc->nu; i++) {
        u[i] = z[i];
        state->side[i] = NOT_ACTIVE;
        if (!is_finite(z[i]) || !(z[i] >= low[i] && z[i] <= high[i]))
            all_within = 0;
    }
    for (; i < rows; i++, F += nx) {
        const lqg_real f = add_row_product(0, F, 0, nx, x);
        z[i] = f;
        state->side[i] = NOT_ACTIVE;
        if (!(f >= low[i] && f <= high[i]))
            all_within = 0;
    }
    return all_within;
}

/* u of the law, which is in f. */
static lqg_status_t limit_law(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[])
{
    unsigned length = 0;

    state->low = mpc->low;
    state->high = mpc->high;
    if (mpc->u_step)
        narrow(mpc, state);
    if (foresee(mpc, state, x, u))
        return LQG_OK;
    const int is_found = find_optimum(mpc, state, &length);
    return take(mpc, state, is_found, length, u);
}

lqg_status_t lqg_mpc_limit(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[])
{
    check_contract(mpc, state);
    LQG_ASSERT(x && u);
    copy(state->f, u, mpc->nu);
    return limit_law(mpc, state, x, u);
}

lqg_status_t lqg_mpc_control(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[])
{
    check_contract(mpc, state);
    LQG_ASSERT(mpc->K && x && u);
    for (unsigned i = 0; i < mpc->nu; i++)
        state->f[i] = subtract_row_product(0, mpc->K, i, mpc->nx, x);
    return limit_law(mpc, state, x, u);
}

LQG_STRICT_END
