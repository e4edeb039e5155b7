/* SPDX-License-Identifier: MIT */
/* TinyLQG: Kalman filters. Conventions of all functions: lqg/lqg.h. Derivations: src/README.md.
 *
 *     x⁺ = A x + B u + w,    y = C x + D u + v
 *
 * Three filters, each with init, predict, and the update in three shapes: of all outputs; watched, of some of
 * them, with a gate and a look inside; of one output alone:
 *
 *   lqg_kalman_steady_*   The gain L is constant and was found beforehand: the cheapest.
 *   lqg_kalman_plain_*    The covariance P of the estimate's error is carried along: a gain for every sample.
 *   lqg_kalman_ud_*       P is carried as U diag(d) Uᵀ: the same gain, and P cannot lose its definiteness.
 *
 * The state of a filter is a few arrays of the caller, the same in every call:
 *
 *   x[nx]           the estimate
 *   P, or U and d   its covariance
 *   u_applied[nu]   the input applied last, for D u; MAY be NULL when D is NULL
 *   innovation[ny]  the last innovation, kept for the next `predict`, for M; MAY be NULL when M is NULL
 *
 * A reset (LQG_STATE_RESET) is an init: it restores all of them. It happens when, after an update or a prediction,
 *
 *     Σ (x̂_i/b_i)² < 1
 *
 * does not hold, or any of these numbers is not finite. The bounds b are those of the description, and SHOULD be
 * powers of two. Without them it happens when a number is not finite, or their sum is not. So x̂ is within its bounds,
 * and finite, after every call.
 *
 * P alone begins anew (LQG_COVARIANCE_RESET), and x̂ stays, when P cannot be a covariance: when after a prediction a
 * variance P_ii (of U diag(d) Uᵀ: d_i) is negative, or
 *
 *     Σ (x̂_i/b_i)² + Σ P_ii/b_i² < 1
 *
 * does not hold, or U is not finite; and when in an update C P Cᵀ + V of an output is not positive.
 *
 * Outputs that are not believable, because the innovation y − C x̂ − D u is NaN, infinite or not below its limit, are
 * left out (LQG_OUTPUT_NOT_FINITE): no state can explain them, so they say nothing, and x̂ is not lost over them.
 *
 * Sensors of several rates: `predict` is called once a period, an update whenever there is something to
 * update with: any number of predictions may lie between two updates. Plants that vary: the description is
 * read afresh in every call, so another one of the same dimensions, or one with other matrices, MAY be passed
 * in each.
 */
#ifndef LQG_KALMAN_H
#define LQG_KALMAN_H

#include "lqg/arithmetic.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Lengths of triangles.
 * A symmetric matrix is kept as its lower triangle, row by row: P_ij at P[i*(i+1)/2 + j], j ≤ i.
 * U is kept as its strict upper triangle, column by column: U_kj at U[j*(j-1)/2 + k], k < j; NULL with nx =
 * 1. */
#define LQG_TRIANGLE(n) ((n) * ((n) + 1) / 2)
#define LQG_STRICT_TRIANGLE(n) ((n) * ((n)-1) / 2)
#define LQG_LARGER(a, b) ((a) > (b) ? (a) : (b))

/* The plant, constant: may lie in flash. */
typedef struct {
    unsigned nx;        /* states, ≥ 1 */
    unsigned nu;        /* inputs, ≥ 0 */
    unsigned ny;        /* outputs, ≥ 1 */
    const lqg_real *A;  /* nx × nx */
    const lqg_real *B;  /* nx × nu; NULL when nu is 0 */
    const lqg_real *C;  /* ny × nx */
    const lqg_real *D;  /* ny × nu; NULL: 0 */
} lqg_plant_t;

/* What an update is told beyond the outputs, and what it tells. Every field MAY be 0 or NULL.
 *
 * The gate opens again for an output that it leaves out in sample after sample: then x̂ is wrong, and not the sensor.
 * widening_i, w here, begins with 1, or with more where the filter starts from a P0 that its constant gain knows nothing
 * of. It is multiplied by widen_i (> 1) in a sample in which the output was gated, and with a constant gain in one in which it
 * was not believable or not used; by narrow_i (< 1) in one in which it was heard; and is kept within [1, 2⁸⁰]. Without
 * widening the gate stays as it is, and an x̂ that is far off is never put right. */
