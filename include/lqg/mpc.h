/* SPDX-License-Identifier: MIT */
/* TinyLQG: the control law with limits that are foreseen (model predictive control). Conventions: lqg/lqg.h.
 * Derivations: src/README.md.
 *
 *     u_k = −K x_k + v_k,   J = x₀ᵀ X x₀ + Σ v_kᵀ (R + BᵀXB) v_k      X: the Riccati solution; so J is that of all time
 *     z = F x + G m,        low ≤ z ≤ high                                limited quantities, now and ahead
 *
 * F x is what the law alone will do with the limited quantities z, G is their Gram matrix in the metric of J. The
 * smallest J within the limits has a multiplier m_i ≥ 0 where z_i = low_i, m_i ≤ 0 where z_i = high_i, and m_i = 0
 * elsewhere. Rows 0 … nu − 1 of z are u of this sample; what is left is any limited quantity of this sample or a later
 * one. A soft row, that may exceed its limit by e at the price p e², has 1/p on top of G_ii.
 *
 * Where no limit is in the way, m = 0 and u = −K x, bit for bit. Nothing is kept from sample to sample: u is a function
 * of x, and of u[k−1] where its change is limited. The numbers come from `lqgen`, or from your own matrices.
 */
#ifndef LQG_MPC_H
#define LQG_MPC_H

#include "lqg/arithmetic.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_mpc_control LQG_VARIANT(lqg_mpc_control)
#define lqg_mpc_limit LQG_VARIANT(lqg_mpc_limit)

/* A law with limits, constant: may lie in flash. */
typedef struct {
    unsigned nx;               /* states, ≥ 1 */
    unsigned nu;               /* inputs, ≥ 1 */
    unsigned rows;             /* limited quantities, nu ≤ rows ≤ 255 */
    unsigned iterations;       /* changes of the set of active limits, at most */
    const lqg_real *K;         /* nu × nx, input per state; lqg_mpc_limit does without */
    const lqg_real *F;         /* (rows − nu) × nx: of the rows after the inputs; MAY be NULL when there are none */
    const lqg_real *G;         /* rows × rows, symmetric, positive semidefinite, G_ii > 0 */
    const lqg_real *scale;     /* rows, 1/√G_ii */
    const lqg_real *low;       /* rows, finite or −∞ */
    const lqg_real *high;      /* rows, finite or +∞, ≥ low */
    const lqg_real *tolerance; /* rows, ≥ 0, in units of z: a smaller violation is none */
    const lqg_real *u_step;    /* nu, ≥ 0, largest |u[k] − u[k−1]|; NULL: any */
} lqg_mpc_t;

/* Scratch, but for u_applied: nothing in it is kept from call to call. */
typedef struct {
    const lqg_real *u_applied;  /* nu, u[k−1], kept by the caller; MAY be NULL without u_step */
    lqg_real *f;                /* rows, F x */
    lqg_real *narrowed;         /* 2 rows, low and high of this sample; MAY be NULL without u_step */
    lqg_real *L;                /* LQG_MPC_L(rows), strict lower triangle: G of the active rows is L diag(d) Lᵀ */
    lqg_real *d;                /* rows */
    lqg_real *y;                /* rows, L y = limits − f */
    lqg_real *m;                /* rows, multipliers of the active rows */
    lqg_real *next;             /* rows, where m goes */
    unsigned char *active;      /* rows, the active rows in the order of L */
    unsigned char *side;        /* rows, of each row: 0 where it is not active, 1 at its low limit, 2 at its high one */
    const lqg_real *low;        /* rows, lower limits of this sample: the description's, or narrowed */
    const lqg_real *high;       /* rows, upper ones, likewise */
} lqg_mpc_state_t;

/* A static state and its memory; numbers of reals and of bytes; an initializer of a state over
 * memory[LQG_MPC_MEMORY], set[LQG_MPC_SET]. `applied` is u_applied. */
#define LQG_MPC_STATE(state, applied, rows)                                                                          \
    static lqg_real state##_memory[LQG_MPC_MEMORY(rows)];                                                            \
    static unsigned char state##_set[LQG_MPC_SET(rows)];                                                             \
    static lqg_mpc_state_t state = LQG_MPC_STATE_IN(state##_memory, state##_set, applied, rows)
#define LQG_MPC_L(rows)      ((rows) * ((rows) - 1) / 2)
#define LQG_MPC_MEMORY(rows) (7 * (rows) + LQG_MPC_L(rows))
#define LQG_MPC_SET(rows)    (2 * (rows))
#define LQG_MPC_STATE_IN(memory, set, applied, rows)                                                                 \
    {                                                                                                                \
        (applied), (memory), (memory) + 5 * (rows), (memory) + 7 * (rows), (memory) + (rows), (memory) + 2 * (rows), \
            (memory) + 3 * (rows), (memory) + 4 * (rows), (set), (set) + (rows), 0, 0                                \
    }

/* u = −K x + v with the smallest J within the limits: low ≤ u ≤ high and, as far as these let it, |u − u[k−1]| ≤
 * u_step exactly; the other rows within their tolerance. An active limit of u is met exactly.
 *
 * x  in: the state or its estimate
 * u  out: finite and within its limits, whatever x and u_applied are; MUST NOT overlap x; MAY be u_applied
 *
 * Status: LQG_NOT_OPTIMAL where `iterations` changes were not enough or limits contradict each other: then u is −K x,
 * clipped; or where numbers were too large: an input that would not be finite is 0, clipped. LQG_INPUT_LIMITED when an
 * input is at a limit that holds it, or would not be finite.
 * Cost in multiply-adds: rows·nx and rows comparisons; for each change with n active rows 2 n² + rows·n more, and 2 n
 * divisions. At most `iterations` + 1 of these.
 * Source: D. Goldfarb, A. Idnani: A numerically stable dual method for solving strictly convex quadratic programs.
 * Mathematical Programming 27 (1983), 1–33; as in D. Arnström, A. Bemporad, D. Axehill: A dual active-set solver for
 * embedded quadratic programming using recursive LDLᵀ updates. IEEE Transactions on Automatic Control 67 (2022),
 * 4362–4369. */
lqg_status_t lqg_mpc_control(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[/* nx */],
                             lqg_real u[/* nu */]);

/* The same for a law that the caller has evaluated: with references, an integral, in straight-line code.
 *
 * x  in: what F multiplies
 * u  in: the law's u, without limits; out: as above; MUST NOT be u_applied */
lqg_status_t lqg_mpc_limit(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[/* nx */],
                           lqg_real u[/* nu */]);

#ifdef __cplusplus
}
#endif

#endif
