/* SPDX-License-Identifier: MIT */
/* The library's law with limits, with the tables of a controller and x, u, u[k−1] and scratch of any bits. */
#include "anything.h"

enum { NU = SIZE(NU), ROWS = SIZE(ROWS) };
static const lqg_mpc_t *const limits = &SIZE(LIMITS);

/* All of it, at once: in a loop of its own each entry takes the prover a step. */
/*@ assigns v[0 .. length - 1] \from length; ensures \initialized(v + (0 .. length - 1)); */
void fill(lqg_real v[], unsigned length);

int main(void)
{
    lqg_real x[PROOF_FORESIGHT], u[NU], applied[NU], memory[LQG_MPC_MEMORY(ROWS)];
    unsigned char set[LQG_MPC_SET(ROWS)];
    lqg_mpc_state_t work = LQG_MPC_STATE_IN(memory, set, applied, ROWS);

    say_anything(x, PROOF_FORESIGHT);
    say_anything(u, NU);
    say_anything(applied, NU);
    fill(memory, LQG_MPC_MEMORY(ROWS));
    (void)lqg_mpc_limit(limits, &work, x, u);
    for (int i = 0; i < NU; i++) {
        /*@ check input_finite: \is_finite(u[i]); */
        /*@ check input_limited: limits->low[i] <= u[i] <= limits->high[i]; */
    }
    return 0;
}
