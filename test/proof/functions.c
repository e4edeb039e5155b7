/* SPDX-License-Identifier: MIT */
/* The elementary functions, of arguments of any bits: undefined behaviour; and with PARTS, restated by
 * restate_library.sh, the limits of their results, NaN apart. */
#include <math.h>

#include "unknown.h"
#ifdef PARTS
#include "functions_parts.h"
#endif
#include "lqg/functions.h"

volatile int any_int;
volatile float any_float;
volatile double any_double;

static void look_at_float(float result, float low, float high)
{
    if (result == result) {
        /*@ check float_within: low <= result <= high; */
    }
}

static void look_at_double(double result, double low, double high)
{
    if (result == result) {
        /*@ check double_within: low <= result <= high; */
    }
}

/* Results without limits, or, of sqrt, that of a part. */
static void call_others(void)
{
    (void)lqg_tanf(any_float);
    (void)lqg_sqrtf(any_float);
    (void)lqg_logf(any_float);
    (void)lqg_tan(any_double);
    (void)lqg_sqrt(any_double);
    (void)lqg_log(any_double);
}

#ifndef PARTS
#define look_at_float(result, low, high) (void)(result)
#define look_at_double(result, low, high) (void)(result)
#endif

static void call_float(void)
{
    const float half_pi = 1.57079637f, pi = 3.14159274f; /* rounded, as the results are */
    float sine, cosine;

    look_at_float(lqg_sinf(any_float), -1, 1);
    look_at_float(lqg_cosf(any_float), -1, 1);
    lqg_sin_cosf(any_float, &sine, &cosine);
    look_at_float(sine, -1, 1);
    look_at_float(cosine, -1, 1);
    look_at_float(lqg_asinf(any_float), -half_pi, half_pi);
    look_at_float(lqg_acosf(any_float), 0, pi);
    look_at_float(lqg_atanf(any_float), -half_pi, half_pi);
    look_at_float(lqg_atan2f(any_float, any_float), -pi, pi);
    look_at_float(lqg_expf(any_float), 0, INFINITY);
    look_at_float(lqg_tanhf(any_float), -1, 1);
    look_at_float(lqg_wrapf(any_float), -3.1415925f, 3.1415925f);
}

static void call_double(void)
{
    const double half_pi = 1.5707963267948966, pi = 3.1415926535897931;
    double sine, cosine;

    look_at_double(lqg_sin(any_double), -1, 1);
    look_at_double(lqg_cos(any_double), -1, 1);
    lqg_sin_cos(any_double, &sine, &cosine);
    look_at_double(sine, -1, 1);
    look_at_double(cosine, -1, 1);
    look_at_double(lqg_asin(any_double), -half_pi, half_pi);
    look_at_double(lqg_acos(any_double), 0, pi);
    look_at_double(lqg_atan(any_double), -1.5707963268, 1.5707963268); /* as far as intervals show it */
    look_at_double(lqg_atan2(any_double, any_double), -3.1415926536, 3.1415926536);
    look_at_double(lqg_exp(any_double), 0, (double)INFINITY);
    look_at_double(lqg_tanh(any_double), -1, 1);
    look_at_double(lqg_wrap(any_double), -pi, pi);
}

int main(void)
{
    call_float();
    call_double();
    call_others();
    return 0;
}
