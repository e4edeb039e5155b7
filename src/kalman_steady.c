/* SPDX-License-Identifier: MIT */
/* The Kalman filter with constant gain. */
#include "bounds_check.h"
#include "kernel.h"
#include "plant.h"

LQG_STRICT_BEGIN

void lqg_kalman_steady_init(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                            lqg_real innovation[])
{
    lqg_plant_begin(&kalman->plant, kalman->x0, x, u_applied, innovation);
}

static lqg_status reset_unless_bounded(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                       lqg_real innovation[])
{
    bounds_check_t check = {0, 0, 0};

    lqg_bounds_check_add(&check, x, kalman->x_scale, kalman->plant.nx);
    if (is_within_bounds(&check))
        return LQG_OK;

    lqg_kalman_steady_init(kalman, x, u_applied, innovation);
    return LQG_STATE_RESET;
}

/* y_i − C_i x̂ − D_i u, 0 where output i is left out: it is treated as an innovation of 0. */
static lqg_real innovate(const lqg_kalman_steady_t *kalman, unsigned i, const lqg_real x[],
                         const lqg_real u_applied[], lqg_real y_i, const lqg_real s[], const lqg_watch_t *watch,
                         lqg_status *status)
{
    const lqg_real measured = lqg_plant_innovation(&kalman->plant, i, x, u_applied, y_i);
    const int believable = is_believable(measured, kalman->innovation_limit, i);
    const lqg_real nu = believable ? measured : 0;
    const lqg_real variance = s ? s[i] : 0;
    lqg_status left_out = believable ? LQG_OK : LQG_OUTPUT_NOT_FINITE;

    if (!believable || !lqg_watch_expects(watch, i, nu, variance))
        left_out |= lqg_watch_output(watch, i, believable, nu, variance, 1);

    *status |= left_out;
    return left_out ? 0 : nu;
}

lqg_status lqg_kalman_steady_update(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                    lqg_real innovation[], const lqg_real y[], lqg_real work[])
{
    return lqg_kalman_steady_update_watched(kalman, x, u_applied, innovation, y, NULL, NULL, work);
}

lqg_status lqg_kalman_steady_update_watched(const lqg_kalman_steady_t *kalman, lqg_real x[],
                                            lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                            const lqg_real s[], const lqg_watch_t *watch, lqg_real work[])
{
    const lqg_plant_t *plant = &kalman->plant;
    lqg_real *nu = kalman->M ? innovation : work; /* predict needs them only for M */
    lqg_status status = LQG_OK;

    for (unsigned i = 0; i < plant->ny; i++) {
        nu[i] = 0;
        if (lqg_watch_uses(watch, i))
            nu[i] = innovate(kalman, i, x, u_applied, y[i], s, watch, &status);
        else
            lqg_watch_silence(watch, i, 1);
    }

    /* x̂ ← x̂ + L innovation */
    for (unsigned j = 0; j < plant->nx; j++)
        x[j] = add_row_product(x[j], kalman->L, j, plant->ny, nu);

    return status | reset_unless_bounded(kalman, x, u_applied, innovation);
}

lqg_status lqg_kalman_steady_update_output(const lqg_kalman_steady_t *kalman, lqg_real x[],
                                           lqg_real u_applied[], lqg_real innovation[], unsigned i,
                                           lqg_real y_i, const lqg_real s[], const lqg_watch_t *watch)
{
    const lqg_plant_t *plant = &kalman->plant;
    lqg_status status = LQG_OK;
    const lqg_real nu = innovate(kalman, i, x, u_applied, y_i, s, watch, &status);

    for (unsigned j = 0; j < plant->nx; j++)
        x[j] = multiply_add(kalman->L[j * plant->ny + i], nu, x[j]);
    if (kalman->M)
        innovation[i] = nu;

    return status | reset_unless_bounded(kalman, x, u_applied, innovation);
}

lqg_status lqg_kalman_steady_predict(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                     lqg_real innovation[], const lqg_real u[], lqg_real work[])
{
    lqg_plant_predict(&kalman->plant, kalman->M, x, u_applied, innovation, u, work);
    return reset_unless_bounded(kalman, x, u_applied, innovation);
}

LQG_STRICT_END
