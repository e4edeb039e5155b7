/* SPDX-License-Identifier: MIT */
/* A filter in the manner of TinyEKF, written for this comparison: loops over matrices whose sizes the compiler knows,
 * the inverse of S by Cholesky, (I − L C) P in full, and Jacobians by hand. With TINYEKF, the path of a tinyekf.h, it
 * is TinyEKF itself. */
#include "peer.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#ifdef TINYEKF /* before sqrt has another meaning */
#define EKF_N NX
#define EKF_M NY
#define _float_t real_t
#include TINYEKF
typedef ekf_t filter_t;
#define predict ekf_predict
#define update ekf_update
#endif

/* newlib's tgmath.h lacks long double */
#define OF_REAL(name) _Generic((real_t)0, float: name##f, double: name)
#define sin(x) OF_REAL(sin)(x)
#define cos(x) OF_REAL(cos)(x)
#define sqrt(x) OF_REAL(sqrt)(x)
#define atan2(y, x) OF_REAL(atan2)(y, x)

#include HAND_WRITTEN

static void multiply(const real_t *a, const real_t *b, real_t *product, int rows, int inner, int columns)
{
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++) {
            real_t sum = 0;

            for (int k = 0; k < inner; k++)
                sum += a[i * inner + k] * b[k * columns + j];
            product[i * columns + j] = sum;
        }
}

#ifndef TINYEKF
typedef struct {
    real_t x[NX], P[NX * NX];
} filter_t;

static void transpose(const real_t *a, real_t *transposed, int rows, int columns)
{
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            transposed[j * rows + i] = a[i * columns + j];
}

/* x̂ ← f,  P ← F P Fᵀ + Q */
static void predict(filter_t *self, const real_t f[NX], const real_t F[NX * NX], const real_t Q[NX * NX])
{
    real_t FP[NX * NX], Ft[NX * NX];

    memcpy(self->x, f, sizeof self->x);
    multiply(F, self->P, FP, NX, NX, NX);
    transpose(F, Ft, NX, NX);
    multiply(FP, Ft, self->P, NX, NX, NX);
    for (int i = 0; i < NX * NX; i++)
        self->P[i] += Q[i];
}

/* S = R Rᵀ; R is lower triangular and takes the place of S. */
static bool factorise(real_t S[NY * NY])
{
    for (int i = 0; i < NY; i++)
        for (int j = 0; j <= i; j++) {
            real_t sum = S[i * NY + j];

            for (int k = 0; k < j; k++)
                sum -= S[i * NY + k] * S[j * NY + k];
            if (i == j && !(sum > 0))
                return false;
            S[i * NY + j] = i == j ? sqrt(sum) : sum / S[j * NY + j];
        }
    return true;
}

/* S⁻¹ = R⁻ᵀ R⁻¹ */
static bool invert(real_t S[NY * NY], real_t inverse[NY * NY])
{
    real_t of_factor[NY * NY];

    if (!factorise(S))
        return false;
    for (int i = 0; i < NY; i++) {
        of_factor[i * NY + i] = 1 / S[i * NY + i];
        for (int j = 0; j < i; j++) {
            real_t sum = 0;

            for (int k = j; k < i; k++)
                sum -= S[i * NY + k] * of_factor[k * NY + j];
            of_factor[i * NY + j] = sum / S[i * NY + i];
        }
    }
    for (int i = 0; i < NY; i++)
        for (int j = 0; j <= i; j++) {
            real_t sum = 0;

            for (int k = i; k < NY; k++)
                sum += of_factor[k * NY + i] * of_factor[k * NY + j];
            inverse[i * NY + j] = sum;
            inverse[j * NY + i] = sum;
        }
    return true;
}

