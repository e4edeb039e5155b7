/* SPDX-License-Identifier: MIT */
/* Random numbers that are the same on every machine with the same libm: uniform between 0 and 1, and normal. */
#ifndef LQG_TEST_DRAWS_H
#define LQG_TEST_DRAWS_H

#include <math.h>
#include <stdint.h>

static double uniform(void)
{
    static uint64_t word = 1;

    word = word * 6364136223846793005u + 1442695040888963407u;
    return ((double)(word >> 11) + 0.5) / 9007199254740992.0;
}

static double normal(void)
{
    const double size = sqrt(-2 * log(uniform()));

    return size * cos(6.283185307179586 * uniform());
}

#endif
