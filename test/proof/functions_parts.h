/* SPDX-License-Identifier: MIT */
/* What intervals cannot follow of lqg/functions.h: any numbers within limits stand for it. README.md says how each is
 * shown. To be included before that header, of which restate_library.sh has renamed these functions. */
#ifndef PROOF_FUNCTIONS_PARTS_H
#define PROOF_FUNCTIONS_PARTS_H

#include <math.h>
#include <stdint.h>

#include "unknown.h"

extern volatile float any_float;
extern volatile double any_double;

static inline float any_float_within(float low, float high)
{
    const float number = any_float;
    if (!(number >= low && number <= high))
        stop();
    return number;
}

static inline float any_ratiof(void)
{
    return any_float_within(0, 1);
}

static inline float lqg_reducef(float a, float *rest, uint32_t *n)
{
    (void)a;
    *n = (uint32_t)any_int;
    *rest = any_float_within(-1e-7f, 1e-7f);
    return any_float_within(-0.7862f, 0.7862f);
}

static inline float lqg_exp_withinf(float x)
{
    (void)x;
    return any_float_within(0, (float)INFINITY);
}

static inline float lqg_sqrtf(float x)
{
    return x >= 0 && x <= 1 ? any_float_within(0, 1) : any_float;
}

static inline double any_double_within(double low, double high)
{
    const double number = any_double;
    if (!(number >= low && number <= high))
        stop();
    return number;
}

static inline double any_ratio(void)
{
    return any_double_within(0, 1);
}

static inline double lqg_reduce(double a, double *rest, uint32_t *n)
{
    (void)a;
    *n = (uint32_t)any_int;
    *rest = any_double_within(-1e-16, 1e-16);
    return any_double_within(-0.7855, 0.7855);
}

static inline double lqg_exp_within(double x)
{
    (void)x;
    return any_double_within(0, (double)INFINITY);
}

static inline double lqg_sqrt(double x)
{
    return x >= 0 && x <= 1 ? any_double_within(0, 1) : any_double;
}

#endif