typedef struct {
    const unsigned char *used; /* ny, 0: the output is left out, and not reported; NULL: all are used */
    lqg_real gate;             /* σ, > 0: an output with |ν| > gate √(s w) is left out; 0: no gate */
    unsigned long *gated;      /* ny, in and out: how often the gate left the output out */
    lqg_real *nu; /* ny, out: the innovation of each output that is used, 0 when it is not believable */
    lqg_real *s;  /* ny, out: its variance */
    lqg_real *widening;        /* ny, in and out, with a gate: w of each output; NULL: 1 */
    const lqg_real *widen;     /* ny: MUST be there with widening */
    const lqg_real *narrow;    /* ny: likewise */
    unsigned char *heard;      /* ny, out: 1 where the output was used, else 0 */
} lqg_watch_t;

/* ------------------------------------------------------------------------------------------ constant gain */

#define lqg_kalman_steady_init LQG_VARIANT(lqg_kalman_steady_init)
#define lqg_kalman_steady_update LQG_VARIANT(lqg_kalman_steady_update)
#define lqg_kalman_steady_update_watched LQG_VARIANT(lqg_kalman_steady_update_watched)
#define lqg_kalman_steady_update_output LQG_VARIANT(lqg_kalman_steady_update_output)
#define lqg_kalman_steady_predict LQG_VARIANT(lqg_kalman_steady_predict)

typedef struct {
    lqg_plant_t plant;
    const lqg_real *L;   /* nx × ny, filter gain P Cᵀ S⁻¹, P prior, S = C P Cᵀ + V */
    const lqg_real *M;   /* nx × ny, E[w vᵀ] S⁻¹; NULL: w and v are uncorrelated */
    const lqg_real *x0; /* nx, first estimate; NULL: 0 */
    const lqg_real *x_scale; /* nx, 1/b_i of the bounds |x̂_i| < b_i; NULL: finite is enough */
    const lqg_real *innovation_limit; /* ny, a larger innovation is not believed; NULL: a finite one is */
} lqg_kalman_steady_t;

/* Length of work[]. */
#define LQG_KALMAN_STEADY_WORK(nx, ny) LQG_LARGER(nx, ny)

/* x̂ = x0; nothing applied yet. */
void lqg_kalman_steady_init(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                            lqg_real innovation[]);

/* x̂ ← x̂ + L (y − C x̂ − D u)
 *
 * y[ny]  in: what the sensors say; an output that is not believable is left out
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_STATE_RESET.
 * Cost: 2·nx·ny multiply-adds, with D ny·nu more. */
lqg_status lqg_kalman_steady_update(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                    lqg_real innovation[], const lqg_real y[], lqg_real work[]);

/* The same, of some outputs, with a gate: an output left out is treated as an innovation of 0.
 *
 * y[ny]  in: outputs that are not used are not looked at
 * s[ny]  in: variances of the innovations, the diagonal of S; MAY be NULL without a gate
 * watch  MAY be NULL; its s is a copy of this one
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
lqg_status lqg_kalman_steady_update_watched(const lqg_kalman_steady_t *kalman, lqg_real x[],
                                            lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                            const lqg_real s[], const lqg_watch_t *watch, lqg_real work[]);

/* x̂ ← x̂ + L_i (y_i − C_i x̂ − D_i u), L_i column i of L. An approximation: L_i is the best gain in the company
 * of the other outputs only. Calls for several outputs of one sample are not their common update either: that
 * is `watched`.
 *
 * s, watch  as above; watch->used is not looked at
 *
 * Status: as above. Cost: 2·nx multiply-adds, with D nu more. */
lqg_status lqg_kalman_steady_update_output(const lqg_kalman_steady_t *kalman, lqg_real x[],
                                           lqg_real u_applied[], lqg_real innovation[], unsigned i,
                                           lqg_real y_i, const lqg_real s[], const lqg_watch_t *watch);

/* x̂ ← A x̂ + B u + M (innovation of the last update)
 *
 * u[nu]  in: what was applied; MAY be u_applied itself, or NULL when nu is 0
 *
 * Status: LQG_STATE_RESET.
 * Cost: nx·(nx + nu) multiply-adds, with M nx·ny more. */
lqg_status lqg_kalman_steady_predict(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                     lqg_real innovation[], const lqg_real u[], lqg_real work[]);

/* ---------------------------------------------------------------------------- covariance carried as it is */

#define lqg_kalman_plain_init LQG_VARIANT(lqg_kalman_plain_init)
#define lqg_kalman_plain_update LQG_VARIANT(lqg_kalman_plain_update)
#define lqg_kalman_plain_update_watched LQG_VARIANT(lqg_kalman_plain_update_watched)
#define lqg_kalman_plain_update_output LQG_VARIANT(lqg_kalman_plain_update_output)
#define lqg_kalman_plain_predict LQG_VARIANT(lqg_kalman_plain_predict)

