/* SPDX-License-Identifier: MIT */
/* Every bit of lqg/functions.h in one number for each scalar: of each function for a thousand arguments. */
#ifndef TEST_HASH_FUNCTIONS_H
#define TEST_HASH_FUNCTIONS_H

#include "hash.h"
#include "lqg/functions.h"

static uint32_t next_word(uint32_t *seed)
{
    return *seed = *seed * 1664525u + 1013904223u;
}

/* A multiple of 2⁻²² below 2 in its size. */
static float small_float(uint32_t *seed)
{
    return ((float)(next_word(seed) >> 8) - 8388608.0f) * (1.0f / 4194304.0f);
}

/* In turn: any bits; below 2, 16 and 16384. What it computes is exact. */
static float draw_float(uint32_t *seed, unsigned kind)
{
    static const float scales[3] = {1.0f, 8.0f, 8192.0f};
    return kind == 0 ? lqg_of_bitsf(next_word(seed)) : scales[kind - 1] * small_float(seed);
}

static unsigned long long hash_float(unsigned long long hash, float value)
{
    const uint32_t bits = lqg_bitsf(value);
    return hash_bytes(hash, &bits, sizeof bits);
}

static unsigned long long hash_float_functions(void)
{
    static float (*const functions[])(float) = {lqg_sinf,  lqg_cosf, lqg_tanf, lqg_asinf, lqg_acosf, lqg_atanf,
                                                lqg_sqrtf, lqg_expf, lqg_logf, lqg_tanhf, lqg_wrapf};
    unsigned long long hash = NOTHING_HASHED;
    uint32_t seed = 1;

    for (unsigned i = 0; i < 1000; i++) {
        const float x = draw_float(&seed, i % 4), y = draw_float(&seed, i / 4 % 4);
        float sine, cosine;
        for (unsigned f = 0; f < sizeof functions / sizeof *functions; f++)
            hash = hash_float(hash, functions[f](x));
        lqg_sin_cosf(y, &sine, &cosine);
        hash = hash_float(hash_float(hash, sine), cosine);
        hash = hash_float(hash, lqg_atan2f(y, x));
    }
    return hash;
}

#if LQG_HAS_DOUBLE
static double draw_double(uint32_t *seed, unsigned kind)
{
    static const double scales[3] = {1.0, 8.0, 1048576.0};
    const uint64_t word = next_word(seed);
    return kind == 0 ? lqg_of_bits(word << 32 | next_word(seed))
                     : scales[kind - 1] * ((double)small_float(seed) + (double)(word >> 8) * (1.0 / 70368744177664.0));
}

static unsigned long long hash_double(unsigned long long hash, double value)
{
    const uint64_t bits = lqg_bits(value);
    return hash_bytes(hash, &bits, sizeof bits);
}

/* Not beyond tanh 4: with 1 − b, 2⁻³³ ≤ b < 2⁻³², src/README.md says what libgcc does on a Cortex-M3 or M4. */
static unsigned long long hash_double_functions(void)
{
    static double (*const functions[])(double) = {lqg_sin,  lqg_cos,  lqg_tan, lqg_asin, lqg_acos,
                                                  lqg_atan, lqg_sqrt, lqg_exp, lqg_log,  lqg_wrap};
    unsigned long long hash = NOTHING_HASHED;
    uint32_t seed = 1;

    for (unsigned i = 0; i < 1000; i++) {
        const double x = draw_double(&seed, i % 4), y = draw_double(&seed, i / 4 % 4);
        double sine, cosine;
        for (unsigned f = 0; f < sizeof functions / sizeof *functions; f++)
            hash = hash_double(hash, functions[f](x));
        lqg_sin_cos(y, &sine, &cosine);
        hash = hash_double(hash_double(hash, sine), cosine);
        hash = hash_double(hash, lqg_atan2(y, x));
        hash = hash_double(hash, lqg_tanh(0.25 * x));
    }
    return hash;
}
#endif

#endif
