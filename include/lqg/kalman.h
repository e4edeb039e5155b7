/* SPDX-License-Identifier: MIT */
/* TinyLQG: Kalman filters. Conventions of all functions: lqg/lqg.h. Derivations: src/README.md.
 *
 *     x⁺ = A x + B u + w,    y = C x + D u + v
 *
 *   lqg_kalman_steady_*   The gain L is constant and was found beforehand: the cheapest.
 *   lqg_kalman_plain_*    The covariance P of the estimate's error is updated on line: a gain for every sample.
 *   lqg_kalman_ud_*       P is kept as U diag(d) Uᵀ: the same gain, and P cannot lose its definiteness.
 *
 * Each has the same five functions. A sample is update, then predict:
 *
 *     static const lqg_kalman_ud_t filter = {…};        in flash
 *     LQG_KALMAN_UD_STATE(state, 4, 1, 2, 1);           its state: nx, nu, ny, nw
 *
 *     lqg_kalman_ud_init(&filter, &state);              once
 *     status = lqg_kalman_ud_update(&filter, &state, y);
 *     status |= lqg_kalman_ud_predict(&filter, &state, u);
 *
 * Reset: LQG_STATE_RESET means that x̂ and P are again those of `init`. It happens when, after an update or a
 * prediction, a number is not finite, or
 *
 *     Σ (x̂_i/b_i)² < 1
 *
 * does not hold. The bounds b are those of the description and SHOULD be powers of two. So x̂ is finite and within its
 * bounds after every call.
 *
 * LQG_COVARIANCE_RESET: P alone is again P0, and x̂ stays. It happens when P cannot be a covariance: after a prediction
 * P_ii (with factors: d_i) is negative, or U is not finite, or
 *
 *     Σ (x̂_i/b_i)² + Σ P_ii/b_i² < 1
 *
 * does not hold; or when in an update of the plain filter C P Cᵀ + V of an output is not positive.
 *
 * Rejected outputs: an output whose innovation y − C x̂ − D u is NaN, infinite or not below its limit is not used
 * (LQG_OUTPUT_REJECTED), as no state can explain it.
 *
 * Several rates: `predict` is called once a period, and an update whenever there is an output; any number of
 * predictions may lie between two updates. Plants that vary: each call reads the description anew, so another one with
 * the same dimensions MAY be passed each time.
 */
#ifndef LQG_KALMAN_H
#define LQG_KALMAN_H

#include <stddef.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Triangles. A symmetric matrix is kept as its lower triangle, row by row: P_ij at P[i*(i+1)/2 + j], j ≤ i.
 * U is kept as its strict upper triangle, column by column: U_kj at U[j*(j-1)/2 + k], k < j. */
#define LQG_TRIANGLE(n)        ((n) * ((n) + 1) / 2)
#define LQG_STRICT_TRIANGLE(n) ((n) * ((n) - 1) / 2)
#define LQG_LARGER(a, b)       ((a) > (b) ? (a) : (b))

/* The plant, constant: may lie in flash. */
typedef struct {
    unsigned nx;        /* states, ≥ 1 */
    unsigned nu;        /* inputs, ≥ 0 */
    unsigned ny;        /* outputs, ≥ 1 */
    const lqg_real *A;  /* nx × nx */
    const lqg_real *B;  /* nx × nu; NULL when nu is 0 */
    const lqg_real *C;  /* ny × nx */
    const lqg_real *D;  /* ny × nu; NULL: 0 */

    /* NULL: A has all its entries. Else A is only those that may differ from 0, row by row, for nx from 4 to 255: of
     * each row their number, then their columns, ascending. The same holds for an A_free. Products with the others are
     * left out, as in straight-line code. */
    const unsigned char *pattern;
} lqg_plant_t;

/* ------------------------------------------------------------------------------------------- gate and watch */

