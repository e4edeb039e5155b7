/* SPDX-License-Identifier: MIT */
/* Of one contestant on an emulated core: instructions of a sample, the median of all samples; the deepest reach of the
 * stack below its caller, in bytes; and how far its answers are off, in millionths (answers.h). */
#include "../counter.h"
#include "../results.h"
#include "answers.h"

enum { STACK_WORDS = 2048, UNTOUCHED = 0x5AA5C33C };

static uint32_t stack[STACK_WORDS] __attribute__((aligned(16)));
static unsigned counts[SAMPLES];

static void clear_stack(void)
{
    for (unsigned i = 0; i < STACK_WORDS; i++)
        stack[i] = UNTOUCHED;
}

static unsigned deepest_reach(void)
{
    unsigned untouched = 0;

    while (untouched < STACK_WORDS && stack[untouched] == UNTOUCHED)
        untouched++;
    return 4 * (STACK_WORDS - untouched);
}

/* Since start_counting(): SysTick's COUNTFLAG. It does after some 2.6 million instructions. */
static int has_gone_around(void)
{
    return (int)(*(volatile uint32_t *)0xE000E010u >> 16 & 1);
}

int main(void)
{
    real_t x[NX], P[NX][NX];
    double error = 0;
    int was_in_range = 1;

    peer_init();
    clear_stack();
    for (unsigned k = 0; k < SAMPLES; k++) {
        uint32_t none;

        start_counting();
        none = ticks_of_call(NULL, NULL, NULL, do_nothing, stack + STACK_WORDS);
        counts[k] = instructions_in(
                        ticks_of_call((void *)u_in[k], y_in[k], NULL, (function *)peer_sample, stack + STACK_WORDS)) -
                    instructions_in(none) + 1; /* 1: do_nothing's own */
        was_in_range = was_in_range && !has_gone_around();
        peer_estimate(x, P);
        error = larger(error_in_sample(k, x, P), error);
    }
    print("instructions", median(counts, SAMPLES));
    print("stack", deepest_reach());
    print("error", error < 1 ? (unsigned)(1e6 * error + 1) : 1000000);
    return deepest_reach() == sizeof stack || !was_in_range;
}
