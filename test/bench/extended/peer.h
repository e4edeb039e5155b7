/* SPDX-License-Identifier: MIT */
/* What every contestant computes: one sample of an extended Kalman filter, from x̂0 and P0 on.
 *
 *     update by y, all outputs linearised at the estimate before them; predict by u, which is applied until the next
 *
 * The model is "model.h": NX, NU, NY, T (0: discrete), W, V, X0, P0, and WITH_SAMPLES what goes in and is expected to
 * come out. */
#ifndef BENCH_EXTENDED_PEER_H
#define BENCH_EXTENDED_PEER_H

typedef REAL real_t; /* float or double */

#include "model.h"

#ifdef __cplusplus
extern "C" {
#endif

void peer_init(void);
void peer_sample(const real_t u[NU], const real_t y[NY]);

/* x̂ and P of the next sample; P is symmetric, all of it. */
void peer_estimate(real_t x[NX], real_t P[NX][NX]);

#ifdef __cplusplus
}
#endif

#endif
