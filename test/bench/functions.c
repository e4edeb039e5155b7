/* SPDX-License-Identifier: MIT */
/* What the functions of lqg/functions.h cost on a core, and those of libm for the same arguments: prints
 * NAME_mean, NAME_most, NAME_libm_mean, NAME_libm_most in instructions, the return included, the call not. REAL is
 * float or double, OURS(name) and LIBM(name) make the names of its functions. */
#include <math.h>
#include <stdint.h>

#include "counter.h"
#include "lqg/functions.h"
#include "results.h"

enum { STACK_WORDS = 512, ARGUMENTS = 250 };

static uint32_t stack[STACK_WORDS] __attribute__((aligned(16)));

/* One of three shapes. */
typedef struct {
    REAL (*of_one)(REAL);
    REAL (*of_two)(REAL, REAL);
    void (*to_two)(REAL, REAL *, REAL *);
} function_t;

static void call(const function_t *f, const REAL x[2], REAL results[2])
{
    if (f->of_one)
        results[0] = f->of_one(x[0]);
    else if (f->of_two)
        results[0] = f->of_two(x[0], x[1]);
    else
        f->to_two(x[0], &results[0], &results[1]);
}

static REAL no_function_of_one(REAL x)
{
    return x;
}
static REAL no_function_of_two(REAL y, REAL x)
{
    return (void)x, y;
}
static void no_function_to_two(REAL x, REAL *a, REAL *b)
{
    (void)x, (void)a, (void)b;
}

static function_t nothing_like(const function_t *f)
{
    const function_t nothing = {f->of_one ? no_function_of_one : 0, f->of_two ? no_function_of_two : 0,
                                f->to_two ? no_function_to_two : 0};
    return nothing;
}

static unsigned instructions_of(const function_t *f, const REAL x[2])
{
    function_t measured = *f, nothing = nothing_like(f);
    REAL results[2];
    const uint32_t frame = ticks_of_call(&nothing, x, results, (function *)call, stack + STACK_WORDS);
    const uint32_t all = ticks_of_call(&measured, x, results, (function *)call, stack + STACK_WORDS);

    return instructions_in(all) - instructions_in(frame) + 1; /* 1: the return */
}

/* Uniform in [−1, 1). */
static REAL random_number(void)
{
    static uint32_t word = 1;

    word = word * 1664525u + 1013904223u;
    return (REAL)(word >> 8) / 8388608 - 1;
}

static void measure(const char *mean, const char *most, const function_t *f, REAL low, REAL high)
{
    unsigned sum = 0, largest = 0;

    for (unsigned i = 0; i < ARGUMENTS; i++) {
        const REAL middle = (low + high) / 2, half = (high - low) / 2;
        const REAL x[2] = {middle + half * random_number(), middle + half * random_number()};
        const unsigned instructions = instructions_of(f, x);
        sum += instructions;
        largest = instructions > largest ? instructions : largest;
    }
    print(mean, (sum + ARGUMENTS / 2) / ARGUMENTS);
    print(most, largest);
}

/* ---- the functions ----------------------------------------------------------------------------------------------- */

static void libm_sin_cos(REAL x, REAL *sine, REAL *cosine)
{
    *sine = LIBM(sin)(x);
    *cosine = LIBM(cos)(x);
}

static REAL libm_wrap(REAL x)
{
    return LIBM(remainder)(x, (REAL)6.283185307179586);
}

#define MEASURE(name, shape, ours, libm, low, high)                     \
    {                                                                   \
        const function_t a = {shape(ours)}, b = {shape(libm)};          \
        measure(#name "_mean", #name "_most", &a, low, high);           \
        measure(#name "_libm_mean", #name "_libm_most", &b, low, high); \
    }
#define ONE(f) f, 0, 0
#define TWO(f) 0, f, 0
#define TO_TWO(f) 0, 0, f

int main(void)
{
    start_counting();
    if (instructions_in(ticks_of_call(0, 0, 0, do_nothing_a_thousand_times, stack + STACK_WORDS)) -
            instructions_in(ticks_of_call(0, 0, 0, do_nothing, stack + STACK_WORDS)) !=
        1000)
        return 1;
    MEASURE(sin_cos, TO_TWO, OURS(sin_cos), libm_sin_cos, -10, 10)
    MEASURE(sin, ONE, OURS(sin), LIBM(sin), -10, 10)
    MEASURE(cos, ONE, OURS(cos), LIBM(cos), -10, 10)
    MEASURE(tan, ONE, OURS(tan), LIBM(tan), -10, 10)
    MEASURE(asin, ONE, OURS(asin), LIBM(asin), -1, 1)
    MEASURE(acos, ONE, OURS(acos), LIBM(acos), -1, 1)
    MEASURE(atan, ONE, OURS(atan), LIBM(atan), -4, 4)
    MEASURE(atan2, TWO, OURS(atan2), LIBM(atan2), -4, 4)
    MEASURE(sqrt, ONE, OURS(sqrt), LIBM(sqrt), 0, 10)
    MEASURE(exp, ONE, OURS(exp), LIBM(exp), -10, 10)
    MEASURE(log, ONE, OURS(log), LIBM(log), 0, 10)
    MEASURE(tanh, ONE, OURS(tanh), LIBM(tanh), -4, 4)
    MEASURE(wrap, ONE, OURS(wrap), libm_wrap, -10, 10)
    return 0;
}
