/* SPDX-License-Identifier: MIT */
/* Whether the compiler turns a*b + c into one operation where nobody tells it not to. */
#ifndef TEST_CONTRACTED_H
#define TEST_CONTRACTED_H

#include "lqg/arithmetic.h"

/* (1 + ε)(1 − ε) − 1 is −ε² when it is rounded once, and 0 when the product is rounded to 1. */
static inline int is_contracted(void)
{
    const double e = sizeof(lqg_real) == sizeof(float) ? 0x1p-20 : 0x1p-50;
    volatile lqg_real a = (lqg_real)(1 + e), b = (lqg_real)(1 - e), c = -1;
    const lqg_real x = a, y = b, z = c;
    return x * y + z != 0;
}

#endif