/* L = P Hᵀ (H P Hᵀ + R)⁻¹,  x̂ ← x̂ + L (z − h),  P ← (I − L H) P */
static bool update(filter_t *self, const real_t z[NY], const real_t h[NY], const real_t H[NY * NX],
                   const real_t R[NY * NY])
{
    real_t Ht[NX * NY], PHt[NX * NY], S[NY * NY], inverse[NY * NY], L[NX * NY], factor[NX * NX], P[NX * NX];

    transpose(H, Ht, NY, NX);
    multiply(self->P, Ht, PHt, NX, NX, NY);
    multiply(H, PHt, S, NY, NX, NY);
    for (int i = 0; i < NY * NY; i++)
        S[i] += R[i];
    if (!invert(S, inverse))
        return false;
    multiply(PHt, inverse, L, NX, NY, NY);
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NY; j++)
            self->x[i] += L[i * NY + j] * (z[j] - h[j]);
    multiply(L, H, factor, NX, NY, NX);
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NX; j++)
            factor[i * NX + j] = (real_t)(i == j) - factor[i * NX + j];
    multiply(factor, self->P, P, NX, NX, NX);
    memcpy(self->P, P, sizeof P);
    return true;
}
#endif

static filter_t self;
static real_t Q[NX * NX], R[NY * NY];

#if IS_CONTINUOUS
/* to = I + c J */
static void one_and(real_t c, const real_t J[NX * NX], real_t to[NX * NX])
{
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NX; j++)
            to[i * NX + j] = (real_t)(i == j) + c * J[i * NX + j];
}

/* The Runge-Kutta step of fourth order and its Jacobian, stage by stage. */
static void next_state(const real_t x[NX], const real_t u[NU], real_t f[NX], real_t F[NX * NX])
{
    static const real_t weights[4] = {1, 2, 2, 1}, ahead[4] = {0, T / 2, T / 2, T};
    real_t k[NX] = {0}, J[NX * NX] = {0}, sum[NX] = {0}, sum_of_slopes[NX * NX] = {0};

    for (int stage = 0; stage < 4; stage++) {
        real_t at[NX], slopes[NX * NX], of_rates[NX * NX];

        for (int i = 0; i < NX; i++)
            at[i] = x[i] + ahead[stage] * k[i];
        one_and(ahead[stage], J, slopes);
        rates(at, u, k, of_rates);
        multiply(of_rates, slopes, J, NX, NX, NX);
        for (int i = 0; i < NX; i++)
            sum[i] += weights[stage] * k[i];
        for (int i = 0; i < NX * NX; i++)
            sum_of_slopes[i] += weights[stage] * J[i];
    }
    for (int i = 0; i < NX; i++)
        f[i] = x[i] + T / 6 * sum[i];
    one_and(T / 6, sum_of_slopes, F);
}
#endif

void peer_init(void)
{
    memset(&self, 0, sizeof self);
    for (int i = 0; i < NX; i++) {
        self.x[i] = X0[i];
        self.P[i * NX + i] = P0[i];
        Q[i * NX + i] = W[i];
    }
    for (int i = 0; i < NY; i++)
        R[i * NY + i] = V[i];
}

void peer_sample(const real_t u[NU], const real_t y[NY])
{
    static const int wraps[NY] = WRAPS;
    const real_t pi = (real_t)3.14159265358979323846;
    real_t z[NY], h[NY], H[NY * NX], f[NX], F[NX * NX];

    outputs(self.x, h, H);
    for (int i = 0; i < NY; i++) {
        z[i] = y[i];
        while (wraps[i] && z[i] - h[i] >= pi)
            z[i] -= 2 * pi;
        while (wraps[i] && z[i] - h[i] < -pi)
            z[i] += 2 * pi;
    }
    (void)update(&self, z, h, H, R);
    next_state(self.x, u, f, F);
    predict(&self, f, F, Q);
}

void peer_estimate(real_t x[NX], real_t P[NX][NX])
{
    for (int i = 0; i < NX; i++) {
        x[i] = self.x[i];
        for (int j = 0; j < NX; j++)
            P[i][j] = self.P[i * NX + j];
    }
}
