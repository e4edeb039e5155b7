/* SPDX-License-Identifier: MIT */
/* What a controller hears, and how it is noted, in REAL. Nothing here is rounded. */
#ifndef TEST_SAMPLES_H
#define TEST_SAMPLES_H

#include <stddef.h>
#include <stdint.h>

#include "hashes.h"
#include "lqg/arithmetic.h"
#include "lqg/status.h"

LQG_STRICT_BEGIN

typedef struct {
    uint32_t seed;
    unsigned halvings; /* with growing ones the signals, first at limits and gates, come into the linear range */
} source_t;

/* Uniform in [−1, 1), multiples of 2⁻¹⁵, times 2 to the power of −halvings: exact in either scalar. */
static inline void draw_all(source_t *source, REAL values[], int count)
{
    LQG_STRICT_BODY
    for (int i = 0; i < count; i++) {
        source->seed = source->seed * 1664525u + 1013904223u;
        values[i] = ((REAL)(source->seed >> 16) - 32768) / (REAL)(32768ull << source->halvings);
    }
}

/* One output in 32 becomes a NaN, and one in 64 infinite. */
static inline void fail_some(source_t *source, REAL y[], int count)
{
    LQG_STRICT_BODY
    static volatile const REAL zero = 0;

    for (int i = 0; i < count; i++) {
        source->seed = source->seed * 1664525u + 1013904223u;
        const unsigned chance = source->seed >> 26;
        if (chance < 2)
            y[i] = zero / zero;
        if (chance == 2)
            y[i] = (y[i] < 0 ? (REAL)-1 : (REAL)1) / zero;
    }
}

static inline hashes_t hash_reals(hashes_t hashes, const REAL *values, size_t size)
{
    LQG_STRICT_BODY
    hashes.bits = hash_bytes(hashes.bits, values, size);
    for (size_t i = 0; i < size / sizeof *values; i++) {
        const REAL value = values[i] + 0;
        hashes.values = hash_bytes(hashes.values, &value, sizeof value);
    }
    return hashes;
}

/* What happened, not to which output: as it was before the status said that. */
static inline hashes_t hash_status(hashes_t hashes, lqg_status_t status)
{
    const uint32_t bits = status & ~LQG_OUTPUT_REJECTED_BITS;
    hashes.bits = hash_bytes(hashes.bits, &bits, sizeof bits);
    hashes.values = hash_bytes(hashes.values, &bits, sizeof bits);
    return hashes;
}

LQG_STRICT_END

#endif
