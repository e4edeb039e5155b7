/* SPDX-License-Identifier: MIT */
/* The library's law with limits that are foreseen, with a state, a last input and numbers of any bits. */
#include "unknown.h"
#include "lqg/lqg.h"

enum { NX = 2, NU = 1, ROWS = 4 };

volatile int any_int;
volatile lqg_real any_real;

static void say_anything(lqg_real v[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        v[i] = any_real;
}

static const lqg_real low[ROWS] = {-1, -1, -2, -2}, high[ROWS] = {2, 2, 3, 3}, u_step[NU] = {0.5f};

int main(void)
{
    lqg_real K[NU * NX], F[(ROWS - NU) * NX], G[ROWS * ROWS], scale[ROWS], tolerance[ROWS], x[NX], u[NU], applied[NU];
    lqg_real memory[LQG_MPC_MEMORY(ROWS)];
    unsigned char set[LQG_MPC_SET(ROWS)];
    const lqg_mpc_t mpc = {NX, NU, ROWS, 12, K, F, G, scale, low, high, tolerance, any_int ? u_step : NULL};
    lqg_mpc_state_t state = LQG_MPC_STATE_IN(memory, set, applied, ROWS);

    say_anything(K, NU * NX);
    say_anything(F, (ROWS - NU) * NX);
    say_anything(G, ROWS * ROWS);
    say_anything(scale, ROWS);
    say_anything(tolerance, ROWS);
    say_anything(x, NX);
    say_anything(u, NU);
    say_anything(applied, NU);
    if (any_int)
        (void)lqg_mpc_control(&mpc, &state, x, u);
    else
        (void)lqg_mpc_limit(&mpc, &state, x, u);
    for (unsigned i = 0; i < NU; i++) {
        /*@ check input_limited: low[i] <= u[i] <= high[i]; */
    }
    return 0;
}
