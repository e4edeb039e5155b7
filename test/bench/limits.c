/* SPDX-License-Identifier: MIT */
/* What the law with limits costs on a core: the instructions of lqg_mpc_control with the tables in TABLES, the median
 * where no limit is in the way, and the most of all. */
#include <stdint.h>

#include "counter.h"
#include "lqg/lqg.h"
#include "results.h"

#include TABLES /* K, F, G, scale, low, high, tolerance; NX, NU, ROWS */

enum { STACK_WORDS = 512, STATES = 20000 };

static uint32_t stack[STACK_WORDS] __attribute__((aligned(16)));
static const lqg_mpc_t mpc = {NX, NU, ROWS, 10, K, F, G, scale, low, high, tolerance, 0};

LQG_MPC_STATE(state, 0, ROWS);
static lqg_status_t status;
static unsigned idle[STATES];

static void control(void *object, const void *signals, void *results)
{
    (void)object;
    status = lqg_mpc_control(&mpc, &state, (const lqg_real *)signals, (lqg_real *)results);
}

static unsigned instructions_of(function *f, const lqg_real x[], lqg_real u[])
{
    const unsigned frame = instructions_in(ticks_of_call(0, 0, 0, do_nothing, stack + STACK_WORDS));

    return instructions_in(ticks_of_call(0, x, u, f, stack + STACK_WORDS)) - frame + 1; /* 1: do_nothing's own */
}

static int is_any_active(void)
{
    int is_any = 0;

    for (unsigned i = 0; i < ROWS; i++)
        is_any |= state.side[i] != 0;
    return is_any;
}

static lqg_real random_number(void)
{
    static uint32_t word = 1;

    word = word * 1664525u + 1013904223u;
    return (lqg_real)(word >> 8) / 4194304 - 2; /* in [−2, 2) */
}

int main(void)
{
    unsigned idles = 0, most = 0, given_up = 0;

    start_counting();
    if (instructions_of(do_nothing_a_thousand_times, 0, 0) != 1001)
        return 1;
    for (unsigned n = 0; n < STATES; n++) {
        lqg_real x[NX], u[NU];
        for (unsigned i = 0; i < NX; i++)
            x[i] = random_number() / (lqg_real)(1u << n % 8);
        const unsigned instructions = instructions_of((function *)control, x, u);
        if (!is_any_active())
            idle[idles++] = instructions;
        most = instructions > most ? instructions : most;
        given_up += (status & LQG_NOT_OPTIMAL) != 0;
    }
    print("idle", median(idle, idles));
    print("most", most);
    print("given_up", given_up);
    print("ram", sizeof state + sizeof state_memory + sizeof state_set);
    return 0;
}
