/* SPDX-License-Identifier: MIT */
/* What the filter that keeps P does with it. P is a lower triangle, of which each entry is loaded once for the two that
 * it stands for. Not for firmware. */
#ifndef LQG_COVARIANCE_H
#define LQG_COVARIANCE_H

#include "kernel.h"
#include "lqg/kalman.h"

#define lqg_covariance_project LQG_VARIANT(lqg_covariance_project)
#define lqg_covariance_correct LQG_VARIANT(lqg_covariance_correct)
#define lqg_covariance_predict LQG_VARIANT(lqg_covariance_predict)

/* f = P cᵀ; products with the zeros of c are left out where most of it is zero. */
void lqg_covariance_project(const lqg_real P[], unsigned nx, const lqg_real c[], lqg_real f[]);

/* gain = f inverse,  x ← x + gain innovation,  P ← P − gain fᵀ. */
void lqg_covariance_correct(lqg_real P[], lqg_real x[], unsigned nx, const lqg_real f[], lqg_real inverse,
                            lqg_real innovation);

/* P ← A P Aᵀ + W. A is nx × nx, or what `pattern` says of it. Scratch: work[LQG_KALMAN_PLAIN_WORK]. */
void lqg_covariance_predict(lqg_real P[], unsigned nx, const lqg_real A[], const unsigned char pattern[],
                            const lqg_real W[], lqg_real work[]);

#endif
