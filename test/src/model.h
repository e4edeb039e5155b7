/* SPDX-License-Identifier: MIT */
/* Plants as a textbook writes them, and what the library wants to know of them. */
#ifndef TEST_MODEL_H
#define TEST_MODEL_H

#include <float.h>

#include "lqg/lqg.h"
#include "states.h"

#ifdef LQG_REAL_DOUBLE
#define EPSILON DBL_EPSILON
#else
#define EPSILON FLT_EPSILON
#endif

/* x⁺ = A x + B u + w, y = C x + D u + v; W, V, S the covariances of w, of v, and E[w vᵀ]. */
typedef struct {
    unsigned nx, nu, ny;
    double A[MAX_NX * MAX_NX], B[MAX_NX * MAX_NU], C[MAX_NY * MAX_NX], D[MAX_NY * MAX_NU];
    double W[MAX_NX * MAX_NX], V[MAX_NY * MAX_NY], S[MAX_NX * MAX_NY];
    double x0[MAX_NX], P0[MAX_NX * MAX_NX];
} model_t;

extern const model_t double_integrator; /* one output */
extern const model_t two_mass;          /* four states, two outputs that u reaches at once (D ≠ 0) */
extern const model_t correlated;        /* outputs with correlated noises, so that E ≠ I */
extern const model_t cross_noise;       /* w and v correlated, so that M ≠ 0, and E ≠ I */
extern const model_t random_walk;       /* one state, no input */

/* The descriptions of both online filters, and the matrices to which they point: not to be copied. */
typedef struct {
    lqg_real A[MAX_NX * MAX_NX], B[MAX_NX * MAX_NU], C[MAX_NY * MAX_NX], D[MAX_NY * MAX_NU];
    lqg_real E[MAX_NY * MAX_NY], V[MAX_NY], M[MAX_NX * MAX_NY], A_free[MAX_NX * MAX_NX];
    lqg_real W[LQG_TRIANGLE(MAX_NX)], G[MAX_NX * MAX_NX], variances[MAX_NX];
    lqg_real x0[MAX_NX], P0[LQG_TRIANGLE(MAX_NX)], U0[LQG_STRICT_TRIANGLE(MAX_NX)], d0[MAX_NX];
    lqg_kalman_plain_t plain;
    lqg_kalman_ud_t ud;
} online_t;

/* Makes the outputs' noises uncorrelated and w free of them, in double, and rounds the result. */
void prepare_online(const model_t *model, online_t *online);

/* P_ij of U diag(d) Uᵀ. */
double ud_covariance(const lqg_real U[], const lqg_real d[], unsigned nx, unsigned i, unsigned j);

/* Uniform in [−1, 1), a multiple of 2⁻¹⁵, from a generator with its state in *seed. */
double noise(unsigned long *seed);

/* The plant goes on by one sample under u and noise; y is what its sensors say, rounded. */
void simulate(const model_t *model, double x[], const lqg_real u[], lqg_real y[], unsigned long *seed);

#endif
