/* SPDX-License-Identifier: MIT */
/* What the prover knows nothing about, and what in the proof stands for "the sum of v, and of more, is finite". */
#ifndef PROOF_UNKNOWN_H
#define PROOF_UNKNOWN_H

#include "finite.h"
#include "lqg/arithmetic.h"

extern volatile int any_int; /* each reading may give anything */

/* Here ends a path that another one stands for. */
/*@ assigns \nothing; ensures \false; */
void stop(void);
/*@ assigns \nothing; ensures \false; */
int stopped(void);

/* A test of the emitted code, and what follows from it where it passes: so nothing else may be there. */
#define RESTATED(test, facts) ((test) && ((facts) || stopped()))

/* Every v_i is finite. May say no when they are, but never yes when one is not. */
static inline int perhaps_all_finite(const lqg_real v[], unsigned long length)
{
    if (any_int)
        return 0;
    for (unsigned long i = 0; i < length; i++)
        if (!FINITE(v[i]))
            stop();
    return 1;
}

/* Likewise: every |v_i| < 1/scale_i; finite without a scale. */
static inline int perhaps_all_scaled_below(const lqg_real v[], const lqg_real scale[], unsigned long length)
{
    if (!scale)
        return perhaps_all_finite(v, length);
    if (any_int)
        return 0;
    for (unsigned long i = 0; i < length; i++) {
        const lqg_real bound = 1 / scale[i];
        if (!BELOW(v[i], bound))
            stop();
    }
    return 1;
}

/* Likewise: low_i ≤ v_i ≤ high_i. */
static inline int perhaps_all_within(const lqg_real v[], const lqg_real low[], const lqg_real high[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        if (!(v[i] == v[i] && v[i] >= low[i] && v[i] <= high[i]))
            stop();
    return 1;
}

/* Likewise: every |P_ii| < 1/scale_i² of a lower triangle. */
static inline int perhaps_diagonal_below(const lqg_real P[], const lqg_real scale[], unsigned nx)
{
    if (any_int)
        return 0;
    for (unsigned i = 0; i < nx; i++) {
        const unsigned at = i * (i + 1) / 2 + i;
        if (scale) {
            const lqg_real bound = 1 / scale[i] / scale[i];
            if (!BELOW(P[at], bound))
                stop();
        } else if (!FINITE(P[at])) {
            stop();
        }
    }
    return 1;
}

/* Likewise: every |d_i| < 1/scale_i², and U is finite. */
static inline int perhaps_factors_below(const lqg_real U[], const lqg_real d[], const lqg_real scale[], unsigned nx)
{
    if (any_int)
        return 0;
    for (unsigned i = 0; i < nx; i++) {
        if (scale) {
            const lqg_real bound = 1 / scale[i] / scale[i];
            if (!BELOW(d[i], bound))
                stop();
        } else if (!FINITE(d[i])) {
            stop();
        }
    }
    for (unsigned i = 0; i < nx * (nx - 1) / 2; i++)
        if (!FINITE(U[i]))
            stop();
    return 1;
}

#endif
