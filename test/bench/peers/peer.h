/* SPDX-License-Identifier: MIT */
/* What every contestant computes: one sample of x⁺ = A x + B u + w, y = C x + v with u = −K x̂, from x̂ = 0 on.
 *
 *     update, u = −K x̂, predict with this u
 *
 * With CARRIED the covariance P is carried along, from P0 on; without it the gain L is constant. The numbers of the
 * model are in MODEL, row by row. */
#ifndef BENCH_PEER_H
#define BENCH_PEER_H

#include MODEL /* NX, NU, NY, A, B, C, K, and L or V, W, P0; WITH_SAMPLES: w_in, v_in, u_end, too */

#ifdef __cplusplus
extern "C" {
#endif

void peer_init(void);
void peer_sample(void *unused, const float y[NY], float u[NU]);

#ifdef __cplusplus
}
#endif

#endif
