/* SPDX-License-Identifier: MIT */
/* Filter and regulator together, one sample at a time. */
#include "lqg/lqg.h"

#include "kernel.h"

/* u = −K x̂, which is from now on the input that acts. */
static lqg_status control(const lqg_lqr_t *lqr, const lqg_real x[], lqg_real u_applied[], lqg_real u[])
{
    const lqg_status status = lqg_lqr_control(lqr, x, u);
    if (u_applied)
        copy(u_applied, u, lqr->nu);
    return status;
}

lqg_status lqg_lqg_steady_step(const lqg_lqg_steady_t *loop, lqg_real x[], lqg_real u_applied[],
                               lqg_real innovation[], const lqg_real y[], lqg_real u[], lqg_real work[])
{
    const lqg_kalman_steady_t *kalman = &loop->kalman;
    const int predictor = loop->form == LQG_PREDICTOR_FORM;

    lqg_status status = predictor ? control(&loop->lqr, x, u_applied, u) : LQG_OK;
    status |= lqg_kalman_steady_update(kalman, x, u_applied, innovation, y, work);
    status |= predictor ? LQG_OK : control(&loop->lqr, x, u_applied, u);
    return status | lqg_kalman_steady_predict(kalman, x, u_applied, innovation, u, work);
}

lqg_status lqg_lqg_plain_step(const lqg_lqg_plain_t *loop, lqg_real x[], lqg_real P[], lqg_real u_applied[],
                              lqg_real innovation[], const lqg_real y[], lqg_real u[], lqg_real work[])
{
    const lqg_kalman_plain_t *kalman = &loop->kalman;
    const int predictor = loop->form == LQG_PREDICTOR_FORM;

    lqg_status status = predictor ? control(&loop->lqr, x, u_applied, u) : LQG_OK;
    status |= lqg_kalman_plain_update(kalman, x, P, u_applied, innovation, y, work);
    status |= predictor ? LQG_OK : control(&loop->lqr, x, u_applied, u);
    return status | lqg_kalman_plain_predict(kalman, x, P, u_applied, innovation, u, work);
}

lqg_status lqg_lqg_ud_step(const lqg_lqg_ud_t *loop, lqg_real x[], lqg_real U[], lqg_real d[],
                           lqg_real u_applied[], lqg_real innovation[], const lqg_real y[], lqg_real u[],
                           lqg_real work[])
{
    const lqg_kalman_ud_t *kalman = &loop->kalman;
    const int predictor = loop->form == LQG_PREDICTOR_FORM;

    lqg_status status = predictor ? control(&loop->lqr, x, u_applied, u) : LQG_OK;
    status |= lqg_kalman_ud_update(kalman, x, U, d, u_applied, innovation, y, work);
    status |= predictor ? LQG_OK : control(&loop->lqr, x, u_applied, u);
    return status | lqg_kalman_ud_predict(kalman, x, U, d, u_applied, innovation, u, work);
}