/* A gate, constant: may lie in flash. An output with |innovation| > sigma √(s widening) is not used, s its variance.
 *
 * widening is 1 as long as all is well. It is multiplied by widen in a sample in which the gate leaves the output out
 * (with a constant gain: in which it is not used for any reason), by narrow in one in which the output is used, and is
 * kept within [1, 2⁸⁰]. So the gate opens for an output that is left out for long: then x̂ is wrong, not the sensor.
 * Without widening an x̂ that is far off is never corrected. */
typedef struct {
    lqg_real sigma;         /* standard deviations, > 0 */
    const lqg_real *start;  /* ny, widening after init and a reset, ≥ 1; NULL: 1 */
    const lqg_real *widen;  /* ny, > 1; NULL: the gate keeps its width */
    const lqg_real *narrow; /* ny, < 1; NULL when widen is */
} lqg_gate_t;

/* What a gate remembers. */
typedef struct {
    lqg_real *widening;     /* ny, 0 counts as 1; MAY be NULL when there is no gate, or widen is NULL */
    unsigned long *gated;   /* ny, how often the gate left each output out, begun by the caller; NULL: not counted */
} lqg_gate_state_t;

/* What an update tells of itself. Each array MAY be NULL, and is then not written. */
typedef struct {
    lqg_real *innovation;   /* ny, out: of each output that is used or gated; 0 elsewhere */
    lqg_real *S;            /* ny, out: its variance */
    unsigned char *heard;   /* ny, out: 1 where the output was used, else 0 */
} lqg_watch_t;

/* Which outputs are used: an unsigned long, 1uL << i for output i. Outputs from the 33rd on have no bit and are always
 * used. */
#define LQG_ALL_OUTPUTS (~0uL)

/* ------------------------------------------------------------------------------------------ constant gain */

#define lqg_kalman_steady_init           LQG_VARIANT(lqg_kalman_steady_init)
#define lqg_kalman_steady_update         LQG_VARIANT(lqg_kalman_steady_update)
#define lqg_kalman_steady_partial_update LQG_VARIANT(lqg_kalman_steady_partial_update)
#define lqg_kalman_steady_update_output  LQG_VARIANT(lqg_kalman_steady_update_output)
#define lqg_kalman_steady_predict        LQG_VARIANT(lqg_kalman_steady_predict)

/* Constant: may lie in flash. */
typedef struct {
    lqg_plant_t plant;
    const lqg_real *L;                /* nx × ny, filter gain P Cᵀ S⁻¹, P prior, S = C P Cᵀ + V */
    const lqg_real *M;                /* nx × ny, E[w vᵀ] S⁻¹; NULL: w and v are uncorrelated */
    const lqg_real *x0;               /* nx, first estimate; NULL: 0 */
    const lqg_real *x_scale;          /* nx, 1/b_i of the bounds |x̂_i| < b_i; NULL: finite is enough */
    const lqg_real *innovation_limit; /* ny, a larger innovation is rejected; NULL: any finite one is used */
    const lqg_gate_t *gate;           /* NULL: no gate */
    const lqg_real *S;                /* ny, diagonal of S; MAY be NULL when there is no gate */
} lqg_kalman_steady_t;

typedef struct {
    lqg_real *x;           /* nx, the estimate */
    lqg_real *u_applied;   /* nu, the last input, for D u; MAY be NULL when D is NULL */
    lqg_real *innovation;  /* ny, the last innovation, for M; MAY be NULL when M is NULL */
    lqg_gate_state_t gate;
    lqg_real *work;        /* LQG_KALMAN_STEADY_WORK, scratch */
} lqg_kalman_steady_state_t;

