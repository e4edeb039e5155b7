/* SPDX-License-Identifier: MIT */
/* The largest error of each float function of lqg/functions.h, in units in the last place of the result, beside libm's
 * function of double, whose own error is some 10⁻⁹ of such a unit.
 *
 *   float_errors [<stride> [<function>]]    every stride-th of all 2³² floats; 1: all; default 4099
 *   float_errors list                       the names of the functions
 *
 * Prints function, error, and argument of the largest; status 1: an error is above 2, or above ½ for sqrt; a NaN or an
 * infinity is not where it should be; f(−x) is not ±f(x); or a result is beyond its limits. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lqg/functions.h"

enum { ODD, EVEN, NEITHER };

typedef struct {
    const char *name;
    float (*found)(float);
    double (*expected)(double);
    float limit; /* beyond: NaN */
    int symmetry;
    double error;          /* largest allowed */
    float lowest, highest; /* result, as test/proof says */
} function_t;

static float sine_of_both(float x)
{
    float s, c;
    lqg_sin_cosf(x, &s, &c);
    return s;
}

static float cosine_of_both(float x)
{
    float s, c;
    lqg_sin_cosf(x, &s, &c);
    return c;
}

/* A partner of y in atan2: any bits, a function of |y|. */
static float partner(float y)
{
    return lqg_of_bitsf(lqg_bitsf(fabsf(y)) * 2654435761u);
}

static float any_angle(float y)
{
    return lqg_atan2f(y, partner(y));
}
static double any_angle_expected(double y)
{
    return atan2(y, (double)partner((float)y));
}
static float steep_angle(float x)
{
    return lqg_atan2f(x, -1.0f);
}
static double steep_angle_expected(double x)
{
    return atan2(x, -1.0);
}
static float flat_angle(float x)
{
    return lqg_atan2f(3.0f, x);
}
static double flat_angle_expected(double x)
{
    return atan2(3.0, x);
}

static double wrapped(double x)
{
    const double two_pi = 6.283185307179586476925286766559, rest = 2.4492935982947064e-16;
    const double turns = floor(x / two_pi + 0.5);
    return fma(-turns, two_pi, x) - turns * rest;
}

/* What the proofs take for granted of the reduction: 1 where it is so. */
static float reduction(float x)
{
    uint32_t n;
    float rest, r;

    if (!(fabsf(x) <= LQG_ANGLE_MAXF))
        return NAN;
    r = lqg_reducef(fabsf(x), &rest, &n);
    return fabsf(r) <= 0.7862f && fabsf(rest) <= 1e-7f ? 1 : 0;
}

static double one(double x)
{
    return (void)x, 1;
}

static const function_t functions[] = {
    {"reduction", reduction, one, LQG_ANGLE_MAXF, EVEN, 0, 1, 1},
    {"sin", lqg_sinf, sin, LQG_ANGLE_MAXF, ODD, 2, -1, 1},
    {"cos", lqg_cosf, cos, LQG_ANGLE_MAXF, EVEN, 2, -1, 1},
    {"sin_of_both", sine_of_both, sin, LQG_ANGLE_MAXF, ODD, 2, -1, 1},
    {"cos_of_both", cosine_of_both, cos, LQG_ANGLE_MAXF, EVEN, 2, -1, 1},
    {"tan", lqg_tanf, tan, LQG_ANGLE_MAXF, ODD, 2, -INFINITY, INFINITY},
    {"asin", lqg_asinf, asin, 1, ODD, 2, -1.57079637f, 1.57079637f},
    {"acos", lqg_acosf, acos, 1, NEITHER, 2, 0, 3.14159274f},
    {"atan", lqg_atanf, atan, INFINITY, ODD, 2, -1.57079637f, 1.57079637f},
    {"steep_atan2", steep_angle, steep_angle_expected, INFINITY, ODD, 2, -3.14159274f, 3.14159274f},
    {"flat_atan2", flat_angle, flat_angle_expected, INFINITY, NEITHER, 2, 0, 3.14159274f},
    {"any_atan2", any_angle, any_angle_expected, INFINITY, ODD, 2, -3.14159274f, 3.14159274f},
    {"sqrt", lqg_sqrtf, sqrt, INFINITY, NEITHER, 0.5, 0, INFINITY},
    {"exp", lqg_expf, exp, INFINITY, NEITHER, 2, 0, INFINITY},
    {"log", lqg_logf, log, INFINITY, NEITHER, 2, -INFINITY, INFINITY},
    {"tanh", lqg_tanhf, tanh, INFINITY, ODD, 2, -1, 1},
    {"wrap", lqg_wrapf, wrapped, LQG_ANGLE_MAXF, ODD, 2, -3.1415925f, 3.1415925f},
};

static double unit_of(double value)
{
    const int exponent = value == 0 ? -126 : ilogb(value);
    return ldexp(1, (exponent < -126 ? -126 : exponent) - 23);
}

/* In units in the last place; infinite where there should be a NaN or an infinity, or should not. */
static double error_of(const function_t *f, float x, float found)
{
    const double expected = fabsf(x) <= f->limit ? f->expected((double)x) : (double)NAN;

    if (expected != expected)
        return found != found ? 0 : (double)INFINITY;
    if (isinf((float)expected))
        return found == (float)expected ? 0 : (double)INFINITY;
    if (found - found != 0)
        return (double)INFINITY;
    return fabs((double)found - expected) / unit_of(expected);
}

static int is_within(const function_t *f, float found)
{
    return found != found || (found >= f->lowest && found <= f->highest);
}

static int is_symmetric(const function_t *f, float x, float found)
{
    const float mirrored = f->found(-x), expected = f->symmetry == ODD ? -found : found;

    if (f->symmetry == NEITHER)
        return 1;
    return found == found ? memcmp(&mirrored, &expected, sizeof mirrored) == 0 : mirrored != mirrored;
}

static int look_at(const function_t *f, unsigned long stride)
{
    const unsigned long long end = f->symmetry == NEITHER ? 4294967296ull : 2147483648ull; /* the others mirrored */
    double largest = 0;
    float where = 0;

    for (unsigned long long bits = 0; bits < end; bits += stride) {
        const float x = lqg_of_bitsf((uint32_t)bits), found = f->found(x);
        const int is_right = is_symmetric(f, x, found) && is_within(f, found);
        const double error = is_right ? error_of(f, x, found) : (double)INFINITY;
        if (error > largest) {
            largest = error;
            where = x;
        }
    }
    printf("%-13s %.3f at %.9g\n", f->name, largest, (double)where);
    return largest <= f->error;
}

static void list(void)
{
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        puts(functions[i].name);
}

int main(int count, char **arguments)
{
    const unsigned long stride = count > 1 ? strtoul(arguments[1], NULL, 10) : 4099;
    int are_right = 1;

    if (count > 1 && strcmp(arguments[1], "list") == 0) {
        list();
        return 0;
    }
    if (stride == 0)
        return 2;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (count < 3 || strcmp(arguments[2], functions[i].name) == 0)
            are_right &= look_at(&functions[i], stride);
    return !are_right;
}
