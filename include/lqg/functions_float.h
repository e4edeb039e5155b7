/* SPDX-License-Identifier: MIT */
/* TinyLQG: elementary functions of float. What they promise: lqg/functions.h; how they do it: src/README.md. */
#ifndef LQG_FUNCTIONS_FLOAT_H
#define LQG_FUNCTIONS_FLOAT_H

#include <stdbool.h>
#include <stdint.h>

#include "lqg/arithmetic.h"
#include "lqg/functions_bits.h"
#include "lqg/functions_polynomials.h"

/* The largest |x| of sin, cos, tan and wrap. */
#define LQG_ANGLE_MAXF 8192.0f

LQG_STRICT_BEGIN

/* r + rest = a − n π/2 of the integer n next to a·2/π, 0 ≤ a ≤ LQG_ANGLE_MAXF: |r| ≤ 0.7862. The last two bits
 * of *n are those of n. π/2 is the sum of four parts. n has at most 13 bits, the first three parts 11 or fewer:
 * their products are exact, and so are the first two differences. r is rounded once; where that is not exact, rest is
 * far below it. */
static inline float lqg_reducef(float a, float *rest, uint32_t *n)
{
    LQG_STRICT_BODY
    const float shifted = a * 0.636619772f + 8388608.0f; /* 2²³: integers only */
    const float quarters = shifted - 8388608.0f;

    *n = lqg_bitsf(shifted);
    *rest = quarters * -2.56334407e-12f;
    return ((a - quarters * 1.5703125f) - quarters * 0.000483751297f) - quarters * 7.54953362e-08f;
}

/* sin, cos of the reduced angle r + rest, z = r². */
static inline float lqg_sin_reducedf(float r, float rest, float z)
{
    LQG_STRICT_BODY
    return r + (r * (z * lqg_sin_polynomialf(z)) + rest);
}

static inline float lqg_cos_reducedf(float z)
{
    LQG_STRICT_BODY
    return 1.0f + z * (z * lqg_cos_polynomialf(z) - 0.5f);
}

/* *sine = sin x, *cosine = cos x. */
static inline void lqg_sin_cosf(float x, float *sine, float *cosine)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a = bits & 0x7fffffffu;
    uint32_t n;
    float r, rest, z, s, c;

    if (a > 0x46000000u) { /* LQG_ANGLE_MAXF */
        *sine = lqg_of_bitsf(LQG_NANF);
        *cosine = *sine;
        return;
    }
    r = lqg_reducef(lqg_of_bitsf(a), &rest, &n);
    z = r * r;
    s = lqg_sin_reducedf(r, rest, z);
    c = lqg_cos_reducedf(z);
    *sine = lqg_change_signf((n & 1u) != 0u ? c : s, bits ^ (n << 30));
    *cosine = lqg_change_signf((n & 1u) != 0u ? s : c, (n + 1u) << 30);
}

static inline float lqg_sinf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a = bits & 0x7fffffffu;
    uint32_t n;
    float r, rest, z;

    if (a > 0x46000000u)
        return lqg_of_bitsf(LQG_NANF);
    r = lqg_reducef(lqg_of_bitsf(a), &rest, &n);
    z = r * r;
    r = (n & 1u) != 0u ? lqg_cos_reducedf(z) : lqg_sin_reducedf(r, rest, z);
    return lqg_change_signf(r, bits ^ (n << 30));
}

static inline float lqg_cosf(float x)
{
    LQG_STRICT_BODY
    const uint32_t a = lqg_bitsf(x) & 0x7fffffffu;
    uint32_t n;
    float r, rest, z;

    if (a > 0x46000000u)
        return lqg_of_bitsf(LQG_NANF);
    r = lqg_reducef(lqg_of_bitsf(a), &rest, &n);
    z = r * r;
    r = (n & 1u) != 0u ? lqg_sin_reducedf(r, rest, z) : lqg_cos_reducedf(z);
    return lqg_change_signf(r, (n + 1u) << 30);
}

