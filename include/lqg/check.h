/* SPDX-License-Identifier: MIT */
/* TinyLQG: whether this compiler, with the options that it is given here, computes as lqg/arithmetic.h says.
 *
 * That header refuses or overrules most options that would change a bit or let a NaN pass. A few of clang's it can
 * neither see nor wholly overrule: -ffp-contract=fast; -fno-honor-nans and its like, on 32-bit Arm for all operations,
 * elsewhere for ?: and the unary minus. Others act when the program is linked: on x86 -ffast-math there makes denormal
 * numbers 0. lqg_add_controller (CMake) looks for them by itself. Who builds otherwise compiles and links this with the
 * options of the firmware, and runs it, on the target where that is possible:
 *
 *     #include <stdio.h>
 *
 *     #include "lqg/check.h"
 *
 *     int main(void)
 *     {
 *         const char *wrong = lqg_arithmetic_check();
 *         if (wrong)
 *             puts(wrong);
 *         return wrong != NULL;
 *     }
 *
 * Where it is only compiled, it is refused from -O1 on if the optimizer forgets NaNs. The rest is to be seen in what
 * clang makes of it: the same two files, or the options are not for TinyLQG.
 *
 *     clang <options> -g0 -S check.c -o given.s
 *     clang <options> -g0 -S -ffp-contract=off -fno-fast-math check.c -o strict.s */
#ifndef LQG_CHECK_H
#define LQG_CHECK_H

#include <float.h>
#include <stddef.h>
#include <string.h>

#include "lqg/arithmetic.h"

#define LQG_CHECK_NAN \
    "TinyLQG: the compiler forgets NaNs. Leave out -ffast-math, -ffinite-math-only, -fno-honor-nans, " \
    "-fno-honor-infinities."
#define LQG_CHECK_CONTRACTION \
    "TinyLQG: a*b + c is rounded once. Leave out -ffp-contract=fast, or end with -ffp-contract=off."
#define LQG_CHECK_ORDER \
    "TinyLQG: operations are not done as they are written. Leave out -ffast-math, -funsafe-math-optimizations, -Ofast."
#define LQG_CHECK_ZERO "TinyLQG: zeros lose their sign. Leave out -fno-signed-zeros."
#define LQG_CHECK_DENORMAL \
    "TinyLQG: small numbers become 0. Leave out -ffast-math, -funsafe-math-optimizations, -Ofast " \
    "and -mdaz-ftz, at the linker, too."
#define LQG_CHECK_ROUNDING \
    "TinyLQG: numbers are not rounded to nearest, once. Leave the rounding mode and precision as they are."

/* Called where the optimizer takes x != x for false. There is no such function. */
#if defined __has_attribute
#if __has_attribute(error)
#ifdef __cplusplus
extern "C"
#endif
__attribute__((error(LQG_CHECK_NAN))) void lqg_check_forgets_nans(void);
#define LQG_CHECK_AT_COMPILE_TIME(x) \
    if (__builtin_constant_p((x) != (x))) \
        lqg_check_forgets_nans();
#endif
#endif
#ifndef LQG_CHECK_AT_COMPILE_TIME
#define LQG_CHECK_AT_COMPILE_TIME(x)
#endif

/* Of each row: its name; an expression; the values of a, b and c, which the compiler does not know (chosen is
 * c > b ? a : b); what comes out, to the bit, when all is rounded once, to nearest, as it is written; and what to say
 * if it does not. Of the parameters: 1 − e² is rounded to 1; epsilon is the distance from 1 to the next number. */
