/* SPDX-License-Identifier: MIT */
/* TinyLQG: elementary functions of double. What they promise: lqg/functions.h; how they do it: src/README.md. */
#ifndef LQG_FUNCTIONS_DOUBLE_H
#define LQG_FUNCTIONS_DOUBLE_H

#include <stdbool.h>
#include <stdint.h>

#include "lqg/arithmetic.h"
#include "lqg/functions_bits.h"
#include "lqg/functions_polynomials.h"

/* The largest |x| of sin, cos, tan and wrap. */
#define LQG_ANGLE_MAX 1048576.0

#if LQG_HAS_DOUBLE
LQG_STRICT_BEGIN

/* r + rest = a − n π/2 of the integer n next to a·2/π, 0 ≤ a ≤ LQG_ANGLE_MAX: |r| ≤ 0.7855. The last two bits
 * of *n are those of n. π/2 is the sum of four parts. n has at most 20 bits, the first three parts 33 or fewer:
 * their products are exact, and so are the first two differences. r is rounded once; where that is not exact, rest is
 * far below it. */
static inline double lqg_reduce(double a, double *rest, uint32_t *n)
{
    LQG_STRICT_BODY
    const double shifted = a * 0.63661977236758138 + 4503599627370496.0; /* 2⁵²: integers only */
    const double quarters = shifted - 4503599627370496.0;

    *n = (uint32_t)lqg_bits(shifted);
    *rest = quarters * 2.9407886703873282e-27;
    a = (a - quarters * 1.5707963267341256) - quarters * 6.0771054855024431e-11;
    return a + quarters * 4.9789962502207207e-17;
}

/* sin, cos of the reduced angle r + rest, z = r². */
static inline double lqg_sin_reduced(double r, double rest, double z)
{
    LQG_STRICT_BODY
    return r + (r * (z * lqg_sin_polynomial(z)) + rest);
}

static inline double lqg_cos_reduced(double z)
{
    LQG_STRICT_BODY
    return 1.0 + z * (z * lqg_cos_polynomial(z) - 0.5);
}

/* *sine = sin x, *cosine = cos x. */
static inline void lqg_sin_cos(double x, double *sine, double *cosine)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;
    uint32_t n;
    double r, rest, z, s, c;

    if (a > 0x4130000000000000u) { /* LQG_ANGLE_MAX */
        *sine = lqg_of_bits(LQG_NAN);
        *cosine = *sine;
        return;
    }
    r = lqg_reduce(lqg_of_bits(a), &rest, &n);
    z = r * r;
    s = lqg_sin_reduced(r, rest, z);
    c = lqg_cos_reduced(z);
    *sine = lqg_change_sign((n & 1u) != 0u ? c : s, bits ^ ((uint64_t)n << 62));
    *cosine = lqg_change_sign((n & 1u) != 0u ? s : c, ((uint64_t)n + 1u) << 62);
}

static inline double lqg_sin(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;
    uint32_t n;
    double r, rest, z;

    if (a > 0x4130000000000000u)
        return lqg_of_bits(LQG_NAN);
    r = lqg_reduce(lqg_of_bits(a), &rest, &n);
    z = r * r;
    r = (n & 1u) != 0u ? lqg_cos_reduced(z) : lqg_sin_reduced(r, rest, z);
    return lqg_change_sign(r, bits ^ ((uint64_t)n << 62));
}

static inline double lqg_cos(double x)
{
    LQG_STRICT_BODY
    const uint64_t a = lqg_bits(x) & 0x7fffffffffffffffu;
    uint32_t n;
    double r, rest, z;

    if (a > 0x4130000000000000u)
        return lqg_of_bits(LQG_NAN);
    r = lqg_reduce(lqg_of_bits(a), &rest, &n);
    z = r * r;
    r = (n & 1u) != 0u ? lqg_sin_reduced(r, rest, z) : lqg_cos_reduced(z);
    return lqg_change_sign(r, ((uint64_t)n + 1u) << 62);
}

/* As lqg_reduce, but with a rest that includes what the rounding of r has left: tan is steeper than sin. */
static inline double lqg_tan(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;
    double t = lqg_of_bits(a), shifted, quarters, exact, part, r, rest, z;

    if (a > 0x4130000000000000u)
        return lqg_of_bits(LQG_NAN);
    shifted = t * 0.63661977236758138 + 4503599627370496.0;
    quarters = shifted - 4503599627370496.0;
    exact = (t - quarters * 1.5707963267341256) - quarters * 6.0771054855024431e-11;
    part = quarters * 4.9789962502207207e-17;
    r = exact + part;
    rest = ((exact - r) + part) + quarters * 2.9407886703873282e-27;
    z = r * r;
    t = r + (r * (z * lqg_tan_polynomial(z)) + rest);
    return lqg_change_sign((lqg_bits(shifted) & 1u) != 0u ? -1.0 / t : t, bits);
}