/* As lqg_reducef, but with a rest that includes what the rounding of r has left: tan is steeper than sin. */
static inline float lqg_tanf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a = bits & 0x7fffffffu;
    float t = lqg_of_bitsf(a), shifted, quarters, exact, part, r, rest, z;

    if (a > 0x46000000u)
        return lqg_of_bitsf(LQG_NANF);
    shifted = t * 0.636619772f + 8388608.0f;
    quarters = shifted - 8388608.0f;
    exact = (t - quarters * 1.5703125f) - quarters * 0.000483751297f;
    part = quarters * 7.54953362e-08f;
    r = exact - part;
    rest = ((exact - r) - part) - quarters * 2.56334407e-12f;
    z = r * r;
    t = r + (r * (z * lqg_tan_polynomialf(z)) + rest);
    return lqg_change_signf((lqg_bitsf(shifted) & 1u) != 0u ? -1.0f / t : t, bits);
}

/* The angle of ]−π, π[ that is x but for whole turns: up to 3π one turn, beyond by the reduction, whose rounding may
 * leave a turn too many. */
static inline float lqg_wrapf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a_bits = bits & 0x7fffffffu;
    float a = lqg_of_bitsf(a_bits);

    if (a_bits > 0x46000000u)
        return lqg_of_bitsf(LQG_NANF);
    if (a <= 3.1415925f)
        return x;
    if (a > 9.424777f) { /* 3π */
        const float quarters = 4.0f * ((a * 0.159154943f + 8388608.0f) - 8388608.0f);
        a = a - quarters * 1.5703125f;
        a = a - quarters * 0.000483751297f;
        a = a - quarters * 7.54953362e-08f;
        a = a - quarters * 2.56334407e-12f;
    }
    if (a > 3.1415925f)
        a = (a - 6.28318548f) + 1.74845553e-07f;
    if (a < -3.1415925f)
        a = (a + 6.28318548f) - 1.74845553e-07f;
    return lqg_change_signf(a, bits);
}

static inline float lqg_asinf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a = bits & 0x7fffffffu;
    float z, s;

    if (a > 0x3f800000u) /* 1 */
        return lqg_of_bitsf(LQG_NANF);
    if (a <= 0x3f100000u) { /* 0.5625 */
        z = x * x;
        return x + x * (z * lqg_asin_polynomialf(z));
    }
    z = (1.0f - lqg_of_bitsf(a)) * 0.5f; /* asin a = π/2 − 2 asin √z */
    s = 2.0f * lqg_sqrtf(z);
    return lqg_change_signf(1.57079637f - (s + (s * (z * lqg_asin_polynomialf(z)) + 4.37113883e-08f)), bits);
}

static inline float lqg_acosf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a = bits & 0x7fffffffu;
    float z, s;

    if (a > 0x3f800000u)
        return lqg_of_bitsf(LQG_NANF);
    if (a <= 0x3f100000u) {
        z = x * x;
        return 1.57079637f - (x + (x * (z * lqg_asin_polynomialf(z)) + 4.37113883e-08f));
    }
    z = (1.0f - lqg_of_bitsf(a)) * 0.5f; /* acos a = 2 asin √z, acos −a = π − acos a */
    s = 2.0f * lqg_sqrtf(z);
    z = s * (z * lqg_asin_polynomialf(z));
    return bits == a ? s + z : 3.14159274f - (s + (z + 8.74227766e-08f));
}

/* atan t + low, 0 ≤ t ≤ 1. */
static inline float lqg_atan_plusf(float t, float low)
{
    LQG_STRICT_BODY
    const float z = t * t;

    return t + (t * (z * lqg_atan_polynomialf(z)) + low);
}

static inline float lqg_atanf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a = bits & 0x7fffffffu;
    float t;

    if (a > 0x7f800000u)
        return lqg_of_bitsf(LQG_NANF);
    t = lqg_of_bitsf(a);
    if (a > 0x3f800000u) /* π/2 − atan 1/a */
        t = 1.57079637f - lqg_atan_plusf(1.0f / t, 4.37113883e-08f);
    else
        t = lqg_atan_plusf(t, 0.0f);
    return lqg_change_signf(t, bits);
}

