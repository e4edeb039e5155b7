/* SPDX-License-Identifier: MIT */
/* TinyLQG: recursive least squares, for parameters of a plant that are found while it runs. Conventions: lqg/lqg.h.
 * Derivations: src/README.md.
 *
 *     y = φᵀ θ + v
 *
 * θ are the parameters, φ is what they multiply: known numbers of this sample, such as earlier outputs and inputs.
 * After N samples θ is the minimiser of
 *
 *     Σ_k λ^(N−k) (y_k − φ_kᵀ θ)²/V  +  λ^N (θ − θ0)ᵀ P0⁻¹ (θ − θ0)
 *
 * and P is the inverse of its curvature: with λ = 1 the covariance of the error of θ. P is kept as U diag(d) Uᵀ and
 * cannot lose its definiteness.
 *
 * LQG_STATE_RESET: θ was not finite, and all is as after `init`. LQG_COVARIANCE_RESET: U or d was not finite, or a d
 * was negative; they are as after `init`, and θ stays.
 */
#ifndef LQG_RLS_H
#define LQG_RLS_H

#include "lqg/arithmetic.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_rls_init   LQG_VARIANT(lqg_rls_init)
#define lqg_rls_update LQG_VARIANT(lqg_rls_update)

/* What to estimate, constant: may lie in flash. */
typedef struct {
    unsigned ntheta;             /* parameters, ≥ 1 */
    lqg_real forgetting;         /* λ, 0 < λ ≤ 1: a sample counts 1/(1 − λ) samples long; 1: for ever */
    lqg_real V;                  /* variance of v, > 0; where it is not known 1, and P is in units of it */
    const lqg_real *theta0;      /* ntheta, first guess; NULL: 0 */
    const lqg_real *P0_diagonal; /* ntheta, ≥ 0, variances of its errors; 0: known */
    const lqg_real *P_limits;    /* ntheta, > 0, no P_ii grows beyond; NULL: no limits */
} lqg_rls_t;

typedef struct {
    lqg_real *theta; /* ntheta, the parameters */
    lqg_real *U;     /* LQG_RLS_U(ntheta); MAY be NULL when ntheta is 1 */
    lqg_real *d;     /* ntheta, P = U diag(d) Uᵀ */
    lqg_real *work;  /* ntheta, scratch */
} lqg_rls_state_t;

/* A static state and its memory; numbers of reals; an initializer of a state over memory[LQG_RLS_MEMORY]. */
#define LQG_RLS_STATE(state, ntheta)                                                                                 \
    static lqg_real state##_memory[LQG_RLS_MEMORY(ntheta)];                                                          \
    static lqg_rls_state_t state = LQG_RLS_STATE_IN(state##_memory, ntheta)
#define LQG_RLS_U(ntheta)      ((ntheta) * ((ntheta) - 1) / 2)
#define LQG_RLS_MEMORY(ntheta) (3 * (ntheta) + LQG_RLS_U(ntheta))
#define LQG_RLS_STATE_IN(memory, ntheta)                                                                             \
    {                                                                                                                \
        (memory), (memory) + 3 * (ntheta), (memory) + (ntheta), (memory) + 2 * (ntheta)                              \
    }

/* θ = θ0, P = P0, within its limits. */
void lqg_rls_init(const lqg_rls_t *rls, lqg_rls_state_t *state);

/* s = λV + φᵀ P φ,   θ ← θ + P φ/s (y − φᵀ θ),   P ← (P − P φ φᵀ P/s)/λ,   then P_ii within their limits
 *
 * Where a parameter is not excited, forgetting lets its P_ii grow by 1/λ a sample. Beyond its limit, row and column i
 * are scaled, P ← Σ P Σ with Σ_ii = 2/(1 + P_ii/limit_i) ≤ √(limit_i/P_ii): correlations and definiteness stay, and so
 * does what is known of the other parameters. P_ii settles at its limit, or below it by a share of (1 − λ)² at most.
 *
 * y    in: where it or φ is not finite, or too large, it is rejected and nothing changes
 * phi  in: φ
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_COVARIANCE_RESET, LQG_STATE_RESET.
 * Cost, n = ntheta: 2 n² + 8 n multiply-adds, 2 n + 1 divisions; with limits n² + n multiply-adds and (n² + n)/2
 * divisions more.
 * Source: Bierman (1977), chapter V; Åström, Wittenmark: Adaptive Control, 2nd edition (1995), chapter 2. */
lqg_status_t lqg_rls_update(const lqg_rls_t *rls, lqg_rls_state_t *state, lqg_real y,
                            const lqg_real phi[/* ntheta */]);

#ifdef __cplusplus
}
#endif

#endif
