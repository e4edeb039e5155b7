/* SPDX-License-Identifier: MIT */
/* v − v == 0 in words that intervals can follow: v is a number, and within the range. Included before everything else
 * that the prover reads. */
#ifndef PROOF_FINITE_H
#define PROOF_FINITE_H

#include <float.h>

#ifdef LQG_REAL_DOUBLE
#define LARGEST DBL_MAX
#else
#define LARGEST FLT_MAX
#endif

#define FINITE(v) ((v) == (v) && (v) >= -LARGEST && (v) <= LARGEST)

/* |v| < limit, likewise. */
#define BELOW(v, limit) ((v) == (v) && (v) > -(limit) && (v) < (limit))

#endif
