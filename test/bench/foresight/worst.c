/* SPDX-License-Identifier: MIT */
/* Looks for the states of a compiled header whose samples take the most multiply-adds: worst NUMBER. Prints tables of
 * them, and of states in which no limit is in the way. Bits are the same on all targets, so these are the targets'
 * worst ones, too. plant.h is that of test/foresight. */
#include "lqg/mpc.h"

#include "../../../src/kernel.h"

static unsigned long counted; /* but for F x: 0 where no limit is in the way */

#define multiply_add(a, b, c) (counted++, (multiply_add)(a, b, c))
#define multiply_subtract(a, b, c) (counted++, (multiply_subtract)(a, b, c))
#undef lqg_mpc_limit
#undef lqg_mpc_control
#define lqg_mpc_limit counted_mpc_limit
#define lqg_mpc_control counted_mpc_control
#include "../../../src/mpc.c"

#define main foresight_main
#include "../../foresight/foresight.c"
#undef main

enum { KEPT = 32 };

struct state {
    unsigned long count;
    OF(t) controller;
};

static struct state worst[KEPT], idle[KEPT];

static void keep(const struct state *now)
{
    int least = 0;

    for (int i = 1; i < KEPT; i++)
        if (worst[i].count < worst[least].count)
            least = i;
    if (now->count > worst[least].count)
        worst[least] = *now;
}

static void print_state(const struct state *state)
{
    printf("    {");
    for (int i = 0; i < NX; i++)
        printf("(REAL)%.17g, ", (double)state->controller.x[i]);
#ifdef LIMITS_CHANGE
    for (int i = 0; i < NU; i++)
        printf("(REAL)%.17g, ", (double)state->controller.u_applied[i]);
#endif
#ifdef HAS_REFERENCES
    for (int i = 0; i < NR; i++)
        printf("(REAL)%.17g, ", (double)state->controller.r[i]);
#endif
    printf("},\n");
}

static void print_table(const char *name, const struct state states[], int count)
{
    printf("static const REAL %s[][%d] = {\n", name, NX + NU + NR);
    for (int i = 0; i < count; i++)
        print_state(&states[i]);
    printf("};\n");
}

int main(int count, char **words)
{
    const long number = count > 1 ? strtol(words[1], NULL, 10) : 0;
    int idles = 0;

    for (long n = 0; n < number; n++) {
        struct state now;
        real last[NU], u[NU];
        counted = 0;
        answer(&now.controller, last, u);
        now.count = counted;
        if (counted > 0)
            keep(&now);
        else if (idles < KEPT)
            idle[idles++] = now;
    }
    if (idles == 0 || worst[KEPT - 1].count == 0)
        return 1;
    print_table("worst", worst, KEPT);
    print_table("idle", idle, idles);
#ifdef LIMITS_CHANGE
    printf("#define LIMITS_CHANGE\n");
#endif
#ifdef HAS_REFERENCES
    printf("enum { NR = %d };\n#define HAS_REFERENCES\n", NR);
#endif
    return 0;
}
