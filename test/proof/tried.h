/* SPDX-License-Identifier: MIT */
/* In place of unknown.h: the driver's calls as a program, which draws what the prover takes for anything, and ends
 * where what is said to follow from a test does not. */
#ifndef PROOF_UNKNOWN_H
#define PROOF_UNKNOWN_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "finite.h"
#include "lqg/arithmetic.h"

/* Knuth's MMIX generator */
static inline uint32_t draw(void)
{
    static uint64_t state = 1;

    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 32);
}

/* Mostly what is honest, now and then any bits: one term alone is beyond its bound. */
static inline lqg_real draw_real(void)
{
    const uint64_t bits = (uint64_t)draw() << 32 | draw();
    const uint32_t kind = draw() % 16;
    lqg_real value;

    if (kind > 1)
        return (lqg_real)draw() / (lqg_real)1073741824.0f - 2;
    memcpy(&value, &bits, sizeof value);
    return kind ? value : (lqg_real)(draw() % 3) - 1;
}

static inline int contradicted(const char *test, const char *facts)
{
    fprintf(stderr, "%s passed without %s\n", test, facts);
    exit(1);
}

#define RESTATED(test, facts) ((test) ? (facts) || contradicted(#test, #facts) : 0)
#define any_int ((int)(draw() % CALLS))
#define any_count ((unsigned long)draw())
#define any_real draw_real()

#endif
