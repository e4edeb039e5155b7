/* SPDX-License-Identifier: MIT */
/* The Kalman filter that keeps the covariance P of its error, as a lower triangle. */
#include "bounds_check.h"
#include "covariance.h"
#include "gate.h"
#include "kernel.h"
#include "plant.h"

LQG_STRICT_BEGIN

static void check_contract(const lqg_kalman_plain_t *kalman, const lqg_kalman_plain_state_t *state)
{
    (void)kalman;
    (void)state;
    LQG_ASSERT(kalman && state);
    check_plant(&kalman->plant, state->x, state->u_applied);
    check_gate(kalman->gate, &state->gate);
    LQG_ASSERT(kalman->V && kalman->W && kalman->P0 && state->P);
    LQG_ASSERT(!kalman->M || (kalman->A_free && state->innovation));
}

static void begin_covariance(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state)
{
    copy(state->P, kalman->P0, LQG_TRIANGLE(kalman->plant.nx));
}

static void begin_estimate(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state)
{
    lqg_plant_begin(&kalman->plant, kalman->x0, state->x, state->u_applied, state->innovation);
    begin_widening(kalman->gate, &state->gate, kalman->plant.ny);
    begin_covariance(kalman, state);
}

void lqg_kalman_plain_init(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state)
{
    check_contract(kalman, state);
    begin_estimate(kalman, state);
}

/* x̂ not within its bounds: all begins anew. P not within its own, or no covariance: P does, and x̂ stays. */
static lqg_status_t recover(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state, int x_is_fit,
                            int P_is_fit)
{
    if (!x_is_fit) {
        begin_estimate(kalman, state);
        return LQG_STATE_RESET;
    }
    if (!P_is_fit) {
        begin_covariance(kalman, state);
        return LQG_COVARIANCE_RESET;
    }
    return LQG_OK;
}

/* After an update: of a covariance the variance of an innovation is V at least. */
static lqg_status_t recover_from_update(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                        lqg_status_t status)
{
    bounds_check_t check = {0, 0, 0};
    const int P_is_fit = !(status & LQG_INNOVATION_NOT_POSITIVE);

    lqg_bounds_check_add(&check, state->x, kalman->x_scale, kalman->plant.nx);
    return status | recover(kalman, state, is_within_bounds(&check), P_is_fit);
}

/* Takes output i, y_i, into x̂ and P, or leaves it out and says why. */
static lqg_status_t update_output(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state, unsigned i,
                                  lqg_real y_i, const gatekeeper_t *keeper)
{
    LQG_STRICT_BODY
    const unsigned nx = kalman->plant.nx;
    const lqg_real *c = kalman->plant.C + i * nx;
    lqg_real *x = state->x, *P = state->P, *f = state->work;

    /* f = P cᵀ,  s = c P cᵀ + V_i */
    lqg_covariance_project(P, nx, c, f);
    const lqg_real s = add_row_product(kalman->V[i], c, 0, nx, f);

    const lqg_real measured = lqg_plant_innovation(&kalman->plant, i, x, state->u_applied, y_i);
    const int plausible = is_plausible(measured, kalman->innovation_limit, i);
    const lqg_real innovation = plausible ? measured : 0;
    const lqg_status_t left_out = !plausible ? rejected(i) : !(s > 0) ? LQG_INNOVATION_NOT_POSITIVE : LQG_OK;
    const lqg_status_t gated = !left_out && is_expected(keeper, i, innovation, s)
                                   ? LQG_OK
                                   : lqg_gate_weigh(keeper, i, !left_out, innovation, s, 0);
    const int usable = !left_out && !gated;
    const lqg_real correction = usable ? innovation : 0;
    const lqg_real inverse = usable ? 1 / s : 0;

    lqg_covariance_correct(P, x, nx, f, inverse, correction); /* with gain = f / s */
    return left_out ? left_out : gated;
}

lqg_status_t lqg_kalman_plain_update(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                     const lqg_real y[])
{
    return lqg_kalman_plain_partial_update(kalman, state, y, LQG_ALL_OUTPUTS, NULL);
}

lqg_status_t lqg_kalman_plain_partial_update(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                             const lqg_real y[], unsigned long used, const lqg_watch_t *watch)
{
    check_contract(kalman, state);
    LQG_ASSERT(y && state->work);
    const lqg_plant_t *plant = &kalman->plant;
    const gatekeeper_t keeper = {kalman->gate, &state->gate, watch};
    lqg_real *outputs = state->work + plant->nx;
    lqg_status_t status = LQG_OK;

    for (unsigned i = 0; i < plant->ny; i++) {
        const int is_used = (used & 1uL) != 0;
        outputs[i] = lqg_plant_decorrelate(plant, kalman->E, i, y, outputs);
        const lqg_status_t left_out = is_used ? update_output(kalman, state, i, outputs[i], &keeper) : LQG_OK;
        const int heard = is_used && !left_out;
        if (!is_used)
            skip(&keeper, i, 0);
        status |= left_out;
        if (kalman->M)
            state->innovation[i] = heard ? 1 : 0;
        if (!heard) /* nor by way of another output */
            outputs[i] = (lqg_real)NAN;
        used = after_lowest(used);
    }
    if (kalman->M)
        lqg_plant_keep_residuals(plant, state->x, state->u_applied, outputs, state->innovation);

    return recover_from_update(kalman, state, status);
}

lqg_status_t lqg_kalman_plain_update_output(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                            const lqg_real *y_i, unsigned i, const lqg_watch_t *watch)
{
    check_contract(kalman, state);
    LQG_ASSERT(y_i && i < kalman->plant.ny && state->work);
    const lqg_plant_t *plant = &kalman->plant;
    const gatekeeper_t keeper = {kalman->gate, &state->gate, watch};
    const lqg_real alone = lqg_plant_decorrelate_alone(plant, kalman->E, i, *y_i);

    const lqg_status_t left_out = update_output(kalman, state, i, alone, &keeper);
    if (kalman->M)
        state->innovation[i] = left_out ? 0 : lqg_plant_innovation(plant, i, state->x, state->u_applied, alone);
    return recover_from_update(kalman, state, left_out);
}

lqg_status_t lqg_kalman_plain_predict(const lqg_kalman_plain_t *kalman, lqg_kalman_plain_state_t *state,
                                      const lqg_real u[])
{
    check_contract(kalman, state);
    LQG_ASSERT((u || !kalman->plant.nu) && state->work);
    bounds_check_t check = {0, 0, 0};

    lqg_plant_predict(&kalman->plant, kalman->M, state->x, state->u_applied, state->innovation, u, state->work);
    lqg_covariance_predict(state->P, kalman->plant.nx, kalman->M ? kalman->A_free : kalman->plant.A,
                           kalman->plant.pattern, kalman->W, state->work);

    lqg_bounds_check_add(&check, state->x, kalman->x_scale, kalman->plant.nx);
    const int x_is_fit = is_within_bounds(&check);
    for (unsigned i = 0; i < kalman->plant.nx; i++) /* |P_ij| ≤ √(P_ii P_jj) */
        add_variance(&check, state->P[LQG_TRIANGLE(i) + i], kalman->x_scale, i);
    return recover(kalman, state, x_is_fit, is_within_bounds(&check));
}

LQG_STRICT_END
