/* SPDX-License-Identifier: MIT */
/* The largest error of each double function of lqg/functions.h among many arguments, in units in the last place of the
 * result, beside GNU MPFR with 160 bits.
 *
 *   double_errors [<arguments of each kind> [<function>]]    default 20000
 *   double_errors list                                       the names of the functions
 *
 * Kinds of arguments: any bits; uniform in the range where the function is not trivial; next to multiples of π/2; next
 * to ±1; next to the ends of a range, to 0, and to numbers at which a text begins to compute otherwise.
 *
 * Prints function, error, and argument of the largest; status 1: an error is above 2, or above ½ for sqrt; a NaN or an
 * infinity is not where it should be; f(−x) is not ±f(x); or a result is beyond its limits. */
#include <math.h>
#include <mpfr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lqg/functions.h"

enum { ODD, EVEN, NEITHER, BITS = 160 };

typedef struct {
    const char *name;
    double (*found)(double);
    int (*expected)(mpfr_t, const mpfr_t, mpfr_rnd_t);
    double range; /* of the uniform arguments: −range … range */
    double limit; /* beyond: NaN */
    int symmetry;
    double error;           /* largest allowed */
    double lowest, highest; /* result, as test/proof says */
} function_t;

static double sine_of_both(double x)
{
    double s, c;
    lqg_sin_cos(x, &s, &c);
    return s;
}

static double cosine_of_both(double x)
{
    double s, c;
    lqg_sin_cos(x, &s, &c);
    return c;
}

/* A partner of y in atan2: any bits, a function of |y|. */
static double partner(double y)
{
    return lqg_of_bits(lqg_bits(fabs(y)) * 11400714819323198485u);
}

static double any_angle(double y)
{
    return lqg_atan2(y, partner(y));
}

static int any_angle_expected(mpfr_t angle, const mpfr_t y, mpfr_rnd_t rounding)
{
    int inexact;
    mpfr_t x;
    mpfr_init2(x, BITS);
    mpfr_set_d(x, partner(mpfr_get_d(y, rounding)), rounding);
    inexact = mpfr_atan2(angle, y, x, rounding);
    mpfr_clear(x);
    return inexact;
}

static double steep_angle(double x)
{
    return lqg_atan2(x, -1.0);
}
static double flat_angle(double x)
{
    return lqg_atan2(3.0, x);
}

static int steep_angle_expected(mpfr_t angle, const mpfr_t y, mpfr_rnd_t rounding)
{
    int inexact;
    mpfr_t x;
    mpfr_init2(x, BITS);
    mpfr_set_si(x, -1, rounding);
    inexact = mpfr_atan2(angle, y, x, rounding);
    mpfr_clear(x);
    return inexact;
}

static int flat_angle_expected(mpfr_t angle, const mpfr_t x, mpfr_rnd_t rounding)
{
    int inexact;
    mpfr_t y;
    mpfr_init2(y, BITS);
    mpfr_set_si(y, 3, rounding);
    inexact = mpfr_atan2(angle, y, x, rounding);
    mpfr_clear(y);
    return inexact;
}

static int wrapped(mpfr_t angle, const mpfr_t x, mpfr_rnd_t rounding)
{
    mpfr_t turn;
    mpfr_init2(turn, BITS);
    mpfr_const_pi(turn, rounding);
    mpfr_mul_2ui(turn, turn, 1, rounding);
    mpfr_remainder(angle, x, turn, rounding);
    mpfr_clear(turn);
    return 1;
}

/* What the proofs take for granted of the reduction: 1 where it is so. */
static double reduction(double x)
{
    uint32_t n;
    double rest, r;

    if (!(fabs(x) <= LQG_ANGLE_MAX))
        return (double)NAN;
    r = lqg_reduce(fabs(x), &rest, &n);
    return fabs(r) <= 0.7855 && fabs(rest) <= 1e-16 ? 1 : 0;
}

static int one(mpfr_t result, const mpfr_t x, mpfr_rnd_t rounding)
{
    (void)x;
    return mpfr_set_si(result, 1, rounding);
}

static const function_t functions[] = {
    {"reduction", reduction, one, LQG_ANGLE_MAX, LQG_ANGLE_MAX, EVEN, 0, 1, 1},
    {"sin", lqg_sin, mpfr_sin, LQG_ANGLE_MAX, LQG_ANGLE_MAX, ODD, 2, -1, 1},
    {"cos", lqg_cos, mpfr_cos, LQG_ANGLE_MAX, LQG_ANGLE_MAX, EVEN, 2, -1, 1},
    {"sin_of_both", sine_of_both, mpfr_sin, 10, LQG_ANGLE_MAX, ODD, 2, -1, 1},
    {"cos_of_both", cosine_of_both, mpfr_cos, 10, LQG_ANGLE_MAX, EVEN, 2, -1, 1},
    {"tan", lqg_tan, mpfr_tan, 10, LQG_ANGLE_MAX, ODD, 2, -(double)INFINITY, (double)INFINITY},
    {"asin", lqg_asin, mpfr_asin, 1, 1, ODD, 2, -1.5707963267948966, 1.5707963267948966},
    {"acos", lqg_acos, mpfr_acos, 1, 1, NEITHER, 2, 0, 3.1415926535897931},
    {"atan", lqg_atan, mpfr_atan, 3, (double)INFINITY, ODD, 2, -1.5707963267948966, 1.5707963267948966},
    {"steep_atan2", steep_angle, steep_angle_expected, 3, (double)INFINITY, ODD, 2, -3.1415926535897931,
     3.1415926535897931},
    {"flat_atan2", flat_angle, flat_angle_expected, 9, (double)INFINITY, NEITHER, 2, 0, 3.1415926535897931},
    {"any_atan2", any_angle, any_angle_expected, 3, (double)INFINITY, ODD, 2, -3.1415926535897931, 3.1415926535897931},
    {"sqrt", lqg_sqrt, mpfr_sqrt, 4, (double)INFINITY, NEITHER, 0.5, 0, (double)INFINITY},
    {"exp", lqg_exp, mpfr_exp, 750, (double)INFINITY, NEITHER, 2, 0, (double)INFINITY},
    {"log", lqg_log, mpfr_log, 4, (double)INFINITY, NEITHER, 2, -(double)INFINITY, (double)INFINITY},
    {"tanh", lqg_tanh, mpfr_tanh, 3, (double)INFINITY, ODD, 2, -1, 1},
    {"wrap", lqg_wrap, wrapped, 100, LQG_ANGLE_MAX, ODD, 2, -3.1415926535897931, 3.1415926535897931},
};

