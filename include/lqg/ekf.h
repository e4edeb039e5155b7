/* SPDX-License-Identifier: MIT */
/* TinyLQG: the extended Kalman filter, for plants that are not linear. Conventions: lqg/lqg.h. Derivations:
 * src/README.md.
 *
 *     x⁺ = f(x, u) + G w,    y = h(x, u) + v
 *
 * f, h and their Jacobians come from the caller. The covariance is carried as P = U diag(d) Uᵀ. The state is
 * three arrays of the caller: x[nx], U[LQG_EKF_U(nx)], d[nx]. A reset (LQG_STATE_RESET) is an init.
 */
#ifndef LQG_EKF_H
#define LQG_EKF_H

#include "lqg/arithmetic.h"
#include "lqg/kalman.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_ekf_init LQG_VARIANT(lqg_ekf_init)
#define lqg_ekf_update LQG_VARIANT(lqg_ekf_update)
#define lqg_ekf_predict LQG_VARIANT(lqg_ekf_predict)

/* next = f(x, u) and A = ∂f/∂x there, nx × nx. A comes full of zeros. Both in one function, as they share
 * their sines and roots. */
typedef void (*lqg_ekf_f_t)(void *context, lqg_real next[], lqg_real A[], const lqg_real x[],
                            const lqg_real u[]);

/* y = h(x, u) and C = ∂h/∂x there, ny × nx. C comes full of zeros. */
typedef void (*lqg_ekf_h_t)(void *context, lqg_real y[], lqg_real C[], const lqg_real x[],
                            const lqg_real u[]);

/* innovation = y − expected, ny each, for outputs with a difference of their own: angles, which belong within
 * ±π. */
typedef void (*lqg_ekf_subtract_t)(void *context, lqg_real innovation[], const lqg_real y[],
                                   const lqg_real expected[]);

/* The plant and its noises, constant: may lie in flash. Another one of the same nx MAY be passed in each
 * call: other sensors, another h. Where the noises of the outputs are correlated, let h and the caller make
 * them uncorrelated. */
typedef struct {
    unsigned nx;                 /* states, ≥ 1 */
    unsigned ny;                 /* outputs, ≥ 1 */
    unsigned nq;                 /* independent process noises, ≥ 0 */
    lqg_ekf_f_t f;               /* MUST write all of next */
    lqg_ekf_h_t h;               /* MUST write all of y */
    lqg_ekf_subtract_t subtract; /* NULL: y − expected */
    void *context;               /* handed to the three; MAY be NULL */
    const lqg_real *V;           /* ny, variances of v, > 0 */
    const lqg_real *G;           /* nx × nq, where the process noises enter; NULL when nq is 0 */
    const lqg_real *w;           /* nq, their variances, ≥ 0; NULL when nq is 0 */
    const lqg_real *x0;          /* nx, first estimate; NULL: 0 */
    const lqg_real *U0; /* strict upper triangle; its covariance is U0 diag(d0) U0ᵀ; NULL: diag(d0) */
    const lqg_real *d0; /* nx, ≥ 0 */
} lqg_ekf_t;

/* Lengths of U[] (NULL when 0) and of work[]. */
#define LQG_EKF_U(nx) LQG_STRICT_TRIANGLE(nx)
#define LQG_EKF_WORK(nx, ny, nq)                                                                             \
    LQG_LARGER((nx) + (nx) * (nx) + ((nx) + 2) * ((nx) + (nq)), 2 * (ny) + (ny) * (nx) + 2 * (nx))

/* x̂ = x0, P = U0 diag(d0) U0ᵀ. */
void lqg_ekf_init(const lqg_ekf_t *ekf, lqg_real x[], lqg_real U[], lqg_real d[]);

/* With ŷ = h(x̂, u) and C of the estimate before this sample's outputs: for each output i, with the row c of
 * C,
 *
 *     s = c P cᵀ + v,   gain = P cᵀ/s,   ν = y_i − ŷ_i − c δ,   δ ← δ + gain ν,   P ← P − gain (P cᵀ)ᵀ
 *
 * from δ = 0, and x̂ ← x̂ + δ.
 *
 * y[ny]  in: what the sensors say; where it, ŷ_i or c is not finite, the output is left out
 * u      in: handed to h, which says how long it is and whether it MAY be NULL
 * watch  MAY be NULL
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET.
 * Cost: h once; ny·(3·nx² + 17·nx)/2 multiply-adds, with a watch ny·nx more; ny·(nx + 1) divisions.
 * Source: Anderson, Moore: Optimal Filtering (1979), section 8.2; Bierman (1977), chapter V. */
lqg_status lqg_ekf_update(const lqg_ekf_t *ekf, lqg_real x[], lqg_real U[], lqg_real d[], const lqg_real y[],
                          const lqg_real u[], const lqg_watch_t *watch, lqg_real work[]);

/* x̂ ← f(x̂, u),   P ← A P Aᵀ + G diag(w) Gᵀ,   A of the estimate before
 *
 * u      in: handed to f, which says how long it is and whether it MAY be NULL
 *
 * Status: LQG_STATE_RESET, when f(x̂, u) is not finite; LQG_COVARIANCE_RESET, when A, and with it U or d, is not, or when
 * a d is negative: U and d begin anew, x̂ stays.
 * Cost: f once; (nx − 1)·nx·(nx + 1)/2 + nx·(nx + 1)·(nx + nq) multiply-adds, nx divisions.
 * Source: as above; Thornton (1976). */
lqg_status lqg_ekf_predict(const lqg_ekf_t *ekf, lqg_real x[], lqg_real U[], lqg_real d[], const lqg_real u[],
                           lqg_real work[]);

#ifdef __cplusplus
}
#endif

#endif