#define LQG_CHECK_ROWS(ROW, real, e, epsilon, max, min) \
    ROW(real, nan_is_not_finite, a - a == 0 ? 1 : 2, nan, 0, 0, 2, LQG_CHECK_NAN) \
    ROW(real, infinity_is_not_finite, a - a == 0 ? 1 : 2, infinity, 0, 0, 2, LQG_CHECK_NAN) \
    ROW(real, nan_is_not_below, a < b ? 1 : 2, nan, 1, 0, 2, LQG_CHECK_NAN) \
    ROW(real, nan_is_not_below_negated, !(a < b) ? 1 : 2, nan, 1, 0, 1, LQG_CHECK_NAN) \
    ROW(real, nan_is_not_above, a > b ? 1 : 2, nan, 1, 0, 2, LQG_CHECK_NAN) \
    ROW(real, nan_is_not_above_negated, !(a > b) ? 1 : 2, nan, 1, 0, 1, LQG_CHECK_NAN) \
    ROW(real, nan_is_not_itself, a != a ? 1 : 2, nan, 0, 0, 1, LQG_CHECK_NAN) \
    ROW(real, nan_times_zero, a * 0 == 0 ? 1 : 2, nan, 0, 0, 2, LQG_CHECK_NAN) \
    ROW(real, clipped_above, a > c ? c : a < b ? b : a, infinity, -1, 1, 1, LQG_CHECK_NAN) \
    ROW(real, clipped_below, a > c ? c : a < b ? b : a, -infinity, -1, 1, -1, LQG_CHECK_NAN) \
    ROW(real, overflow, a * b - a * b == 0 ? 1 : 2, max, 2, 0, 2, LQG_CHECK_NAN) \
    ROW(real, nan_is_chosen, chosen != chosen ? 1 : 2, nan, 0, 1, 1, LQG_CHECK_NAN) \
    ROW(real, infinity_is_chosen, chosen > max ? 1 : 2, infinity, 0, 1, 1, LQG_CHECK_NAN) \
    ROW(real, nan_is_negated, -a != -a ? 1 : 2, nan, 0, 0, 1, LQG_CHECK_NAN) \
    ROW(real, infinity_is_negated, -a < -max ? 1 : 2, infinity, 0, 0, 1, LQG_CHECK_NAN) \
    ROW(real, sum_contracted, a * b + c, 1 + e, 1 - e, -1, 0, LQG_CHECK_CONTRACTION) \
    ROW(real, difference_contracted, a * b - c, 1 + e, 1 - e, 1, 0, LQG_CHECK_CONTRACTION) \
    ROW(real, subtraction_contracted, c - a * b, 1 + e, 1 - e, 1, 0, LQG_CHECK_CONTRACTION) \
    ROW(real, sum_reordered, a + b - a, 1, epsilon / 4, 0, 0, LQG_CHECK_ORDER) \
    ROW(real, product_reordered, a * 4 * (real)0.25 == a ? 1 : 2, max, 0, 0, 2, LQG_CHECK_ORDER) \
    ROW(real, product_distributed, a * c + b * c == 0 ? 1 : 2, max, -max, 2, 2, LQG_CHECK_ORDER) \
    ROW(real, quotient_cancelled, a * b / b == a ? 1 : 2, max, 2, 0, 2, LQG_CHECK_ORDER) \
    ROW(real, reciprocal_of_constant, a / 3 - b, 5, (real)5 / 3, 0, 0, LQG_CHECK_ORDER) \
    ROW(real, reciprocal_of_variable, a / c - b / c - b / c - (real)5 / 3, 5, 0, 3, 0, LQG_CHECK_ORDER) \
    ROW(real, negated_product_reordered, -(-(a * 4) * (real)0.25) == a ? 1 : 2, max, 0, 0, 2, LQG_CHECK_ORDER) \
    ROW(real, negated_product_distributed, -(-(a * b) * c) == a ? 1 : 2, max, 4, (real)0.25, 2, LQG_CHECK_ORDER) \
    ROW(real, negated_sum_reordered, -(-(a + b) - a), 1, epsilon / 4, 0, 2, LQG_CHECK_ORDER) \
    ROW(real, reciprocal_negated, -(a / 3), 5, 0, 0, -((real)5 / 3), LQG_CHECK_ORDER) \
    ROW(real, zero_negated, -(a - b), 1, 1, 0, -(real)0, LQG_CHECK_ZERO) \
    ROW(real, zero_chosen, chosen + 0, -(real)0, 0, 1, 0, LQG_CHECK_ZERO) \
    ROW(real, zero_added, a + 0, -(real)0, 0, 0, 0, LQG_CHECK_ZERO) \
    ROW(real, zero_subtracted_from, 0 - a, 0, 0, 0, 0, LQG_CHECK_ZERO) \
    ROW(real, zero_selected, a < b ? a : b, 0, -(real)0, 0, -(real)0, LQG_CHECK_ZERO) \
    ROW(real, denormal, a * (real)0.5 * b, min, 2, 0, min, LQG_CHECK_DENORMAL) \
    ROW(real, difference_of_normals, (a - b) * c, min * (real)1.5, min, 2, min, LQG_CHECK_DENORMAL) \
    ROW(real, rounded_up, a + b, 1, epsilon * (real)0.75, 0, 1 + epsilon, LQG_CHECK_ROUNDING) \
    ROW(real, rounded_down, a + b, 1, epsilon * (real)0.25, 0, 1, LQG_CHECK_ROUNDING) \
    ROW(real, negative_rounded_up, a + b, -1, epsilon * (real)-0.75, 0, -1 - epsilon, LQG_CHECK_ROUNDING) \
    ROW(real, negative_rounded_down, a + b, -1, epsilon * (real)-0.25, 0, -1, LQG_CHECK_ROUNDING)

