/* SPDX-License-Identifier: MIT */
/* TinyLQG: the control law u = −K x. Conventions: lqg/lqg.h. */
#ifndef LQG_LQR_H
#define LQG_LQR_H

#include "lqg/arithmetic.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_lqr_control LQG_VARIANT(lqg_lqr_control)

/* A regulator, constant: may lie in flash. */
typedef struct {
    unsigned nx;            /* states, ≥ 1 */
    unsigned nu;            /* inputs, ≥ 1 */
    const lqg_real *K;      /* nu × nx, input per state */
    const lqg_real *u_min;  /* nu, finite or −∞; NULL: no lower limits */
    const lqg_real *u_max;  /* nu, finite or +∞, ≥ u_min; NULL: no upper limits */
} lqg_lqr_t;

/* u = −K x, within [u_min, u_max].
 *
 * x  in: the state or its estimate
 * u  out: finite and within the limits, whatever x is; MUST NOT overlap x
 *
 * Status: LQG_INPUT_LIMITED when a limit was reached, or when −K x was not finite and 0 was used instead.
 * Cost: nu·nx multiply-adds. */
lqg_status_t lqg_lqr_control(const lqg_lqr_t *lqr, const lqg_real x[/* nx */], lqg_real u[/* nu */]);

#ifdef __cplusplus
}
#endif

#endif
