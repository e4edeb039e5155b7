/* SPDX-License-Identifier: MIT */
/* The few operations of which everything is made. Their order is part of the contract: sums run in ascending
 * index in one accumulator, so that another text of the same algorithm finds the same bits. */
#ifndef LQG_KERNEL_H
#define LQG_KERNEL_H

#include <stddef.h>

#include "lqg/arithmetic.h"

#include <math.h>

/* What callers MUST do, for those who develop: see lqg/lqg.h. */
#ifndef LQG_ASSERT
#define LQG_ASSERT(condition) ((void)0)
#endif

#define lqg_begin LQG_VARIANT(lqg_begin)

/* to ← from, or ← 0 where there is no from; nothing where there is no to. */
void lqg_begin(lqg_real to[], const lqg_real from[], unsigned length);

LQG_STRICT_BEGIN

/* a b + c */
static inline lqg_real multiply_add(lqg_real a, lqg_real b, lqg_real c)
{
    LQG_STRICT_BODY
#if defined LQG_FUSED && defined LQG_REAL_DOUBLE
    return fma(a, b, c);
#elif defined LQG_FUSED
    return fmaf(a, b, c);
#else
    return a * b + c;
#endif
}

/* c − a b */
static inline lqg_real multiply_subtract(lqg_real a, lqg_real b, lqg_real c)
{
    LQG_STRICT_BODY
#if defined LQG_FUSED && defined LQG_REAL_DOUBLE
    return fma(-a, b, c);
#elif defined LQG_FUSED
    return fmaf(-a, b, c);
#else
    return c - a * b;
#endif
}

/* Neither NaN nor infinite. */
static inline int is_finite(lqg_real a)
{
    LQG_STRICT_BODY
    return a - a == 0;
}

static inline lqg_real absolute(lqg_real a)
{
#ifdef LQG_REAL_DOUBLE
    return fabs(a);
#else
    return fabsf(a);
#endif
}

/* |a| is below limits_i; where there are no limits, a is finite. */
static inline int is_plausible(lqg_real a, const lqg_real limits[], unsigned i)
{
    return limits ? absolute(a) < limits[i] : is_finite(a);
}

/* sum + Σ_j M_ij v_j for row i of M; M is not looked at when it has no columns. */
static inline lqg_real add_row_product(lqg_real sum, const lqg_real M[], unsigned i, unsigned columns,
                                       const lqg_real v[])
{
    LQG_STRICT_BODY
    for (unsigned j = 0; j < columns; j++)
        sum = multiply_add(M[i * columns + j], v[j], sum);
    return sum;
}

/* sum − Σ_j M_ij v_j for row i of M; M is not looked at when it has no columns. */
static inline lqg_real subtract_row_product(lqg_real sum, const lqg_real M[], unsigned i, unsigned columns,
                                            const lqg_real v[])
{
    LQG_STRICT_BODY
    for (unsigned j = 0; j < columns; j++)
        sum = multiply_subtract(M[i * columns + j], v[j], sum);
    return sum;
}

/* sum + Σ values: finite if and only if all of them are, short of an overflow that no honest state comes
 * near. */
static inline lqg_real add_all(lqg_real sum, const lqg_real values[], unsigned length)
{
    LQG_STRICT_BODY
    for (unsigned i = 0; i < length; i++)
        sum += values[i];
    return sum;
}

/* to ← from; they may be the same. */
static inline void copy(lqg_real to[], const lqg_real from[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        to[i] = from[i];
}

LQG_STRICT_END

#endif
