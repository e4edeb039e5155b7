/* SPDX-License-Identifier: MIT */
/* Instructions of NAME_control in the states of worst.c, on a core: the most where no limit is in the way, and the most
 * of all. NAME and UPPER_NAME are the names of the controller in HEADER, REAL its scalar. */
#include <stdint.h>

#include "../counter.h"
#include "../results.h"

#include HEADER
#include "states.h"

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

enum { STACK_WORDS = 2048, NX = SIZE(NX), NU = SIZE(NU) };

static uint32_t stack[STACK_WORDS] __attribute__((aligned(16)));

static unsigned instructions_of(function *f, void *object, void *results)
{
    const unsigned frame = instructions_in(ticks_of_call(0, 0, 0, do_nothing, stack + STACK_WORDS));

    return instructions_in(ticks_of_call(object, results, 0, f, stack + STACK_WORDS)) - frame + 1; /* 1: its own */
}

static unsigned instructions_in_state(const REAL state[])
{
    OF(t) self;
    REAL u[NU];

    OF(init)(&self);
    for (unsigned i = 0; i < NX; i++)
        self.x[i] = *state++;
#ifdef LIMITS_CHANGE
    for (unsigned i = 0; i < NU; i++)
        self.u_applied[i] = *state++;
#endif
#ifdef HAS_REFERENCES
    for (unsigned i = 0; i < NR; i++)
        self.r[i] = *state++;
#endif
    return instructions_of((function *)OF(control), &self, u);
}

int main(void)
{
    unsigned most_idle = 0, most = 0;

    start_counting();
    if (instructions_of(do_nothing_a_thousand_times, 0, 0) != 1001)
        return 1;
    for (unsigned i = 0; i < sizeof idle / sizeof *idle; i++) {
        const unsigned instructions = instructions_in_state(idle[i]);
        most_idle = instructions > most_idle ? instructions : most_idle;
    }
    for (unsigned i = 0; i < sizeof worst / sizeof *worst; i++) {
        const unsigned instructions = instructions_in_state(worst[i]);
        most = instructions > most ? instructions : most;
    }
    print("idle", most_idle);
    print("most", most);
    return 0;
}
