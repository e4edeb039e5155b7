/* SPDX-License-Identifier: MIT */
/* lqg_mpc_limit as foresight.c proves it, for the proof of a controller that calls it: u anything within its limits. */
#include "unknown.h"
#include "lqg/mpc.h"

extern volatile lqg_real any_real;

lqg_status_t lqg_mpc_limit(const lqg_mpc_t *mpc, lqg_mpc_state_t *state, const lqg_real x[], lqg_real u[])
{
    lqg_status_t status = LQG_OK;

    (void)state;
    for (unsigned i = 0; i < mpc->nx; i++)
        (void)x[i];
    for (unsigned i = 0; i < mpc->nu; i++) {
        const lqg_real any = any_real;
        if (!(any == any && any >= mpc->low[i] && any <= mpc->high[i]))
            stop();
        u[i] = any;
    }
    if (any_int)
        status |= LQG_INPUT_LIMITED;
    if (any_int)
        status |= LQG_NOT_OPTIMAL;
    return status;
}