/* The angle of ]−π, π[ that is x but for whole turns: up to 3π one turn, beyond by the reduction, whose rounding may
 * leave a turn too many. */
static inline double lqg_wrap(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a_bits = bits & 0x7fffffffffffffffu;
    double a = lqg_of_bits(a_bits);

    if (a_bits > 0x4130000000000000u)
        return lqg_of_bits(LQG_NAN);
    if (a <= 3.1415926535897931)
        return x;
    if (a > 9.4247779607693) { /* 3π */
        const double quarters = 4.0 * ((a * 0.15915494309189535 + 4503599627370496.0) - 4503599627370496.0);
        a = a - quarters * 1.5707963267341256;
        a = a - quarters * 6.0771054855024431e-11;
        a = a + quarters * 4.9789962502207207e-17;
        a = a + quarters * 2.9407886703873282e-27;
    }
    if (a > 3.1415926535897931)
        a = (a - 6.2831853071795862) - 2.4492935982947064e-16;
    if (a < -3.1415926535897931)
        a = (a + 6.2831853071795862) + 2.4492935982947064e-16;
    return lqg_change_sign(a, bits);
}

static inline double lqg_asin(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;
    double z, s;

    if (a > 0x3ff0000000000000u) /* 1 */
        return lqg_of_bits(LQG_NAN);
    if (a <= 0x3fe2000000000000u) { /* 0.5625 */
        z = x * x;
        return x + x * (z * lqg_asin_polynomial(z));
    }
    z = (1.0 - lqg_of_bits(a)) * 0.5; /* asin a = π/2 − 2 asin √z */
    s = 2.0 * lqg_sqrt(z);
    s = s + (s * (z * lqg_asin_polynomial(z)) - 6.123233995736766e-17);
    return lqg_change_sign(1.5707963267948966 - s, bits);
}

static inline double lqg_acos(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;
    double z, s;

    if (a > 0x3ff0000000000000u)
        return lqg_of_bits(LQG_NAN);
    if (a <= 0x3fe2000000000000u) {
        z = x * x;
        return 1.5707963267948966 - (x + (x * (z * lqg_asin_polynomial(z)) - 6.123233995736766e-17));
    }
    z = (1.0 - lqg_of_bits(a)) * 0.5; /* acos a = 2 asin √z, acos −a = π − acos a */
    s = 2.0 * lqg_sqrt(z);
    z = s * (z * lqg_asin_polynomial(z));
    return bits == a ? s + z : 3.1415926535897931 - (s + (z - 1.2246467991473532e-16));
}

/* atan t + low, 0 ≤ t ≤ 1: atan t = atan c + atan u, u = (t − c)/(1 + c t), c = 0, ½ or 1. */
static inline double lqg_atan_plus(double t, double low)
{
    LQG_STRICT_BODY
    double u = t, high = 0.0, rest = low, z;

    if (t > 0.375) {
        if (t > 0.6875) {
            u = (t - 1.0) / (t + 1.0);
            high = 0.78539816339744828; /* atan 1 */
            rest = low + 3.061616997868383e-17;
        } else {
            u = (2.0 * t - 1.0) / (2.0 + t);
            high = 0.46364760900080609; /* atan ½ */
            rest = low + 2.2698777452961687e-17;
        }
    }
    z = u * u;
    return high + (u + (u * (z * lqg_atan_polynomial(z)) + rest));
}

static inline double lqg_atan(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;
    double t;

    if (a > 0x7ff0000000000000u)
        return lqg_of_bits(LQG_NAN);
    t = lqg_of_bits(a);
    if (a > 0x3ff0000000000000u) /* π/2 − atan 1/a */
        t = 1.5707963267948966 - lqg_atan_plus(1.0 / t, -6.123233995736766e-17);
    else
        t = lqg_atan_plus(t, 0.0);
    return lqg_change_sign(t, bits);
}

