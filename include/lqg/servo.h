/* SPDX-License-Identifier: MIT */
/* TinyLQG: the control law with integral action and references. Conventions: lqg/lqg.h. Derivations: src/README.md.
 *
 *     v = −K z + Nbar r,          z = [x̂; ξ],              u = v within its limits
 *     v = u[k−1] − K z + Nbar r,  z = [x̂; ξ; u[k−1]]       where changes of u are weighed
 *     ξ⁺ = ξ + T (r − y)          of the outputs that are integrated
 *
 * When another u than v was applied, H (u − v) is added to ξ: with an H of the model, what the plant's state lacks for
 * it; with −Kξ⁺ ("conditioning"), what the law needs to ask for u. So ξ does not wind up, whatever limited u.
 * Transfer from manual to automatic control is bumpless by `set_input`.
 *
 * A sample is observe, control, advance; beside a filter they follow update, control and predict of the filter.
 */
#ifndef LQG_SERVO_H
#define LQG_SERVO_H

#include "lqg/arithmetic.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_servo_init      LQG_VARIANT(lqg_servo_init)
#define lqg_servo_observe   LQG_VARIANT(lqg_servo_observe)
#define lqg_servo_control   LQG_VARIANT(lqg_servo_control)
#define lqg_servo_advance   LQG_VARIANT(lqg_servo_advance)
#define lqg_servo_set_input LQG_VARIANT(lqg_servo_set_input)

/* A law, constant: may lie in flash. */
typedef struct {
    unsigned nx;                 /* states, ≥ 1 */
    unsigned nu;                 /* inputs, ≥ 1 */
    unsigned nr;                 /* references, ≥ 0 */
    unsigned nxi;                /* integrated outputs, ≥ 0 */
    unsigned gives_change;       /* not 0: −K z + Nbar r is the change of u, and z ends with u[k−1] */
    lqg_real T;                  /* s, sample time */
    const lqg_real *K;           /* nu × nz, nz = nx + nxi (+ nu) */
    const lqg_real *Nbar;        /* nu × nr; NULL: r acts by ξ alone */
    const lqg_real *H;           /* nxi × nu, ξ per input: what ξ is given for an input that was not applied */
    const lqg_real *H_input;     /* nxi × nu, ξ per input: −Kξ⁺, Kξ the columns of K that belong to ξ; NULL: H */
    const unsigned *output;      /* nxi: the output that each ξ integrates */
    const unsigned *reference;   /* nxi: the r that it has to follow */
    const lqg_real *u_min;       /* nu, finite or −∞; NULL: no lower limits */
    const lqg_real *u_max;       /* nu, finite or +∞, ≥ u_min; NULL: no upper limits */
    const lqg_real *u_step;      /* nu, ≥ 0, largest |u[k] − u[k−1]|; NULL: any */
    const lqg_real *xi_scale;    /* nxi, 1/b_i of the bounds |ξ_i| < b_i; NULL: finite is enough */
    const lqg_real *error_limit; /* nxi, a larger r − y does not count; NULL: any finite one does */
} lqg_servo_t;

typedef struct {
    lqg_real *r;         /* nr, references, written by the caller at any time; MAY be NULL when nr is 0 */
    lqg_real *xi;        /* nxi, ξ; MAY be NULL when nxi is 0 */
    lqg_real *error;     /* nxi, r − y of this sample, which `advance` adds to ξ; MAY be NULL when nxi is 0 */
    lqg_real *demand;    /* nu, v; MAY be NULL when nxi is 0 */
    lqg_real *u_applied; /* nu, u[k−1]; MAY be the filter's; MAY be NULL without gives_change and u_step */
} lqg_servo_state_t;

/* A static state and its memory; numbers of reals; an initializer of a state over memory[LQG_SERVO_MEMORY]. */
#define LQG_SERVO_STATE(state, nu, nr, nxi)                                                                          \
    static lqg_real state##_memory[LQG_SERVO_MEMORY(nu, nr, nxi)];                                                   \
    static lqg_servo_state_t state = LQG_SERVO_STATE_IN(state##_memory, nu, nr, nxi)
#define LQG_SERVO_MEMORY(nu, nr, nxi) (2 * (nu) + (nr) + 2 * (nxi))
#define LQG_SERVO_STATE_IN(memory, nu, nr, nxi)                                                                      \
    {                                                                                                                \
        (memory) + 2 * (nu), (memory) + 2 * (nu) + (nr), (memory) + 2 * (nu) + (nr) + (nxi), (memory),               \
            (memory) + (nu)                                                                                          \
    }

/* r = 0, ξ = 0, nothing applied and nothing asked for yet. */
void lqg_servo_init(const lqg_servo_t *servo, lqg_servo_state_t *state);

/* error ← r − y of the integrated outputs; 0, which leaves ξ as it is, where that is not finite or not below its limit.
 *
 * y  in: the outputs; one that was not used should be NaN
 *
 * Cost: nxi operations. */
void lqg_servo_observe(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real y[/* ny */]);

/* u by the law: 0 where that is not finite, then within u_step of u_applied, then within [u_min, u_max], which have
 * priority.
 *
 * x  in: the state or its estimate
 * u  out: finite and within the limits, whatever x and r are, as long as u_applied is finite; MUST NOT overlap another
 *    array
 *
 * Status: LQG_REFERENCE_NOT_FINITE for an r that is NaN or infinite and counts as 0; LQG_INPUT_LIMITED when a limit was
 * reached, or when the law was not finite and 0 was used instead.
 * Cost: nu·(nz + nr) multiply-adds. */
lqg_status_t lqg_servo_control(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real x[/* nx */],
                               lqg_real u[/* nu */]);

/* ξ ← ξ + H (u − v) + T (r − y),   u[k−1] ← u. Without an `observe` since the last one r − y counts as 0, without a
 * `control` u − v.
 *
 * u  in: what was applied; MAY be u_applied itself
 *
 * Status: LQG_STATE_RESET when Σ (ξ_i/b_i)² < 1 did not hold or u was not finite: all but r is as after `init`.
 * Cost: nxi·(nu + 1) multiply-adds. */
lqg_status_t lqg_servo_advance(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real u[/* nu */]);

/* Bumpless from manual to automatic: u[k−1] ← u and ξ such that the law asks for u next, or as nearly as ξ can. Delayed
 * inputs among the states x are written by the caller before.
 *
 * x  in: the state or its estimate
 * u  in: what was applied by hand
 *
 * Status: LQG_REFERENCE_NOT_FINITE; LQG_STATE_RESET as by `advance`.
 * Cost: nu·(nz + nr + nxi) multiply-adds. */
lqg_status_t lqg_servo_set_input(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real x[/* nx */],
                                 const lqg_real u[/* nu */]);

#ifdef __cplusplus
}
#endif

#endif