/* One function a row: 1 where it is right. */
#define LQG_CHECK_FUNCTION(real, name, expression, a_value, b_value, c_value, result, message) \
    static inline int lqg_check_##real##_##name(void) \
    { \
        LQG_STRICT_BODY \
        volatile real zero = 0; \
        const real infinity = 1 / zero, nan = infinity - infinity; \
        volatile real a_given = a_value, b_given = b_value, c_given = c_value; \
        const real a = a_given, b = b_given, c = c_given, chosen = c > b ? a : b; \
        const real found = expression, expected = result; \
        LQG_CHECK_AT_COMPILE_TIME(a) \
        LQG_CHECK_AT_COMPILE_TIME(chosen) \
        (void)nan; \
        return memcmp(&found, &expected, sizeof found) == 0; \
    }

/* A sum in a loop, and sums beside differences: what a vectorizer likes. */
#define LQG_CHECK_LOOPS(real, e, epsilon) \
    static inline int lqg_check_##real##_sum_in_a_loop(void) \
    { \
        LQG_STRICT_BODY \
        volatile real one = 1, little = epsilon / 4; \
        volatile int count = 16; \
        const int n = count; \
        real terms[16], sum = one; \
        const real expected = 1; \
        for (int i = 0; i < n; i++) \
            terms[i] = little; \
        for (int i = 0; i < n; i++) \
            sum += terms[i]; \
        return memcmp(&sum, &expected, sizeof sum) == 0; \
    } \
    static inline int lqg_check_##real##_sums_beside_differences(void) \
    { \
        LQG_STRICT_BODY \
        volatile real above = 1 + e, below = 1 - e, minus = -1, plus = 1; \
        real a[8], b[8], c[8], out[8]; \
        static const real expected[8] = {0, 0, 0, 0, 0, 0, 0, 0}; \
        for (int i = 0; i < 8; i++) \
            a[i] = above, b[i] = below, c[i] = i % 2 ? plus : minus; \
        for (int i = 0; i < 8; i += 2) { \
            out[i] = a[i] * b[i] + c[i]; \
            out[i + 1] = a[i + 1] * b[i + 1] - c[i + 1]; \
        } \
        return memcmp(out, expected, sizeof out) == 0; \
    }

#define LQG_CHECK_ROW(real, name, expression, a_value, b_value, c_value, result, message) \
    if (!lqg_check_##real##_##name()) \
        return message;

#define LQG_CHECK_REAL(real, e, epsilon, max, min) \
    LQG_CHECK_ROWS(LQG_CHECK_FUNCTION, real, e, epsilon, max, min) \
    LQG_CHECK_LOOPS(real, e, epsilon) \
    static inline const char *lqg_check_##real(void) \
    { \
        LQG_CHECK_ROWS(LQG_CHECK_ROW, real, e, epsilon, max, min) \
        if (!lqg_check_##real##_sum_in_a_loop()) \
            return LQG_CHECK_ORDER; \
        if (!lqg_check_##real##_sums_beside_differences()) \
            return LQG_CHECK_CONTRACTION; \
        return NULL; \
    }

LQG_STRICT_BEGIN
LQG_CHECK_REAL(float, (float)(1 / 8192.0), FLT_EPSILON, FLT_MAX, FLT_MIN)
#if DBL_MANT_DIG == 53
LQG_CHECK_REAL(double, 1 / 268435456.0, DBL_EPSILON, DBL_MAX, DBL_MIN)
#endif

/* NULL if all is well, else what is wrong, and what to do about it. */
static inline const char *lqg_arithmetic_check(void)
{
    const char *wrong = lqg_check_float();

#if DBL_MANT_DIG == 53
    if (!wrong)
        wrong = lqg_check_double();
    if (!wrong && sizeof(1.0) != sizeof(double))
        wrong = "TinyLQG: constants are float. Leave out -fsingle-precision-constant.";
#endif
    return wrong;
}
LQG_STRICT_END

#endif
