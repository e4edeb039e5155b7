/* SPDX-License-Identifier: MIT */
/* A controller for a long time: noise for outputs and inputs, one output in 16 missing; a gate may leave out more. Its
 * estimate stays a thousand times below its bounds, it never begins anew, and the covariance that it carries is
 * positive definite after every update and prediction. States that are known from the beginning, the inputs on their
 * way, are left out of that: their variance is and stays 0.
 *
 *     soak [samples]
 *
 * HEADER, NAME and UPPER_NAME are the controller's, REAL its scalar; CARRIES_plain or CARRIES_ud what it
 * carries. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

enum { NX = SIZE(NX), NY = SIZE(NY) };

#ifdef CARRIES_ud
/* The last states, of variance 0, are the known ones. */
static int is_definite(const OF(t) * loop, const OF(t) * beginning)
{
    for (int i = 0; i < NX; i++) {
        const int known = beginning->d[i] == 0;
        if (!(known ? loop->d[i] == 0 : loop->d[i] > 0 && loop->d[i] - loop->d[i] == 0))
            return 0;
    }
    return 1;
}
#else
/* All pivots of Gaussian elimination are positive. P is kept as a triangle: it cannot be unsymmetric. */
static int is_definite(const OF(t) * loop, const OF(t) * beginning)
{
    double left[NX][NX];
    for (int i = 0; i < NX; i++)
        for (int j = 0; j <= i; j++)
            left[i][j] = (double)loop->P[i * (i + 1) / 2 + j];
    for (int k = 0; k < NX; k++) {
        const int known = beginning->P[k * (k + 1) / 2 + k] == 0;
        if (!(known ? left[k][k] == 0 : left[k][k] > 0))
            return 0;
        for (int i = k + 1; i < NX && !known; i++)
            for (int j = k + 1; j <= i; j++)
                left[i][j] -= left[i][k] / left[k][k] * left[j][k];
    }
    return 1;
}
#endif

/* Far from where it would begin anew. */
static int is_well_within_bounds(const OF(t) * loop)
{
    static const REAL bound[NX] = SIZE(X_BOUNDS);

    for (int i = 0; i < NX; i++)
        if (!(loop->x[i] > -bound[i] / 1000 && loop->x[i] < bound[i] / 1000))
            return 0;
    return loop->resets == 0;
}

/* Uniform in [−1, 1). */
static double noise(unsigned long *seed)
{
    *seed = (*seed * 1664525ul + 1013904223ul) & 0xfffffffful;
    return (double)*seed / 2147483648.0 - 1;
}

static lqg_status_t predict(OF(t) * loop, unsigned long *seed)
{
#ifdef HAS_INPUT
    REAL u[SIZE(NU)];
    for (int i = 0; i < SIZE(NU); i++)
        u[i] = (REAL)noise(seed);
    return OF(predict)(loop, u);
#else
    (void)seed;
    return OF(predict)(loop);
#endif
}

int main(int count, char *arguments[])
{
    const unsigned long samples = count > 1 ? strtoul(arguments[1], NULL, 10) : 1000000;
    unsigned long seed = 1;
    OF(t) loop, beginning;
    REAL y[NY];

    OF(init)(&beginning);
    loop = beginning;
    for (unsigned long sample = 0; sample < samples; sample++) {
        for (int i = 0; i < NY; i++)
            y[i] = noise(&seed) < -0.875 ? (REAL)NAN : (REAL)noise(&seed);
        lqg_status_t status = OF(update)(&loop, y);
        const int fine = is_definite(&loop, &beginning);
        status |= predict(&loop, &seed);
        if (!fine || !is_definite(&loop, &beginning) || !is_well_within_bounds(&loop) ||
            (status & ~(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS | LQG_OUTPUT_GATED))) {
            printf("sample %lu: %s\n", sample, lqg_status_text(status));
            return 1;
        }
    }
    printf("%lu samples\n", samples);
    return 0;
}
