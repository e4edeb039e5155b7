/* SPDX-License-Identifier: MIT */
/* The filter that lqgen emits, with all its checks. */
#include "peer.h"

#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)

static OF(t) self;

void peer_init(void)
{
    OF(init)(&self);
}

void peer_sample(const real_t u[NU], const real_t y[NY])
{
    (void)OF(step)(&self, y, u);
}

#ifdef WITH_FACTORS /* P = U diag(d) Uᵀ */
static real_t factor(int i, int k)
{
    return i == k ? 1 : i > k ? 0 : self.U[k * (k - 1) / 2 + i];
}

static real_t covariance(int i, int j)
{
    real_t sum = 0;

    for (int k = 0; k < NX; k++)
        sum += factor(i, k) * self.d[k] * factor(j, k);
    return sum;
}
#else
static real_t covariance(int i, int j)
{
    return i < j ? covariance(j, i) : self.P[i * (i + 1) / 2 + j];
}
#endif

void peer_estimate(real_t x[NX], real_t P[NX][NX])
{
    for (int i = 0; i < NX; i++) {
        x[i] = self.x[i];
        for (int j = 0; j < NX; j++)
            P[i][j] = covariance(i, j);
    }
}