/* Outputs are taken one after the other, which needs noises that are uncorrelated among themselves. Where the
 * covariance of v is not diagonal, E makes it so: y' = E y = C x + D u + v' has the noise covariance diag(V).
 * C and D of the plant are then those of y', E times those of y. */
typedef struct {
    lqg_plant_t plant;
    const lqg_real *E;       /* ny × ny, unit lower triangular; NULL: identity */
    const lqg_real *V;       /* ny, variances of the noises of y', > 0 */
    const lqg_real *W;       /* lower triangle nx × nx: E[w wᵀ] − M diag(V) Mᵀ */
    const lqg_real *M;       /* nx × ny, E[w v'ᵀ] diag(V)⁻¹; NULL: w and v are uncorrelated */
    const lqg_real *A_free;  /* nx × nx, A − M C; NULL when M is NULL */
    const lqg_real *x0;     /* nx, first estimate; NULL: 0 */
    const lqg_real *P0;      /* lower triangle nx × nx, its covariance */
    const lqg_real *x_scale; /* nx, 1/b_i of the bounds |x̂_i| < b_i; NULL: finite is enough */
    const lqg_real *innovation_limit; /* ny, a larger innovation is not believed; NULL: a finite one is */
} lqg_kalman_plain_t;

/* Lengths of P[] and of work[]. */
#define LQG_KALMAN_PLAIN_P(nx) LQG_TRIANGLE(nx)
#define LQG_KALMAN_PLAIN_WORK(nx, ny) LQG_LARGER((nx) * (nx), (nx) + (ny))

/* x̂ = x0, P = P0; nothing applied yet. */
void lqg_kalman_plain_init(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[], lqg_real u_applied[],
                           lqg_real innovation[]);

/* For each output i, with the row c of C and the variance v of V:
 *
 *     s = c P cᵀ + v,   gain = P cᵀ / s,   x̂ ← x̂ + gain (y'_i − c x̂ − D_i u),   P ← P − gain (P cᵀ)ᵀ
 *
 * y[ny]  in: what the sensors say; an output that is not believable, or whose s is not positive, is left out
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_INNOVATION_NOT_POSITIVE, LQG_COVARIANCE_RESET, LQG_STATE_RESET.
 * Cost: ny·(3·nx² + 9·nx)/2 multiply-adds, ny divisions;
 * with D ny·nu more, with M ny·nx (and with D ny·nu) more, with E ny·(ny − 1)/2 more. */
lqg_status lqg_kalman_plain_update(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                   lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                   lqg_real work[]);

/* The same, of some outputs, with a gate: exact, as if those left out were not there in this sample. The
 * innovation of an output and its variance are those given the outputs before it.
 *
 * y[ny]  in: outputs that are not used are not looked at
 * watch  MAY be NULL
 *
 * Status: LQG_OUTPUT_NOT_FINITE (also when E asks for an output that is not used), LQG_OUTPUT_GATED,
 * LQG_INNOVATION_NOT_POSITIVE, LQG_COVARIANCE_RESET, LQG_STATE_RESET. */
lqg_status lqg_kalman_plain_update_watched(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                           lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                           const lqg_watch_t *watch, lqg_real work[]);

/* The same, of output i alone. Calls for all outputs one after the other are the update of all of them, to
 * the bit, when E and M are NULL. With E, y_i is left out unless row i of E is that of an identity; with M
 * there MUST be at most one call between two predictions.
 *
 * watch  MAY be NULL; watch->used is not looked at
 *
 * Status: as above. */
lqg_status lqg_kalman_plain_update_output(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                          lqg_real u_applied[], lqg_real innovation[], unsigned i,
                                          lqg_real y_i, const lqg_watch_t *watch, lqg_real work[]);

/* x̂ ← A x̂ + B u + M (y' − C x̂ − D u after the last update),   P ← A_free P A_freeᵀ + W
 *
 * u[nu]  in: what was applied; MAY be u_applied itself, or NULL when nu is 0
 *
 * Status: LQG_STATE_RESET, LQG_COVARIANCE_RESET.
 * Cost: (3·nx³ + nx²)/2 + nx·(nx + nu) multiply-adds, with M nx·ny more. */
lqg_status lqg_kalman_plain_predict(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                    lqg_real u_applied[], lqg_real innovation[], const lqg_real u[],
                                    lqg_real work[]);

/* ----------------------------------------------------------------- covariance carried as P = U diag(d) Uᵀ */

#define lqg_kalman_ud_init LQG_VARIANT(lqg_kalman_ud_init)
#define lqg_kalman_ud_update LQG_VARIANT(lqg_kalman_ud_update)
#define lqg_kalman_ud_update_watched LQG_VARIANT(lqg_kalman_ud_update_watched)
#define lqg_kalman_ud_update_output LQG_VARIANT(lqg_kalman_ud_update_output)
#define lqg_kalman_ud_predict LQG_VARIANT(lqg_kalman_ud_predict)

