/* SPDX-License-Identifier: MIT */
/* A controller that keeps z for a long time: noise for outputs, one in 16 missing. z and u stay finite, and near what
 * they were: it never begins anew, and no output that was missing is left in it.
 *
 *     soak_form [samples]
 *
 * HEADER, NAME and UPPER_NAME are the controller's, REAL its scalar; PREDICTS: u is made before y is there. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

enum { NY = SIZE(NY), NU = SIZE(NU), BEGINNING = 10000 };

/* Uniform in [−1, 1). */
static double noise(unsigned long *seed)
{
    *seed = (*seed * 1664525ul + 1013904223ul) & 0xfffffffful;
    return (double)*seed / 2147483648.0 - 1;
}

static lqg_status_t take_sample(OF(t) * loop, const REAL y[], REAL u[])
{
#ifdef PREDICTS
    const lqg_status_t status = OF(control)(loop, u);
    return status | OF(advance)(loop, y);
#else
    const lqg_status_t status = OF(control)(loop, y, u);
    return status | OF(advance)(loop);
#endif
}

int main(int count, char *arguments[])
{
    const unsigned long samples = count > 1 ? strtoul(arguments[1], NULL, 10) : 1000000;
    unsigned long seed = 1;
    double largest = 0; /* |u| in the beginning */
    OF(t) loop;
    REAL y[NY], u[NU];

    OF(init)(&loop);
    for (unsigned long sample = 0; sample < samples; sample++) {
        for (int i = 0; i < NY; i++)
            y[i] = noise(&seed) < -0.875 ? (REAL)NAN : (REAL)noise(&seed);
        const lqg_status_t status = take_sample(&loop, y, u);
        double size = 0;
        for (int i = 0; i < NU; i++)
            size = fmax(size, fabs((double)u[i]));
        if (sample < BEGINNING)
            largest = fmax(largest, size);
        if ((status & ~(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS)) || !(size <= 2 * largest)) {
            printf("sample %lu: %s, |u| = %g\n", sample, lqg_status_text(status), size);
            return 1;
        }
    }
    printf("%lu samples, |u| up to %g\n", samples, largest);
    return 0;
}
