/* SPDX-License-Identifier: MIT */
/* What the controller in HEADER costs: instructions executed by each of its functions, for the reference samples in
 * VECTORS, and the stack that step uses, with CALLS the functions that it calls. NAME and UPPER_NAME are its names,
 * REAL its scalar; ESTIMATES says that it has no law, HAS_INPUT that it is told or gives u, GATED that it has a gate
 * with its `widening`. A controller that keeps z (KEEPS_Z) has control and advance, which count as control and predict;
 * y goes to the first of them, or to the second with PREDICTS. */
#include <math.h>
#include <stdint.h>

#include "counter.h"
#include "results.h"

#include HEADER
#include VECTORS /* y_in, u_out */

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

enum { SAMPLES = sizeof y_in / sizeof y_in[0], NY = SIZE(NY) };

/* ---- the instruments --------------------------------------------------------------------------------- */

enum { STACK_WORDS = 2048, UNTOUCHED = 0x5AA5C33C };

/* The calls' own, so that their depth can be seen in it at the end. */
static uint32_t stack[STACK_WORDS] __attribute__((aligned(16)));

static void clear_stack(void)
{
    for (unsigned i = 0; i < STACK_WORDS; i++)
        stack[i] = UNTOUCHED;
}

/* In bytes; all of the stack means that it has been too small. */
static unsigned deepest_reach(void)
{
    unsigned untouched = 0;

    while (untouched < STACK_WORDS && stack[untouched] == UNTOUCHED)
        untouched++;
    return 4 * (STACK_WORDS - untouched);
}

static unsigned instructions_of(function *f, void *object, const void *signals, void *results)
{
    const unsigned frame = instructions_in(ticks_of_call(NULL, NULL, NULL, do_nothing, stack + STACK_WORDS));
    const unsigned all = instructions_in(ticks_of_call(object, signals, results, f, stack + STACK_WORDS));

    return all - frame + 1; /* 1: do_nothing's own */
}

static int counts_right(void)
{
    return instructions_of(do_nothing_a_thousand_times, NULL, NULL, NULL) == 1001;
}

/* ---- the samples ------------------------------------------------------------------------------------- */

enum { UPDATE, CONTROL, PREDICT, STEP, FUNCTIONS };

typedef struct {
    unsigned instructions[SAMPLES]; /* of the last run */
    unsigned most;                  /* of all runs */
} record_t;

static record_t records[FUNCTIONS];

static unsigned larger(unsigned a, unsigned b)
{
    return a > b ? a : b;
}

static void measure(record_t *record, unsigned sample, function *f, void *object, const void *signals, void *results)
{
    record->instructions[sample] = instructions_of(f, object, signals, results);
    record->most = larger(record->most, record->instructions[sample]);
}

static void draw_outputs(REAL y[NY], unsigned sample, unsigned left_out)
{
    for (unsigned i = 0; i < NY; i++)
        y[i] = i == left_out && sample % 3 == 1 ? (REAL)NAN : y_in[sample][i];
}

/* All samples by step, which applies what it asks for. Where none is left out, a gate (GATED) is as narrow as after a
 * while: as long as it is wide every output is weighed. */
static void run_step(unsigned left_out)
{
    OF(t) self;
    REAL y[NY];
#ifndef ESTIMATES
    REAL u[SIZE(NU)];
#endif

    OF(init)(&self);
    for (unsigned k = 0; k < SAMPLES; k++) {
        draw_outputs(y, k, left_out);
#ifdef GATED
        for (unsigned i = 0; i < NY && left_out == NY; i++)
            self.widening[i] = 1;
#endif
#if !defined ESTIMATES
        measure(&records[STEP], k, (function *)OF(step), &self, y, u);
#elif defined HAS_INPUT
        measure(&records[STEP], k, (function *)OF(step), &self, y, (void *)(uintptr_t)u_out[k]);
#else
        measure(&records[STEP], k, (function *)OF(step), &self, y, NULL);
#endif
    }
}

/* All samples by the calls; output `left_out` is missing in every third, or none where there is no such output. */
static void run_calls(unsigned left_out)
{
    OF(t) self;
    REAL y[NY];
#ifndef ESTIMATES
    REAL u[SIZE(NU)];
#endif

    OF(init)(&self);
    for (unsigned k = 0; k < SAMPLES; k++) {
        draw_outputs(y, k, left_out);
#if defined PREDICTS
        measure(&records[CONTROL], k, (function *)OF(control), &self, u, NULL);
        measure(&records[PREDICT], k, (function *)OF(advance), &self, y, NULL);
#elif defined KEEPS_Z
        measure(&records[CONTROL], k, (function *)OF(control), &self, y, u);
        measure(&records[PREDICT], k, (function *)OF(advance), &self, NULL, NULL);
#elif defined ESTIMATES
        measure(&records[UPDATE], k, (function *)OF(update), &self, y, NULL);
#ifdef HAS_INPUT
        measure(&records[PREDICT], k, (function *)OF(predict), &self, u_out[k], NULL);
#else
        measure(&records[PREDICT], k, (function *)OF(predict), &self, NULL, NULL);
#endif
#else
        measure(&records[UPDATE], k, (function *)OF(update), &self, y, NULL);
        measure(&records[CONTROL], k, (function *)OF(control), &self, u, NULL);
        measure(&records[PREDICT], k, (function *)OF(predict), &self, u_out[k], NULL);
#endif
    }
}

/* ---- the report -------------------------------------------------------------------------------------- */

static void run_all(void (*run)(unsigned left_out))
{
    for (unsigned left_out = 0; left_out < NY; left_out++)
        run(left_out);
    run(NY); /* the last, whose instructions stay in the records: the samples as they are */
}

int main(void)
{
    start_counting();
    if (!counts_right())
        return 1;
#ifdef CALLS
    run_all(run_step);
    clear_stack();
    run_all(run_calls);
#else
    run_all(run_calls);
    clear_stack();
    run_all(run_step);
#endif
    print("update", median(records[UPDATE].instructions, SAMPLES));
    print("control", median(records[CONTROL].instructions, SAMPLES));
    print("predict", median(records[PREDICT].instructions, SAMPLES));
    print("step", median(records[STEP].instructions, SAMPLES));
    print("most_update", records[UPDATE].most);
    print("most_control", records[CONTROL].most);
    print("most_predict", records[PREDICT].most);
    print("most_step", records[STEP].most);
    print("stack", deepest_reach());
    print("ram", sizeof(OF(t)));
    return deepest_reach() == sizeof stack;
}