/* The angle of the vector (x, y), in [−π, π]: of its eight octants, `base` begins or ends two. */
static inline double lqg_atan2(double y, double x)
{
    LQG_STRICT_BODY
    const uint64_t x_bits = lqg_bits(x), y_bits = lqg_bits(y);
    const uint64_t ax = x_bits & 0x7fffffffffffffffu, ay = y_bits & 0x7fffffffffffffffu;
    const uint64_t small = ax < ay ? ax : ay, large = ax < ay ? ay : ax;
    const bool is_left = x_bits != ax, is_steep = ax < ay;
    double base = 0.0, low = 0.0, t;

    if (large > 0x7ff0000000000000u)
        return lqg_of_bits(LQG_NAN);
    if (is_steep) {
        base = 1.5707963267948966;
        low = 6.123233995736766e-17;
    }
    if (is_left && !is_steep) {
        base = 3.1415926535897931;
        low = 1.2246467991473532e-16;
    }
    t = small == 0u ? 0.0 : small == large ? 1.0 : lqg_of_bits(small) / lqg_of_bits(large);
    if (is_steep == is_left)
        t = base + lqg_atan_plus(t, low);
    else
        t = base - lqg_atan_plus(t, -low);
    return lqg_change_sign(t, y_bits);
}

/* 2ⁿ, −1022 ≤ n ≤ 1023, n modulo 2¹². */
static inline double lqg_power(uint32_t n)
{
    return lqg_of_bits(((uint64_t)n + 1023u) << 52);
}

/* eˣ, −746 ≤ x ≤ 709.8: 2ⁿ e^(x − n ln 2), in two factors, as 2ⁿ alone may be no double. ln 2 is the sum of two parts,
 * the first of 42 bits: its product is exact. */
static inline double lqg_exp_within(double x)
{
    LQG_STRICT_BODY
    const double shifted = x * 1.4426950408889634 + 6755399441055744.0; /* 2⁵² + 2⁵¹: integers only */
    const double n = shifted - 6755399441055744.0;
    const double r = (x - n * 0.6931471805601177) + n * 1.7239444525614835e-13;
    const uint32_t bits = (uint32_t)lqg_bits(shifted), half = bits >> 1;

    x = 1.0 + (r + r * (r * lqg_exp_polynomial(r)));
    return x * lqg_power(half) * lqg_power(bits - half);
}

static inline double lqg_exp(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x);

    if ((bits & 0x7fffffffffffffffu) > 0x7ff0000000000000u)
        return lqg_of_bits(LQG_NAN);
    if (x > 709.8)
        return lqg_of_bits(0x7ff0000000000000u);
    if (x < -746.0)
        return 0.0;
    return lqg_exp_within(x);
}

/* x = m 2ⁿ with √½ ≤ m < √2: n ln 2 + log m; log m = log(1 + f) = log((1 + s)/(1 − s)), s = f/(2 + f), in which 2s is
 * f − s f, and s f = f²/2 − s f²/2. */
static inline double lqg_log(double x)
{
    LQG_STRICT_BODY
    uint64_t bits = lqg_bits(x);
    int32_t exponent = -1023;
    double n, f, s, z, half_square;

    if (bits - 0x0010000000000000u >= 0x7fe0000000000000u) { /* not a normal number above 0 */
        if ((bits & 0x7fffffffffffffffu) == 0u)
            return lqg_of_bits(0xfff0000000000000u);
        if (bits == 0x7ff0000000000000u)
            return x;
        if (bits > 0x7ff0000000000000u)
            return lqg_of_bits(LQG_NAN);
        bits = lqg_bits(x * 4503599627370496.0); /* 2⁵² */
        exponent = -1075;
    }
    bits += 0x3ff0000000000000u - 0x3fe6a09e667f3bcdu; /* 1 − √½ */
    exponent += (int32_t)(bits >> 52);
    n = (double)exponent;
    f = lqg_of_bits((bits & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu) - 1.0;
    s = f / (2.0 + f);
    z = s * s;
    half_square = 0.5 * f * f;
    z = s * (half_square + z * lqg_log_polynomial(z)) - n * 1.7239444525614835e-13;
    return n * 0.6931471805601177 + (f + (z - half_square));
}

static inline double lqg_tanh(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;
    double t;

    if (a > 0x7ff0000000000000u)
        return lqg_of_bits(LQG_NAN);
    t = lqg_of_bits(a);
    if (a <= 0x3fe199999999999au) { /* 0.55 */
        const double z = t * t;
        t = t + t * (z * lqg_tanh_polynomial(z));
    } else if (a <= 0x4036000000000000u) { /* 22 */
        t = 1.0 - 2.0 / (lqg_exp_within(2.0 * t) + 1.0); /* e²ˣ */
    } else {
        t = 1.0;
    }
    return lqg_change_sign(t, bits);
}

LQG_STRICT_END
#endif

#endif