typedef struct {
    lqg_plant_t plant;
    const lqg_real *E;       /* ny × ny, unit lower triangular; NULL: identity; see lqg_kalman_plain_t */
    const lqg_real *V;       /* ny, variances of the noises of y', > 0 */
    unsigned nq;             /* independent process noises, ≥ 0 */
    const lqg_real *G;       /* nx × nq, where they enter: G diag(w) Gᵀ = E[w wᵀ] − M diag(V) Mᵀ */
    const lqg_real *w;       /* nq, their variances, ≥ 0 */
    const lqg_real *M;       /* nx × ny, E[w v'ᵀ] diag(V)⁻¹; NULL: w and v are uncorrelated */
    const lqg_real *A_free;  /* nx × nx, A − M C; NULL when M is NULL */
    const lqg_real *x0;     /* nx, first estimate; NULL: 0 */
    const lqg_real *U0;      /* strict upper triangle nx × nx; its covariance is U0 diag(d0) U0ᵀ */
    const lqg_real *d0;      /* nx, ≥ 0 */
    const lqg_real *x_scale; /* nx, 1/b_i of the bounds |x̂_i| < b_i; NULL: finite is enough */
    const lqg_real *innovation_limit; /* ny, a larger innovation is not believed; NULL: a finite one is */
} lqg_kalman_ud_t;

/* Lengths of U[] (NULL when 0) and of work[]; d[] has nx numbers. */
#define LQG_KALMAN_UD_U(nx) LQG_STRICT_TRIANGLE(nx)
#define LQG_KALMAN_UD_WORK(nx, ny, nq) LQG_LARGER(((nx) + 2) * ((nx) + (nq)), (nx) + (ny))

/* x̂ = x0, P = U0 diag(d0) U0ᵀ; nothing applied yet. */
void lqg_kalman_ud_init(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                        lqg_real u_applied[], lqg_real innovation[]);

/* The update of lqg_kalman_plain_update, in the factors of P (Bierman 1977). Whatever the rounding, d stays ≥
 * 0.
 *
 * y[ny]  in: what the sensors say; an output that is not believable is left out
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_STATE_RESET.
 * Cost: ny·(3·nx² + 13·nx)/2 multiply-adds, ny·(nx + 1) divisions;
 * with D ny·nu more, with M ny·nx (and with D ny·nu) more, with E ny·(ny − 1)/2 more. */
lqg_status lqg_kalman_ud_update(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                                lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                lqg_real work[]);

/* The same, of some outputs, with a gate: exact, as if those left out were not there in this sample. The
 * innovation of an output and its variance are those given the outputs before it.
 *
 * y[ny]  in: outputs that are not used are not looked at
 * watch  MAY be NULL
 *
 * Status: LQG_OUTPUT_NOT_FINITE (also when E asks for an output that is not used), LQG_OUTPUT_GATED,
 * LQG_STATE_RESET. Cost: with a watch ny·nx multiply-adds more. */
lqg_status lqg_kalman_ud_update_watched(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[],
                                        lqg_real d[], lqg_real u_applied[], lqg_real innovation[],
                                        const lqg_real y[], const lqg_watch_t *watch, lqg_real work[]);

/* The same, of output i alone. Calls for all outputs one after the other are the update of all of them, to
 * the bit, when E and M are NULL. With E, y_i is left out unless row i of E is that of an identity; with M
 * there MUST be at most one call between two predictions.
 *
 * watch  MAY be NULL; watch->used is not looked at
 *
 * Status: as above. */
lqg_status lqg_kalman_ud_update_output(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[],
                                       lqg_real d[], lqg_real u_applied[], lqg_real innovation[], unsigned i,
                                       lqg_real y_i, const lqg_watch_t *watch, lqg_real work[]);

/* The prediction of lqg_kalman_plain_predict, in the factors of P (Thornton 1976).
 *
 * u[nu]  in: what was applied; MAY be u_applied itself, or NULL when nu is 0
 *
 * Status: LQG_STATE_RESET, LQG_COVARIANCE_RESET.
 * Cost: (nx − 1)·nx·(nx + 1)/2 + nx·(nx + 1)·(nx + nq) + nx·(nx + nu) multiply-adds, nx divisions;
 * with M nx·ny more. */
lqg_status lqg_kalman_ud_predict(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                                 lqg_real u_applied[], lqg_real innovation[], const lqg_real u[],
                                 lqg_real work[]);

#ifdef __cplusplus
}
#endif

#endif