/* A static state and its memory; numbers of reals; an initializer of a state over memory[LQG_…_MEMORY]. */
#define LQG_KALMAN_STEADY_STATE(state, nx, nu, ny)                                                                   \
    static lqg_real state##_memory[LQG_KALMAN_STEADY_MEMORY(nx, nu, ny)];                                            \
    static lqg_kalman_steady_state_t state = LQG_KALMAN_STEADY_STATE_IN(state##_memory, nx, nu, ny)
#define LQG_KALMAN_STEADY_WORK(nx, ny)       LQG_LARGER(nx, ny)
#define LQG_KALMAN_STEADY_MEMORY(nx, nu, ny) ((nx) + (nu) + 2 * (ny) + LQG_KALMAN_STEADY_WORK(nx, ny))
#define LQG_KALMAN_STEADY_STATE_IN(memory, nx, nu, ny)                                                               \
    {                                                                                                                \
        (memory), (memory) + (nx), (memory) + (nx) + (nu), {(memory) + (nx) + (nu) + (ny), NULL},                    \
            (memory) + (nx) + (nu) + 2 * (ny)                                                                        \
    }

/* x̂ = x0; nothing applied yet. */
void lqg_kalman_steady_init(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state);

/* x̂ ← x̂ + L (y − C x̂ − D u)
 *
 * y  in: the outputs. One that is rejected or gated counts as an innovation of 0.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_STATE_RESET.
 * Cost: 2·nx·ny multiply-adds, with D ny·nu more. */
lqg_status_t lqg_kalman_steady_update(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                      const lqg_real y[/* ny */]);

/* The same with some of the outputs; the others count as innovations of 0.
 *
 * y      in: outputs that are not used are not read
 * used   in: a bit for each output, 1uL << i; or LQG_ALL_OUTPUTS
 * watch  what is told; MAY be NULL */
lqg_status_t lqg_kalman_steady_partial_update(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                              const lqg_real y[/* ny */], unsigned long used,
                                              const lqg_watch_t *watch);

/* x̂ ← x̂ + L_i (y_i − C_i x̂ − D_i u), L_i column i of L. An approximation: L_i is optimal only together with the
 * other outputs, and several such calls in one sample are not their common update.
 *
 * y_i  in: output i alone, a pointer so that it is not mistaken for i; i < ny
 *
 * Cost: 2·nx multiply-adds, with D nu more. */
lqg_status_t lqg_kalman_steady_update_output(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                             const lqg_real *y_i, unsigned i, const lqg_watch_t *watch);

/* x̂ ← A x̂ + B u + M (innovation of the last update)
 *
 * u  in: what was applied; MAY be u_applied itself, or NULL when nu is 0
 *
 * Status: LQG_STATE_RESET.
 * Cost: nx·(nx + nu) multiply-adds, with M nx·ny more. */
lqg_status_t lqg_kalman_steady_predict(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                       const lqg_real u[/* nu */]);

/* --------------------------------------------------------------------------------- covariance kept as it is */

#define lqg_kalman_plain_init           LQG_VARIANT(lqg_kalman_plain_init)
#define lqg_kalman_plain_update         LQG_VARIANT(lqg_kalman_plain_update)
#define lqg_kalman_plain_partial_update LQG_VARIANT(lqg_kalman_plain_partial_update)
#define lqg_kalman_plain_update_output  LQG_VARIANT(lqg_kalman_plain_update_output)
#define lqg_kalman_plain_predict        LQG_VARIANT(lqg_kalman_plain_predict)

/* Constant: may lie in flash. Outputs are processed one after the other, which needs noises that are uncorrelated among
 * themselves. Where the covariance of v is not diagonal, E makes it so: y' = E y = C x + D u + v' has the noise
 * covariance diag(V). C and D of the plant are then those of y', E times those of y. */
typedef struct {
    lqg_plant_t plant;
    const lqg_real *E;                /* ny × ny, unit lower triangular; NULL: identity */
    const lqg_real *V;                /* ny, variances of the noises of y', > 0 */
    const lqg_real *W;                /* lower triangle nx × nx: E[w wᵀ] − M diag(V) Mᵀ */
    const lqg_real *M;                /* nx × ny, E[w v'ᵀ] diag(V)⁻¹; NULL: w and v are uncorrelated */
    const lqg_real *A_free;           /* nx × nx, A − M C; NULL when M is NULL */
    const lqg_real *x0;               /* nx, first estimate; NULL: 0 */
    const lqg_real *P0;               /* lower triangle nx × nx, its covariance */
    const lqg_real *x_scale;          /* nx, 1/b_i of the bounds |x̂_i| < b_i; NULL: finite is enough */
    const lqg_real *innovation_limit; /* ny, a larger innovation is rejected; NULL: any finite one is used */
    const lqg_gate_t *gate;           /* NULL: no gate */
} lqg_kalman_plain_t;

typedef struct {
    lqg_real *x;           /* nx, the estimate */
    lqg_real *P;           /* LQG_TRIANGLE(nx), covariance of its error */
    lqg_real *u_applied;   /* nu, the last input, for D u; MAY be NULL when D is NULL */
    lqg_real *innovation;  /* ny, what y' leaves after the update, for M; MAY be NULL when M is NULL */
    lqg_gate_state_t gate;
    lqg_real *work;        /* LQG_KALMAN_PLAIN_WORK, scratch */
} lqg_kalman_plain_state_t;

/* A static state and its memory; numbers of reals; an initializer of a state over memory[LQG_…_MEMORY]. */
#define LQG_KALMAN_PLAIN_STATE(state, nx, nu, ny)                                                                    \
    static lqg_real state##_memory[LQG_KALMAN_PLAIN_MEMORY(nx, nu, ny)];                                             \
    static lqg_kalman_plain_state_t state = LQG_KALMAN_PLAIN_STATE_IN(state##_memory, nx, nu, ny)
#define LQG_KALMAN_PLAIN_WORK(nx, ny) LQG_LARGER((nx) * (nx) + 4 * (nx), (nx) + (ny))
#define LQG_KALMAN_PLAIN_MEMORY(nx, nu, ny)                                                                          \
    ((nx) + LQG_TRIANGLE(nx) + (nu) + 2 * (ny) + LQG_KALMAN_PLAIN_WORK(nx, ny))
#define LQG_KALMAN_PLAIN_STATE_IN(memory, nx, nu, ny)                                                                \
    {                                                                                                                \
        (memory), (memory) + (nx), (memory) + (nx) + LQG_TRIANGLE(nx), (memory) + (nx) + LQG_TRIANGLE(nx) + (nu),    \
            {(memory) + (nx) + LQG_TRIANGLE(nx) + (nu) + (ny), NULL},                                                \
            (memory) + (nx) + LQG_TRIANGLE(nx) + (nu) + 2 * (ny)                                                     \
    }

/* x̂ = x0, P = P0; nothing applied yet. */
void lqg_kalman_plain_init(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state);

/* For each output i, with the row c of C:
 *
 *     s = c P cᵀ + V_i,   gain = P cᵀ / s,   x̂ ← x̂ + gain (y'_i − c x̂ − D_i u),   P ← P − gain (P cᵀ)ᵀ
 *
 * y  in: the outputs. One that is rejected or gated, or whose s is not positive, is not used.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_INNOVATION_NOT_POSITIVE, LQG_COVARIANCE_RESET, LQG_STATE_RESET.
 * Cost: ny·(3·nx² + 9·nx)/2 multiply-adds, ny divisions;
 * with D ny·nu more, with M ny·nx (and with D ny·nu) more, with E ny·(ny − 1)/2 more. */
lqg_status_t lqg_kalman_plain_update(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                     const lqg_real y[/* ny */]);

/* The same with some of the outputs: exact, as if the others did not exist in this sample. The innovation of an output
 * and its variance are those given the outputs before it.
 *
 * y      in: outputs that are not used are not read
 * used   in: a bit for each output, 1uL << i; or LQG_ALL_OUTPUTS
 * watch  what is told; MAY be NULL
 *
 * Status: LQG_OUTPUT_REJECTED also when E needs an output that is not used. */
lqg_status_t lqg_kalman_plain_partial_update(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                             const lqg_real y[/* ny */], unsigned long used,
                                             const lqg_watch_t *watch);

/* The same with output i alone. When E and M are NULL, calls for all outputs one after the other are the update of all
 * of them, to the bit. With E, y_i is rejected unless row i of E is that of an identity. With M there MUST be at most
 * one call between two predictions.
 *
 * y_i  in: output i alone, a pointer so that it is not mistaken for i; i < ny */
lqg_status_t lqg_kalman_plain_update_output(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                            const lqg_real *y_i, unsigned i, const lqg_watch_t *watch);

/* x̂ ← A x̂ + B u + M (y' − C x̂ − D u after the last update),   P ← A_free P A_freeᵀ + W
 *
 * u  in: what was applied; MAY be u_applied itself, or NULL when nu is 0
 *
 * Status: LQG_STATE_RESET, LQG_COVARIANCE_RESET.
 * Cost: (3·nx³ + nx²)/2 + nx·(nx + nu) multiply-adds, with M nx·ny more. */
lqg_status_t lqg_kalman_plain_predict(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                      const lqg_real u[/* nu */]);

/* -------------------------------------------------------------------- covariance kept as P = U diag(d) Uᵀ */

#define lqg_kalman_ud_init           LQG_VARIANT(lqg_kalman_ud_init)
#define lqg_kalman_ud_update         LQG_VARIANT(lqg_kalman_ud_update)
#define lqg_kalman_ud_partial_update LQG_VARIANT(lqg_kalman_ud_partial_update)
#define lqg_kalman_ud_update_output  LQG_VARIANT(lqg_kalman_ud_update_output)
#define lqg_kalman_ud_predict        LQG_VARIANT(lqg_kalman_ud_predict)

/* Constant: may lie in flash. E, V, M and A_free are those of lqg_kalman_plain_t. */
typedef struct {
    lqg_plant_t plant;
    const lqg_real *E;                /* ny × ny, unit lower triangular; NULL: identity */
    const lqg_real *V;                /* ny, variances of the noises of y', > 0 */
    unsigned nw;                      /* independent process noises, ≥ 0 */
    const lqg_real *G;                /* nx × nw, where they enter: G diag(W) Gᵀ = E[w wᵀ] − M diag(V) Mᵀ */
    const lqg_real *W;                /* nw, their variances, ≥ 0 */
    const lqg_real *M;                /* nx × ny, E[w v'ᵀ] diag(V)⁻¹; NULL: w and v are uncorrelated */
    const lqg_real *A_free;           /* nx × nx, A − M C; NULL when M is NULL */
    const lqg_real *x0;               /* nx, first estimate; NULL: 0 */
    const lqg_real *U0;               /* strict upper triangle nx × nx; its covariance is U0 diag(d0) U0ᵀ */
    const lqg_real *d0;               /* nx, ≥ 0 */
    const lqg_real *x_scale;          /* nx, 1/b_i of the bounds |x̂_i| < b_i; NULL: finite is enough */
    const lqg_real *innovation_limit; /* ny, a larger innovation is rejected; NULL: any finite one is used */
    const lqg_gate_t *gate;           /* NULL: no gate */
} lqg_kalman_ud_t;

typedef struct {
    lqg_real *x;           /* nx, the estimate */
    lqg_real *U;           /* LQG_STRICT_TRIANGLE(nx); MAY be NULL when nx is 1 */
    lqg_real *d;           /* nx, U diag(d) Uᵀ is the covariance of its error */
    lqg_real *u_applied;   /* nu, the last input, for D u; MAY be NULL when D is NULL */
    lqg_real *innovation;  /* ny, what y' leaves after the update, for M; MAY be NULL when M is NULL */
    lqg_gate_state_t gate;
    lqg_real *work;        /* LQG_KALMAN_UD_WORK, scratch */
} lqg_kalman_ud_state_t;

/* A static state and its memory; numbers of reals; an initializer of a state over memory[LQG_…_MEMORY]. */
#define LQG_KALMAN_UD_STATE(state, nx, nu, ny, nw)                                                                   \
    static lqg_real state##_memory[LQG_KALMAN_UD_MEMORY(nx, nu, ny, nw)];                                            \
    static lqg_kalman_ud_state_t state = LQG_KALMAN_UD_STATE_IN(state##_memory, nx, nu, ny, nw)
#define LQG_KALMAN_UD_WORK(nx, ny, nw) LQG_LARGER(((nx) + 2) * ((nx) + (nw)), (nx) + (ny))
#define LQG_KALMAN_UD_MEMORY(nx, nu, ny, nw)                                                                         \
    ((nx) + LQG_TRIANGLE(nx) + (nu) + 2 * (ny) + LQG_KALMAN_UD_WORK(nx, ny, nw))
#define LQG_KALMAN_UD_STATE_IN(memory, nx, nu, ny, nw)                                                               \
    {                                                                                                                \
        (memory), (memory) + (nx), (memory) + (nx) + LQG_STRICT_TRIANGLE(nx), (memory) + (nx) + LQG_TRIANGLE(nx),    \
            (memory) + (nx) + LQG_TRIANGLE(nx) + (nu),                                                               \
            {(memory) + (nx) + LQG_TRIANGLE(nx) + (nu) + (ny), NULL},                                                \
            (memory) + (nx) + LQG_TRIANGLE(nx) + (nu) + 2 * (ny)                                                     \
    }

/* x̂ = x0, P = U0 diag(d0) U0ᵀ; nothing applied yet. */
void lqg_kalman_ud_init(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state);

/* The update of lqg_kalman_plain_update, in the factors of P (Bierman 1977). Whatever the rounding, d stays ≥ 0.
 *
 * y  in: the outputs. One that is rejected or gated is not used.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_STATE_RESET.
 * Cost: ny·(3·nx² + 13·nx)/2 multiply-adds, ny·(nx + 1) divisions; with D ny·nu more, with M ny·nx (and with D ny·nu)
 * more, with E ny·(ny − 1)/2 more, and nx more for an output that is beyond the gate's sigma or watched. */
lqg_status_t lqg_kalman_ud_update(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state,
                                  const lqg_real y[/* ny */]);

/* The same with some of the outputs: exact, as if the others did not exist in this sample. The innovation of an output
 * and its variance are those given the outputs before it.
 *
 * y      in: outputs that are not used are not read
 * used   in: a bit for each output, 1uL << i; or LQG_ALL_OUTPUTS
 * watch  what is told; MAY be NULL
 *
 * Status: LQG_OUTPUT_REJECTED also when E needs an output that is not used. */
lqg_status_t lqg_kalman_ud_partial_update(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state,
                                          const lqg_real y[/* ny */], unsigned long used, const lqg_watch_t *watch);

/* The same with output i alone. When E and M are NULL, calls for all outputs one after the other are the update of all
 * of them, to the bit. With E, y_i is rejected unless row i of E is that of an identity. With M there MUST be at most
 * one call between two predictions.
 *
 * y_i  in: output i alone, a pointer so that it is not mistaken for i; i < ny */
lqg_status_t lqg_kalman_ud_update_output(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state,
                                         const lqg_real *y_i, unsigned i, const lqg_watch_t *watch);

/* The prediction of lqg_kalman_plain_predict, in the factors of P (Thornton 1976).
 *
 * u  in: what was applied; MAY be u_applied itself, or NULL when nu is 0
 *
 * Status: LQG_STATE_RESET, LQG_COVARIANCE_RESET.
 * Cost: (nx − 1)·nx·(nx + 1)/2 + nx·(nx + 1)·(nx + nw) + nx·(nx + nu) multiply-adds, nx divisions;
 * with M nx·ny more. */
lqg_status_t lqg_kalman_ud_predict(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state,
                                   const lqg_real u[/* nu */]);

#ifdef __cplusplus
}
#endif

#endif
