/* SPDX-License-Identifier: MIT */
/* P = U diag(d) Uᵀ, U unit upper triangular: what all filters do that carry their covariance so. Not for
 * firmware. */
#ifndef LQG_FACTORS_H
#define LQG_FACTORS_H

#include "bounds_check.h"
#include "kernel.h"
#include "lqg/kalman.h"

#define lqg_factors_project LQG_VARIANT(lqg_factors_project)
#define lqg_factors_variance LQG_VARIANT(lqg_factors_variance)
#define lqg_factors_update LQG_VARIANT(lqg_factors_update)
#define lqg_factors_predict LQG_VARIANT(lqg_factors_predict)

/* f = Uᵀ cᵀ, or 0 where the output is not usable. */
void lqg_factors_project(const lqg_real U[], unsigned nx, const lqg_real c[], int usable, lqg_real f[]);

/* s = V + Σ_j d_j f_j² = c P cᵀ + V: rounded like the s of lqg_factors_update. */
lqg_real lqg_factors_variance(const lqg_real d[], unsigned nx, const lqg_real f[], lqg_real V);

/* Bierman's update of U and d by an output with f = Uᵀ cᵀ and noise variance V > 0. f = 0 leaves all as it
 * is, to the bit. Returns 1/s, s = c P cᵀ + V; f becomes P cᵀ of the prior P: the gain is f/s. */
lqg_real lqg_factors_update(lqg_real U[], lqg_real d[], unsigned nx, lqg_real f[], lqg_real V);

/* U diag(d) Uᵀ ← A U diag(d) Uᵀ Aᵀ + G diag(W) Gᵀ, G nx × nw (Thornton). A is nx × nx, or what `pattern` says of it.
 * Scratch: work[(nx + 2)(nx + nw)]. */
void lqg_factors_predict(lqg_real U[], lqg_real d[], unsigned nx, const lqg_real A[], const unsigned char pattern[],
                         unsigned nw, const lqg_real G[], const lqg_real W[], lqg_real work[]);

LQG_STRICT_BEGIN

/* Adds d_i with the bound 1/scale_i², like P_ii, and U, which has no bounds, from the last column to the first; U may
 * be NULL when nx is 1. */
static inline void add_factors(bounds_check_t *check, const lqg_real U[], const lqg_real d[], const lqg_real scale[],
                               unsigned nx)
{
    LQG_STRICT_BODY
    for (unsigned i = nx; i-- > 0;) {
        add_variance(check, d[i], scale, i);
        for (unsigned j = 0; j < i; j++)
            check->others += U[LQG_STRICT_TRIANGLE(i) + j];
    }
}

/* Bierman's update, lqg_factors_update, of x as well: gain = f/s of the f that it leaves, x ← x + gain innovation. */
static inline void update_with_factors(lqg_real x[], lqg_real U[], lqg_real d[], unsigned nx, lqg_real f[],
                                       lqg_real innovation, lqg_real V)
{
    LQG_STRICT_BODY
    const lqg_real inverse = lqg_factors_update(U, d, nx, f, V);

    for (unsigned j = 0; j < nx; j++)
        x[j] = multiply_add(f[j] * inverse, innovation, x[j]);
}

LQG_STRICT_END

#endif