/* Where a text begins to compute otherwise, and where functions end. */
static const double special[] = {0,
                                 DBL_MIN,
                                 DBL_MAX,
                                 (double)INFINITY,
                                 0.375,
                                 0.55,
                                 0.5625,
                                 0.6875,
                                 0.7071067811865476,
                                 1,
                                 1.414213562373095,
                                 22,
                                 709.8,
                                 709.782712893384,
                                 -745.1332191019412,
                                 -746,
                                 0.7853981633974483,
                                 LQG_ANGLE_MAX,
                                 3.141592653589793};

static uint64_t random_bits(void)
{
    static uint64_t state = 1;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

/* Of [−1, 1). */
static double random_number(void)
{
    return (double)(int64_t)random_bits() / 9223372036854775808.0;
}

static double neighbour(double x)
{
    return lqg_of_bits(lqg_bits(x) + random_bits() % 64u - 32u);
}

static double argument(const function_t *f, unsigned kind)
{
    switch (kind) {
        case 0:
            return lqg_of_bits(random_bits());
        case 1:
            return f->range * random_number();
        case 2:
            return 3 * random_number();
        case 3: /* the double next to a multiple of π/2, and its neighbours */
            return lqg_of_bits(lqg_bits(rint(random_number() * 667544) * 1.5707963267948966) + random_bits() % 3u - 1u);
        case 4:
            return neighbour(rint(random_number() * 20) * 1.5707963267948966);
        case 5: /* at any distance from ±1 */
            return copysign(1 + ldexp(random_number(), -(int)(random_bits() % 54u)), random_number());
        default:
            return copysign(neighbour(special[random_bits() % (sizeof special / sizeof *special)]), random_number());
    }
}

/* In units in the last place; infinite where there should be a NaN or an infinity, or should not. */
static double error_of(const function_t *f, double x, double found, mpfr_t expected, mpfr_t argument_of_f)
{
    double error, rounded;

    if (!(fabs(x) <= f->limit))
        return found != found ? 0 : (double)INFINITY;
    mpfr_set_d(argument_of_f, x, MPFR_RNDN);
    f->expected(expected, argument_of_f, MPFR_RNDN);
    rounded = mpfr_get_d(expected, MPFR_RNDN);
    if (rounded != rounded)
        return found != found ? 0 : (double)INFINITY;
    if (isinf(rounded))
        return found == rounded ? 0 : (double)INFINITY;
    if (found - found != 0)
        return (double)INFINITY;
    if (mpfr_zero_p(expected))
        return found == 0 ? 0 : (double)INFINITY;
    rounded = (double)(mpfr_get_exp(expected) - 1);
    mpfr_sub_d(expected, expected, found, MPFR_RNDN);
    error = mpfr_get_d(expected, MPFR_RNDN);
    return ldexp(fabs(error), 52 - (int)(rounded < -1022 ? -1022 : rounded));
}

static int is_within(const function_t *f, double found)
{
    return found != found || (found >= f->lowest && found <= f->highest);
}

static int is_symmetric(const function_t *f, double x, double found)
{
    const double mirrored = f->found(-x), expected = f->symmetry == ODD ? -found : found;

    if (f->symmetry == NEITHER)
        return 1;
    return found == found ? memcmp(&mirrored, &expected, sizeof mirrored) == 0 : mirrored != mirrored;
}

static int look_at(const function_t *f, unsigned long arguments)
{
    double largest = 0, where = 0;
    mpfr_t expected, argument_of_f;

    mpfr_init2(expected, BITS);
    mpfr_init2(argument_of_f, 53);
    for (unsigned long i = 0; i < 7 * arguments; i++) {
        const double x = argument(f, (unsigned)(i % 7)), found = f->found(x);
        const int is_right = is_symmetric(f, x, found) && is_within(f, found);
        const double error = is_right ? error_of(f, x, found, expected, argument_of_f) : (double)INFINITY;
        if (error > largest) {
            largest = error;
            where = x;
        }
    }
    mpfr_clears(expected, argument_of_f, (mpfr_ptr)0);
    printf("%-13s %.3f at %.17g\n", f->name, largest, where);
    return largest <= f->error;
}

static void list(void)
{
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        puts(functions[i].name);
}

int main(int count, char **arguments)
{
    const unsigned long number = count > 1 ? strtoul(arguments[1], NULL, 10) : 20000;
    int are_right = 1;

    if (count > 1 && strcmp(arguments[1], "list") == 0) {
        list();
        return 0;
    }
    if (number == 0)
        return 2;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (count < 3 || strcmp(arguments[2], functions[i].name) == 0)
            are_right &= look_at(&functions[i], number);
    return !are_right;
}
