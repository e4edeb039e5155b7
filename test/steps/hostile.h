/* SPDX-License-Identifier: MIT */
/* What no controller wants to hear, in REAL: a third of the samples is honest, so that the state can become good again
 * in between. */
#ifndef TEST_HOSTILE_H
#define TEST_HOSTILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "lqg/arithmetic.h"
#include "results.h"

LQG_STRICT_BEGIN

typedef struct {
    uint64_t seed;
    int size; /* signals are of 2^size */
} hostility_t;

static inline uint32_t draw(hostility_t *hostility)
{
    hostility->seed = hostility->seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(hostility->seed >> 33);
}

static inline bool one_in(hostility_t *hostility, uint32_t number)
{
    return draw(hostility) % number == 0;
}

/* Signals from 2⁻¹² to 2³, for a hundred samples. */
static inline void begin_sample(hostility_t *hostility, unsigned sample)
{
    if (sample % 100 == 0)
        hostility->size = (int)(draw(hostility) % 16) - 12;
}

static inline REAL two_to(int exponent)
{
    REAL power = 1;

    for (; exponent > 0; exponent--)
        power *= 2;
    for (; exponent < 0; exponent++)
        power /= 2;
    return power;
}

static inline void draw_all(hostility_t *hostility, REAL values[], int count)
{
    const REAL size = two_to(hostility->size - 15);

    for (int i = 0; i < count; i++)
        values[i] = ((REAL)(draw(hostility) % 65536) - 32768) * size;
}

/* Missing, infinite, a spike of any size, or what it is. */
static inline REAL made_hostile(hostility_t *hostility, REAL value)
{
    static volatile const REAL zero = 0;

    switch (draw(hostility) % 24) {
        case 0:
            return zero / zero;
        case 1:
            return (value < 0 ? (REAL)-1 : (REAL)1) / zero;
        case 2:
            return value * two_to((int)(draw(hostility) % 130));
        default:
            return value;
    }
}

static inline void draw_hostile(hostility_t *hostility, REAL values[], int count)
{
    draw_all(hostility, values, count);
    if (one_in(hostility, 3))
        for (int i = 0; i < count; i++)
            values[i] = made_hostile(hostility, values[i]);
}

static inline bool flips(hostility_t *hostility)
{
    return one_in(hostility, 8);
}

/* One bit of the state, or all bits of what may be a number: a NaN then. */
static inline void flip(hostility_t *hostility, void *state, size_t size)
{
    unsigned char *const bytes = (unsigned char *)state;

    if (one_in(hostility, 2))
        bytes[draw(hostility) % size] ^= (unsigned char)(1u << draw(hostility) % 8);
    else
        memset(bytes + draw(hostility) % (size / sizeof(REAL)) * sizeof(REAL), 0xFF, sizeof(REAL));
}

static inline bool same_bytes(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static inline bool same_reals(const REAL a[], const REAL b[], int count)
{
    return same_bytes(a, b, (size_t)count * sizeof a[0]);
}

LQG_STRICT_END

#endif
