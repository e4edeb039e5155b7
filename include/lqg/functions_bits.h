/* SPDX-License-Identifier: MIT */
/* TinyLQG: the bits of numbers, and square roots. What they promise: lqg/functions.h. */
#ifndef LQG_FUNCTIONS_BITS_H
#define LQG_FUNCTIONS_BITS_H

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "lqg/arithmetic.h"

/* Functions of double are there where double has 64 bits. */
#if DBL_MANT_DIG == 53
#define LQG_HAS_DOUBLE 1
#else
#define LQG_HAS_DOUBLE 0
#endif

/* The instruction for a square root, where there is one: it rounds correctly, as IEEE 754 says. Not __builtin_sqrt(),
 * of which compilers make a call of libm, for errno. Frama-C gets the text without it, and who asks for that:
 * LQG_ROOT_BY_DIGITS. */
#if defined LQG_ROOT_BY_DIGITS || defined __FRAMAC__ || !defined __GNUC__
#elif defined __AVX__
#define LQG_ROOTF(root, x) __asm__("vsqrtss {%1, %1, %0|%0, %1, %1}" : "=x"(root) : "x"(x))
#define LQG_ROOT(root, x)  __asm__("vsqrtsd {%1, %1, %0|%0, %1, %1}" : "=x"(root) : "x"(x))
#elif defined __SSE2__
#define LQG_ROOTF(root, x) __asm__("sqrtss {%1, %0|%0, %1}" : "=x"(root) : "x"(x))
#define LQG_ROOT(root, x)  __asm__("sqrtsd {%1, %0|%0, %1}" : "=x"(root) : "x"(x))
#elif defined __aarch64__
#define LQG_ROOTF(root, x) __asm__("fsqrt %s0, %s1" : "=w"(root) : "w"(x))
#define LQG_ROOT(root, x)  __asm__("fsqrt %d0, %d1" : "=w"(root) : "w"(x))
#elif defined __ARM_FP
#if (__ARM_FP & 4) != 0
#define LQG_ROOTF(root, x) __asm__("vsqrt.f32 %0, %1" : "=t"(root) : "t"(x))
#endif
#if (__ARM_FP & 8) != 0
#define LQG_ROOT(root, x) __asm__("vsqrt.f64 %P0, %P1" : "=w"(root) : "w"(x))
#endif
#elif defined __riscv_flen && defined __riscv_fsqrt
#define LQG_ROOTF(root, x) __asm__("fsqrt.s %0, %1" : "=f"(root) : "f"(x))
#if __riscv_flen >= 64
#define LQG_ROOT(root, x) __asm__("fsqrt.d %0, %1" : "=f"(root) : "f"(x))
#endif
#endif

/* The bits of every NaN that is returned. */
#define LQG_NANF 0x7fc00000u
#define LQG_NAN  0x7ff8000000000000u

LQG_STRICT_BEGIN

static inline uint32_t lqg_bitsf(float x)
{
    uint32_t bits;
    (void)memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float lqg_of_bitsf(uint32_t bits)
{
    float x;
    (void)memcpy(&x, &bits, sizeof x);
    return x;
}

/* x with the other sign where the highest bit of `sign` is set. */
static inline float lqg_change_signf(float x, uint32_t sign)
{
    return lqg_of_bitsf(lqg_bitsf(x) ^ (sign & 0x80000000u));
}

#ifndef LQG_ROOTF
/* The bits of √x for those of a normal x > 0, digit by digit: one more than float has, then rounded. No √x lies in the
 * middle between two floats. `root` is twice the root that is found, `part` its next digit. */
static inline uint32_t lqg_root_bitsf(uint32_t bits)
{
    uint32_t rest = ((bits & 0x007fffffu) | 0x00800000u) << (bits & 0x00800000u ? 1u : 2u);
    uint32_t root = 0u, part = 0x01000000u;

    for (unsigned digit = 0u; digit < 25u; digit++) {
        const uint32_t tried = root + part;
        if (tried <= rest) {
            rest -= tried;
            root = tried + part;
        }
        rest <<= 1;
        part >>= 1;
    }
    return (((bits >> 23) + 125u) >> 1 << 23) + (((root >> 1) + 1u) >> 1);
}
#endif

/* √x, rounded correctly. */
static inline float lqg_sqrtf(float x)
{
    LQG_STRICT_BODY
    const uint32_t bits = lqg_bitsf(x);

    if (bits > 0x80000000u || (bits & 0x7fffffffu) > 0x7f800000u)
        return lqg_of_bitsf(LQG_NANF);
#ifdef LQG_ROOTF
    LQG_ROOTF(x, x);
    return x;
#else
    if ((bits & 0x7fffffffu) == 0u || bits == 0x7f800000u)
        return x;
    if (bits < 0x00800000u) /* x 2²⁴ is normal */
        return lqg_of_bitsf(lqg_root_bitsf(lqg_bitsf(x * 16777216.0f))) * (1.0f / 4096.0f);
    return lqg_of_bitsf(lqg_root_bitsf(bits));
#endif
}

#if LQG_HAS_DOUBLE
static inline uint64_t lqg_bits(double x)
{
    uint64_t bits;
    (void)memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double lqg_of_bits(uint64_t bits)
{
    double x;
    (void)memcpy(&x, &bits, sizeof x);
    return x;
}

static inline double lqg_change_sign(double x, uint64_t sign)
{
    return lqg_of_bits(lqg_bits(x) ^ (sign & 0x8000000000000000u));
}

#ifndef LQG_ROOT
/* As lqg_root_bitsf. */
static inline uint64_t lqg_root_bits(uint64_t bits)
{
    uint64_t rest = ((bits & 0x000fffffffffffffu) | 0x0010000000000000u) << (bits & 0x0010000000000000u ? 1u : 2u);
    uint64_t root = 0u, part = 0x0020000000000000u;

    for (unsigned digit = 0u; digit < 54u; digit++) {
        const uint64_t tried = root + part;
        if (tried <= rest) {
            rest -= tried;
            root = tried + part;
        }
        rest <<= 1;
        part >>= 1;
    }
    return (((bits >> 52) + 1021u) >> 1 << 52) + (((root >> 1) + 1u) >> 1);
}
#endif

static inline double lqg_sqrt(double x)
{
    LQG_STRICT_BODY
    const uint64_t bits = lqg_bits(x), a = bits & 0x7fffffffffffffffu;

    if (bits > 0x8000000000000000u || a > 0x7ff0000000000000u)
        return lqg_of_bits(LQG_NAN);
#ifdef LQG_ROOT
    LQG_ROOT(x, x);
    return x;
#else
    if (a == 0u || bits == 0x7ff0000000000000u)
        return x;
    if (bits < 0x0010000000000000u) /* x 2⁵⁴ is normal */
        return lqg_of_bits(lqg_root_bits(lqg_bits(x * 18014398509481984.0))) * (1.0 / 134217728.0);
    return lqg_of_bits(lqg_root_bits(bits));
#endif
}
#endif

LQG_STRICT_END

#endif
