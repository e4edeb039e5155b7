/* SPDX-License-Identifier: MIT */
#include "noise.h"

#include <stdint.h>

/* The sum of twelve uniform numbers has variance 1. */
double noise_normal(void)
{
    static uint32_t state = 2463534242u; /* xorshift (Marsaglia 2003) */
    double sum = -6.0;

    for (int i = 0; i < 12; i++) {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        sum += state / 4294967296.0;
    }
    return sum;
}
