/* SPDX-License-Identifier: MIT */
/* The Kalman filter that keeps its covariance as P = U diag(d) Uᵀ, U unit upper triangular. */
#include "bounds_check.h"
#include "factors.h"
#include "gate.h"
#include "plant.h"

LQG_STRICT_BEGIN

static void check_contract(const lqg_kalman_ud_t *kalman, const lqg_kalman_ud_state_t *state)
{
    (void)kalman;
    (void)state;
    LQG_ASSERT(kalman && state);
    check_plant(&kalman->plant, state->x, state->u_applied);
    check_gate(kalman->gate, &state->gate);
    LQG_ASSERT(kalman->V && kalman->d0 && state->d);
    LQG_ASSERT(kalman->plant.nx == 1 || (kalman->U0 && state->U));
    LQG_ASSERT(!kalman->nw || (kalman->G && kalman->W));
    LQG_ASSERT(!kalman->M || (kalman->A_free && state->innovation));
}

static void begin_covariance(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state)
{
    copy(state->U, kalman->U0, LQG_STRICT_TRIANGLE(kalman->plant.nx));
    copy(state->d, kalman->d0, kalman->plant.nx);
}

static void begin_estimate(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state)
{
    lqg_plant_begin(&kalman->plant, kalman->x0, state->x, state->u_applied, state->innovation);
    begin_widening(kalman->gate, &state->gate, kalman->plant.ny);
    begin_covariance(kalman, state);
}

void lqg_kalman_ud_init(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state)
{
    check_contract(kalman, state);
    begin_estimate(kalman, state);
}

/* x̂ not within its bounds: all begins anew. U or d not within theirs, or d no variances: they do, and x̂ stays. */
static lqg_status_t recover(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state, int x_is_fit, int P_is_fit)
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

static lqg_status_t recover_from_update(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state)
{
    bounds_check_t check = {0, 0, 0};

    lqg_bounds_check_add(&check, state->x, kalman->x_scale, kalman->plant.nx);
    return recover(kalman, state, is_within_bounds(&check), 1);
}

/* Takes output i, y_i, into x̂, U and d, or leaves it out and says why. */
static lqg_status_t update_output(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state, unsigned i, lqg_real y_i,
                                  const gatekeeper_t *keeper)
{
    LQG_STRICT_BODY
    const unsigned nx = kalman->plant.nx;
    const lqg_real *c = kalman->plant.C + i * nx;
    const lqg_real V = kalman->V[i];
    lqg_real *U = state->U, *d = state->d, *f = state->work;

    const lqg_real measured = lqg_plant_innovation(&kalman->plant, i, state->x, state->u_applied, y_i);
    const int plausible = is_plausible(measured, kalman->innovation_limit, i);
    const lqg_real innovation = plausible ? measured : 0;
    lqg_status_t left_out = plausible ? LQG_OK : rejected(i);
    if (!plausible || !is_expected(keeper, i, innovation, V)) { /* s is V at least */
        lqg_factors_project(U, nx, c, 1, f);
        left_out |= lqg_gate_weigh(keeper, i, plausible, innovation, lqg_factors_variance(d, nx, f, V), 0);
    }

    /* f = Uᵀ cᵀ; with f = 0 the output is left out */
    lqg_factors_project(U, nx, c, !left_out, f);
    update_with_factors(state->x, U, d, nx, f, left_out ? 0 : innovation, V);
    return left_out;
}

lqg_status_t lqg_kalman_ud_update(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state, const lqg_real y[])
{
    return lqg_kalman_ud_partial_update(kalman, state, y, LQG_ALL_OUTPUTS, NULL);
}

lqg_status_t lqg_kalman_ud_partial_update(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state,
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

    return status | recover_from_update(kalman, state);
}

lqg_status_t lqg_kalman_ud_update_output(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state,
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
    return left_out | recover_from_update(kalman, state);
}

lqg_status_t lqg_kalman_ud_predict(const lqg_kalman_ud_t *kalman, lqg_kalman_ud_state_t *state, const lqg_real u[])
{
    check_contract(kalman, state);
    LQG_ASSERT((u || !kalman->plant.nu) && state->work);
    const unsigned nx = kalman->plant.nx;
    const lqg_real *A = kalman->M ? kalman->A_free : kalman->plant.A;
    bounds_check_t check = {0, 0, 0};

    lqg_plant_predict(&kalman->plant, kalman->M, state->x, state->u_applied, state->innovation, u, state->work);
    lqg_factors_predict(state->U, state->d, nx, A, kalman->plant.pattern, kalman->nw, kalman->G, kalman->W,
                        state->work);

    lqg_bounds_check_add(&check, state->x, kalman->x_scale, nx);
    const int x_is_fit = is_within_bounds(&check);
    add_factors(&check, state->U, state->d, kalman->x_scale, nx);
    return recover(kalman, state, x_is_fit, is_within_bounds(&check));
}

LQG_STRICT_END