/* The angle of the vector (x, y), in [−π, π]: of its eight octants, `base` begins or ends two. */
static inline float lqg_atan2f(float y, float x)
{
    LQG_STRICT_BODY
    const uint32_t x_bits = lqg_bitsf(x), y_bits = lqg_bitsf(y);
    const uint32_t ax = x_bits & 0x7fffffffu, ay = y_bits & 0x7fffffffu;
    const uint32_t small = ax < ay ? ax : ay, large = ax < ay ? ay : ax;
    const bool is_left = x_bits != ax, is_steep = ax < ay;
    float base = 0.0f, low = 0.0f, t;

    if (large > 0x7f800000u)
        return lqg_of_bitsf(LQG_NANF);
    if (is_steep) {
        base = 1.57079637f;
        low = -4.37113883e-08f;
    }
    if (is_left && !is_steep) {
        base = 3.14159274f;
        low = -8.74227766e-08f;
    }
    t = small == 0u ? 0.0f : small == large ? 1.0f : lqg_of_bitsf(small) / lqg_of_bitsf(large);
    if (is_steep == is_left)
        t = base + lqg_atan_plusf(t, low);
    else
        t = base - lqg_atan_plusf(t, -low);
    return lqg_change_signf(t, y_bits);
}

/* eˣ, −104 ≤ x ≤ 88.8: 2ⁿ e^(x − n ln 2), in two factors, as 2ⁿ alone may be no float. ln 2 is the sum of two parts,
 * the first of 15 bits: its product is exact. */
static inline float lqg_exp_withinf(float x)
{
    LQG_STRICT_BODY
    const float shifted = x * 1.44269504f + 12582912.0f; /* 2²³ + 2²² */
    const float n = shifted - 12582912.0f;
    const float r = (x - n * 0.693145752f) - n * 1.42860677e-06f;
    const uint32_t bits = lqg_bitsf(shifted), half = bits >> 1;

    x = 1.0f + (r + r * (r * lqg_exp_polynomialf(r)));
    return x * lqg_of_bitsf((half + 127u) << 23) * lqg_of_bitsf((bits - half + 127u) << 23);
}

static inline float lqg_expf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x);

    if ((bits & 0x7fffffffu) > 0x7f800000u)
        return lqg_of_bitsf(LQG_NANF);
    if (x > 88.8f)
        return lqg_of_bitsf(0x7f800000u);
    if (x < -104.0f)
        return 0.0f;
    return lqg_exp_withinf(x);
}

/* x = m 2ⁿ with √½ ≤ m < √2: n ln 2 + log m. */
static inline float lqg_logf(float x)
{
    LQG_STRICT_BODY
    uint32_t bits = lqg_bitsf(x);
    int32_t exponent = -127;
    float n, f, z;

    if (bits - 0x00800000u >= 0x7f000000u) { /* not a normal number above 0 */
        if ((bits & 0x7fffffffu) == 0u)
            return lqg_of_bitsf(0xff800000u);
        if (bits == 0x7f800000u)
            return x;
        if (bits > 0x7f800000u)
            return lqg_of_bitsf(LQG_NANF);
        bits = lqg_bitsf(x * 8388608.0f);
        exponent = -150;
    }
    bits += 0x3f800000u - 0x3f3504f3u; /* 1 − √½ */
    exponent += (int32_t)(bits >> 23);
    n = (float)exponent;
    f = lqg_of_bitsf((bits & 0x007fffffu) + 0x3f3504f3u) - 1.0f;
    z = f * f;
    z = (f * (z * lqg_log_polynomialf(f)) + n * 1.42860677e-06f) - 0.5f * z;
    return n * 0.693145752f + (f + z);
}

static inline float lqg_tanhf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x), a = bits & 0x7fffffffu;
    float t;

    if (a > 0x7f800000u)
        return lqg_of_bitsf(LQG_NANF);
    t = lqg_of_bitsf(a);
    if (a <= 0x3f0ccccdu) { /* 0.55 */
        const float z = t * t;
        t = t + t * (z * lqg_tanh_polynomialf(z));
    } else if (a <= 0x41200000u) { /* 10 */
        t = 1.0f - 2.0f / (lqg_exp_withinf(2.0f * t) + 1.0f); /* e²ˣ */
    } else {
        t = 1.0f;
    }
    return lqg_change_signf(t, bits);
}

LQG_STRICT_END

#endif
