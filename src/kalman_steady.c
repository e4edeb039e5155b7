/* SPDX-License-Identifier: MIT */
/* The Kalman filter with constant gain. */
#include "bounds_check.h"
#include "gate.h"
#include "kernel.h"
#include "plant.h"

LQG_STRICT_BEGIN

static void check_contract(const lqg_kalman_steady_t *kalman, const lqg_kalman_steady_state_t *state)
{
    (void)kalman;
    (void)state;
    LQG_ASSERT(kalman && state);
    check_plant(&kalman->plant, state->x, state->u_applied);
    check_gate(kalman->gate, &state->gate);
    LQG_ASSERT(kalman->L && (state->innovation || !kalman->M));
    LQG_ASSERT(kalman->S || !kalman->gate);
}

static void begin_estimate(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state)
{
    lqg_plant_begin(&kalman->plant, kalman->x0, state->x, state->u_applied, state->innovation);
    begin_widening(kalman->gate, &state->gate, kalman->plant.ny);
}

void lqg_kalman_steady_init(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state)
{
    check_contract(kalman, state);
    begin_estimate(kalman, state);
}

static lqg_status_t reset_unless_bounded(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state)
{
    bounds_check_t check = {0, 0, 0};

    lqg_bounds_check_add(&check, state->x, kalman->x_scale, kalman->plant.nx);
    if (is_within_bounds(&check))
        return LQG_OK;

    begin_estimate(kalman, state);
    return LQG_STATE_RESET;
}

/* y_i − C_i x̂ − D_i u, 0 where output i is not used: it is treated as an innovation of 0. */
static lqg_real innovate(const lqg_kalman_steady_t *kalman, const lqg_kalman_steady_state_t *state, unsigned i,
                         lqg_real y_i, const gatekeeper_t *keeper, lqg_status_t *status)
{
    const lqg_real measured = lqg_plant_innovation(&kalman->plant, i, state->x, state->u_applied, y_i);
    const int plausible = is_plausible(measured, kalman->innovation_limit, i);
    const lqg_real innovation = plausible ? measured : 0;
    const lqg_real variance = kalman->S ? kalman->S[i] : 0;
    lqg_status_t left_out = plausible ? LQG_OK : rejected(i);

    if (!plausible || !is_expected(keeper, i, innovation, variance))
        left_out |= lqg_gate_weigh(keeper, i, plausible, innovation, variance, 1);

    *status |= left_out;
    return left_out ? 0 : innovation;
}

lqg_status_t lqg_kalman_steady_update(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                      const lqg_real y[])
{
    return lqg_kalman_steady_partial_update(kalman, state, y, LQG_ALL_OUTPUTS, NULL);
}

lqg_status_t lqg_kalman_steady_partial_update(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                              const lqg_real y[], unsigned long used, const lqg_watch_t *watch)
{
    check_contract(kalman, state);
    LQG_ASSERT(y && state->work);
    const lqg_plant_t *plant = &kalman->plant;
    const gatekeeper_t keeper = {kalman->gate, &state->gate, watch};
    lqg_real *innovation = kalman->M ? state->innovation : state->work; /* predict needs them only for M */
    lqg_status_t status = LQG_OK;

    for (unsigned i = 0; i < plant->ny; i++) {
        innovation[i] = 0;
        if (used & 1uL)
            innovation[i] = innovate(kalman, state, i, y[i], &keeper, &status);
        else
            skip(&keeper, i, 1);
        used = after_lowest(used);
    }

    /* x̂ ← x̂ + L innovation */
    for (unsigned j = 0; j < plant->nx; j++)
        state->x[j] = add_row_product(state->x[j], kalman->L, j, plant->ny, innovation);

    return status | reset_unless_bounded(kalman, state);
}

lqg_status_t lqg_kalman_steady_update_output(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                             const lqg_real *y_i, unsigned i, const lqg_watch_t *watch)
{
    check_contract(kalman, state);
    LQG_ASSERT(y_i && i < kalman->plant.ny);
    const lqg_plant_t *plant = &kalman->plant;
    const gatekeeper_t keeper = {kalman->gate, &state->gate, watch};
    lqg_status_t status = LQG_OK;
    const lqg_real innovation = innovate(kalman, state, i, *y_i, &keeper, &status);

    for (unsigned j = 0; j < plant->nx; j++)
        state->x[j] = multiply_add(kalman->L[j * plant->ny + i], innovation, state->x[j]);
    if (kalman->M)
        state->innovation[i] = innovation;

    return status | reset_unless_bounded(kalman, state);
}

lqg_status_t lqg_kalman_steady_predict(const lqg_kalman_steady_t *kalman, lqg_kalman_steady_state_t *state,
                                       const lqg_real u[])
{
    check_contract(kalman, state);
    LQG_ASSERT((u || !kalman->plant.nu) && state->work);
    lqg_plant_predict(&kalman->plant, kalman->M, state->x, state->u_applied, state->innovation, u, state->work);
    return reset_unless_bounded(kalman, state);
}

LQG_STRICT_END
