/* SPDX-License-Identifier: MIT */
/* Filter and regulator together, one sample at a time. */
#include "lqg/loop.h"

#include "kernel.h"

/* What holds for all three: the regulator is one for the filter's plant. */
static void check_contract(const lqg_plant_t *plant, const lqg_lqr_t *lqr, const lqg_real u[])
{
    (void)plant;
    (void)lqr;
    (void)u;
    LQG_ASSERT(lqr->nx == plant->nx && lqr->nu == plant->nu && u);
}

/* u = −K x̂, which is from now on the input that acts. */
static lqg_status_t control(const lqg_lqr_t *lqr, const lqg_real x[], lqg_real u_applied[], lqg_real u[])
{
    const lqg_status_t status = lqg_lqr_control(lqr, x, u);
    if (u_applied)
        copy(u_applied, u, lqr->nu);
    return status;
}

void lqg_loop_steady_init(const lqg_loop_steady_t *loop, lqg_loop_steady_state_t *state)
{
    check_contract(&loop->kalman.plant, &loop->lqr, state->u);
    lqg_kalman_steady_init(&loop->kalman, &state->kalman);
    lqg_begin(state->u, NULL, loop->lqr.nu);
}

lqg_status_t lqg_loop_steady_step(const lqg_loop_steady_t *loop, lqg_loop_steady_state_t *state, const lqg_real y[])
{
    check_contract(&loop->kalman.plant, &loop->lqr, state->u);
    lqg_kalman_steady_state_t *kalman = &state->kalman;
    const int predictor = loop->form == LQG_PREDICTOR_FORM;

    lqg_status_t status = predictor ? control(&loop->lqr, kalman->x, kalman->u_applied, state->u) : LQG_OK;
    status |= lqg_kalman_steady_update(&loop->kalman, kalman, y);
    status |= predictor ? LQG_OK : control(&loop->lqr, kalman->x, kalman->u_applied, state->u);
    return status | lqg_kalman_steady_predict(&loop->kalman, kalman, state->u);
}

void lqg_loop_plain_init(const lqg_loop_plain_t *loop, lqg_loop_plain_state_t *state)
{
    check_contract(&loop->kalman.plant, &loop->lqr, state->u);
    lqg_kalman_plain_init(&loop->kalman, &state->kalman);
    lqg_begin(state->u, NULL, loop->lqr.nu);
}

lqg_status_t lqg_loop_plain_step(const lqg_loop_plain_t *loop, lqg_loop_plain_state_t *state, const lqg_real y[])
{
    check_contract(&loop->kalman.plant, &loop->lqr, state->u);
    lqg_kalman_plain_state_t *kalman = &state->kalman;
    const int predictor = loop->form == LQG_PREDICTOR_FORM;

    lqg_status_t status = predictor ? control(&loop->lqr, kalman->x, kalman->u_applied, state->u) : LQG_OK;
    status |= lqg_kalman_plain_update(&loop->kalman, kalman, y);
    status |= predictor ? LQG_OK : control(&loop->lqr, kalman->x, kalman->u_applied, state->u);
    return status | lqg_kalman_plain_predict(&loop->kalman, kalman, state->u);
}

void lqg_loop_ud_init(const lqg_loop_ud_t *loop, lqg_loop_ud_state_t *state)
{
    check_contract(&loop->kalman.plant, &loop->lqr, state->u);
    lqg_kalman_ud_init(&loop->kalman, &state->kalman);
    lqg_begin(state->u, NULL, loop->lqr.nu);
}

lqg_status_t lqg_loop_ud_step(const lqg_loop_ud_t *loop, lqg_loop_ud_state_t *state, const lqg_real y[])
{
    check_contract(&loop->kalman.plant, &loop->lqr, state->u);
    lqg_kalman_ud_state_t *kalman = &state->kalman;
    const int predictor = loop->form == LQG_PREDICTOR_FORM;

    lqg_status_t status = predictor ? control(&loop->lqr, kalman->x, kalman->u_applied, state->u) : LQG_OK;
    status |= lqg_kalman_ud_update(&loop->kalman, kalman, y);
    status |= predictor ? LQG_OK : control(&loop->lqr, kalman->x, kalman->u_applied, state->u);
    return status | lqg_kalman_ud_predict(&loop->kalman, kalman, state->u);
}
