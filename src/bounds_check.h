/* SPDX-License-Identifier: MIT */
/* Whether a state is within its bounds, and its P can be a covariance. Not for firmware. */
#ifndef LQG_BOUNDS_CHECK_H
#define LQG_BOUNDS_CHECK_H

#include "kernel.h"

#define lqg_bounds_check_add LQG_VARIANT(lqg_bounds_check_add)

LQG_STRICT_BEGIN

/* Begins with {0, 0, 0}. A scale is 1/b of a bound b; NULL: no bounds. */
typedef struct {
    lqg_real bounded; /* Σ (scale_i x_i)² + Σ scale_i² P_ii */
    lqg_real others;  /* the sum of what only has to be finite */
    int negative;     /* a P_ii is */
} bounds_check_t;

/* Adds x, with the bounds 1/scale_i. */
void lqg_bounds_check_add(bounds_check_t *check, const lqg_real x[], const lqg_real scale[], unsigned length);

/* Adds values that have no bounds. */
static inline void add_finite(bounds_check_t *check, const lqg_real values[], unsigned length)
{
    check->others = add_all(check->others, values, length);
}

/* Adds P_ii, with the bound 1/scale_i². */
static inline void add_variance(bounds_check_t *check, lqg_real variance, const lqg_real scale[], unsigned i)
{
    LQG_STRICT_BODY
    check->negative |= variance < 0;
    if (scale)
        check->bounded += variance * scale[i] * scale[i];
    else
        check->others += variance;
}

/* No P_ii is negative; bounded < 1 and others finite, in one comparison: others − others is 0, or NaN, which is not
 * less than anything. No term of bounded is negative and rounding is monotone, so |x_i| < b_i and P_ii < b_i². */
static inline int is_within_bounds(const bounds_check_t *check)
{
    LQG_STRICT_BODY
    return !check->negative && check->others - check->others < 1 - check->bounded;
}

LQG_STRICT_END

#endif
