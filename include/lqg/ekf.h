/* SPDX-License-Identifier: MIT */
/* TinyLQG: the extended Kalman filter, for plants that are not linear. Conventions: lqg/lqg.h. Derivations:
 * src/README.md.
 *
 *     x⁺ = f(x, u) + G w,    y = h(x, u) + v
 *
 * f, h and their Jacobians come from the caller. The covariance is kept as P = U diag(d) Uᵀ. LQG_STATE_RESET means that
 * x̂ and P are again those of `init`, LQG_COVARIANCE_RESET that P is.
 */
#ifndef LQG_EKF_H
#define LQG_EKF_H

#include <stddef.h>

#include "lqg/arithmetic.h"
#include "lqg/kalman.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_ekf_init           LQG_VARIANT(lqg_ekf_init)
#define lqg_ekf_update         LQG_VARIANT(lqg_ekf_update)
#define lqg_ekf_partial_update LQG_VARIANT(lqg_ekf_partial_update)
#define lqg_ekf_predict        LQG_VARIANT(lqg_ekf_predict)

/* next = f(x, u) and A = ∂f/∂x there, nx × nx. A comes full of zeros. Both in one function, as they share their sines
 * and roots. */
typedef void (*lqg_ekf_f_t)(void *context, lqg_real next[/* nx */], lqg_real A[/* nx × nx */],
                            const lqg_real x[/* nx */], const lqg_real u[]);

/* y = h(x, u) and C = ∂h/∂x there, ny × nx. C comes full of zeros. */
typedef void (*lqg_ekf_h_t)(void *context, lqg_real y[/* ny */], lqg_real C[/* ny × nx */],
                            const lqg_real x[/* nx */], const lqg_real u[]);

/* innovation = y − expected, for outputs with a difference of their own: angles, which belong within ±π. */
typedef void (*lqg_ekf_subtract_t)(void *context, lqg_real innovation[/* ny */], const lqg_real y[/* ny */],
                                   const lqg_real expected[/* ny */]);

/* The plant and its noises, constant: may lie in flash. Another one with the same nx MAY be passed in each call: other
 * sensors, another h. Where the noises of the outputs are correlated, let h and the caller make them uncorrelated. */
typedef struct {
    unsigned nx;                 /* states, ≥ 1 */
    unsigned ny;                 /* outputs, ≥ 1 */
    unsigned nw;                 /* independent process noises, ≥ 0 */
    lqg_ekf_f_t f;               /* MUST write all of next */
    lqg_ekf_h_t h;               /* MUST write all of y */
    lqg_ekf_subtract_t subtract; /* NULL: y − expected */
    void *context;               /* handed to the three; MAY be NULL */
    const lqg_real *V;           /* ny, variances of v, > 0 */
    const lqg_real *G;           /* nx × nw, where the process noises enter; NULL when nw is 0 */
    const lqg_real *W;           /* nw, their variances, ≥ 0; NULL when nw is 0 */
    const lqg_real *x0;          /* nx, first estimate; NULL: 0 */
    const lqg_real *U0;          /* strict upper triangle; its covariance is U0 diag(d0) U0ᵀ; NULL: diag(d0) */
    const lqg_real *d0;          /* nx, ≥ 0 */
    const lqg_gate_t *gate;      /* NULL: no gate */
} lqg_ekf_t;

typedef struct {
    lqg_real *x;           /* nx, the estimate */
    lqg_real *U;           /* LQG_STRICT_TRIANGLE(nx); MAY be NULL when nx is 1 */
    lqg_real *d;           /* nx, U diag(d) Uᵀ is the covariance of its error */
    lqg_gate_state_t gate;
    lqg_real *work;        /* LQG_EKF_WORK, scratch */
} lqg_ekf_state_t;

/* A static state and its memory; numbers of reals; an initializer of a state over memory[LQG_EKF_MEMORY]. */
#define LQG_EKF_STATE(state, nx, ny, nw)                                                                             \
    static lqg_real state##_memory[LQG_EKF_MEMORY(nx, ny, nw)];                                                      \
    static lqg_ekf_state_t state = LQG_EKF_STATE_IN(state##_memory, nx, ny, nw)
#define LQG_EKF_WORK(nx, ny, nw)                                                                                     \
    LQG_LARGER((nx) + (nx) * (nx) + ((nx) + 2) * ((nx) + (nw)), 2 * (ny) + (ny) * (nx) + 2 * (nx))
#define LQG_EKF_MEMORY(nx, ny, nw) ((nx) + LQG_TRIANGLE(nx) + (ny) + LQG_EKF_WORK(nx, ny, nw))
#define LQG_EKF_STATE_IN(memory, nx, ny, nw)                                                                         \
    {                                                                                                                \
        (memory), (memory) + (nx), (memory) + (nx) + LQG_STRICT_TRIANGLE(nx),                                        \
            {(memory) + (nx) + LQG_TRIANGLE(nx), NULL}, (memory) + (nx) + LQG_TRIANGLE(nx) + (ny)                    \
    }

/* x̂ = x0, P = U0 diag(d0) U0ᵀ. */
void lqg_ekf_init(const lqg_ekf_t *ekf, lqg_ekf_state_t *state);

/* With ŷ = h(x̂, u) and C of the estimate before this sample's outputs: for each output i, with the row c of C,
 *
 *     s = c P cᵀ + V_i,   gain = P cᵀ/s,   innovation = y_i − ŷ_i − c δ,
 *     δ ← δ + gain innovation,   P ← P − gain (P cᵀ)ᵀ
 *
 * from δ = 0, and x̂ ← x̂ + δ.
 *
 * y  in: the outputs; where y_i, ŷ_i or c is not finite, the output is rejected
 * u  in: handed to h, which says how long it is and whether it MAY be NULL
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_STATE_RESET.
 * Cost: h once; ny·(3·nx² + 17·nx)/2 multiply-adds, ny·(nx + 1) divisions; nx multiply-adds more for an output that is
 * looked at closely.
 * Source: Anderson, Moore: Optimal Filtering (1979), section 8.2; Bierman (1977), chapter V. */
lqg_status_t lqg_ekf_update(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, const lqg_real y[/* ny */],
                            const lqg_real u[]);

/* The same with some of the outputs: as if the others did not exist in this sample.
 *
 * y      in: outputs that are not used count for nothing, but `subtract` reads them
 * used   in: a bit for each output, 1uL << i; or LQG_ALL_OUTPUTS
 * watch  what is told; MAY be NULL */
lqg_status_t lqg_ekf_partial_update(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, const lqg_real y[/* ny */],
                                    const lqg_real u[], unsigned long used, const lqg_watch_t *watch);

/* x̂ ← f(x̂, u),   P ← A P Aᵀ + G diag(W) Gᵀ,   A of the estimate before
 *
 * u  in: handed to f, which says how long it is and whether it MAY be NULL
 *
 * Status: LQG_STATE_RESET when f(x̂, u) is not finite; LQG_COVARIANCE_RESET when A, and with it U or d, is not, or when
 * a d is negative.
 * Cost: f once; (nx − 1)·nx·(nx + 1)/2 + nx·(nx + 1)·(nx + nw) multiply-adds, nx divisions.
 * Source: as above; Thornton (1976). */
lqg_status_t lqg_ekf_predict(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, const lqg_real u[]);

#ifdef __cplusplus
}
#endif

#endif
