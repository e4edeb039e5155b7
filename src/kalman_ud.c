/* SPDX-License-Identifier: MIT */
/* The Kalman filter that carries its covariance as P = U diag(d) Uᵀ, U unit upper triangular. */
#include "bounds_check.h"
#include "factors.h"
#include "plant.h"

LQG_STRICT_BEGIN

void lqg_kalman_ud_init(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                        lqg_real u_applied[], lqg_real innovation[])
{
    const unsigned nx = kalman->plant.nx;

    lqg_plant_begin(&kalman->plant, kalman->x0, x, u_applied, innovation);
    copy(U, kalman->U0, LQG_STRICT_TRIANGLE(nx));
    copy(d, kalman->d0, nx);
}

/* x̂ not within its bounds: all begins anew. U or d not within theirs, or d no variances: they do, and x̂ stays. */
static lqg_status recover(const lqg_kalman_ud_t *kalman, int x_is_fit, int P_is_fit, lqg_real x[], lqg_real U[],
                          lqg_real d[], lqg_real u_applied[], lqg_real innovation[])
{
    if (!x_is_fit) {
        lqg_kalman_ud_init(kalman, x, U, d, u_applied, innovation);
        return LQG_STATE_RESET;
    }
    if (!P_is_fit) {
        copy(U, kalman->U0, LQG_STRICT_TRIANGLE(kalman->plant.nx));
        copy(d, kalman->d0, kalman->plant.nx);
        return LQG_COVARIANCE_RESET;
    }
    return LQG_OK;
}

static lqg_status recover_from_update(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                                      lqg_real u_applied[], lqg_real innovation[])
{
    bounds_check_t check = {0, 0, 0};

    lqg_bounds_check_add(&check, x, kalman->x_scale, kalman->plant.nx);
    return recover(kalman, is_within_bounds(&check), 1, x, U, d, u_applied, innovation);
}

/* Takes output i, y_i, into x̂, U and d, or leaves it out and says why. f[nx] is scratch. */
static lqg_status update_output(const lqg_kalman_ud_t *kalman, unsigned i, lqg_real x[], lqg_real U[],
                                lqg_real d[], const lqg_real u_applied[], lqg_real y_i,
                                const lqg_watch_t *watch, lqg_real f[])
{
    LQG_STRICT_BODY
    const unsigned nx = kalman->plant.nx;
    const lqg_real *c = kalman->plant.C + i * nx;

    const lqg_real measured = lqg_plant_innovation(&kalman->plant, i, x, u_applied, y_i);
    const int believable = is_believable(measured, kalman->innovation_limit, i);
    const lqg_real innovation = believable ? measured : 0;
    lqg_status left_out = believable ? LQG_OK : LQG_OUTPUT_NOT_FINITE;
    if (!believable || !lqg_watch_expects(watch, i, innovation, kalman->V[i])) { /* s is V at least */
        lqg_factors_project(U, nx, c, 1, f);
        left_out |= lqg_watch_output(watch, i, believable, innovation, lqg_factors_variance(d, nx, f, kalman->V[i]), 0);
    }
    const lqg_real nu = left_out ? 0 : innovation;

    /* f = Uᵀ cᵀ; with f = 0 the output is left out */
    lqg_factors_project(U, nx, c, !left_out, f);
    update_with_factors(x, U, d, nx, f, nu, kalman->V[i]);
    return left_out;
}

lqg_status lqg_kalman_ud_update(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                                lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                lqg_real work[])
{
    return lqg_kalman_ud_update_watched(kalman, x, U, d, u_applied, innovation, y, NULL, work);
}

lqg_status lqg_kalman_ud_update_watched(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[],
                                        lqg_real d[], lqg_real u_applied[], lqg_real innovation[],
                                        const lqg_real y[], const lqg_watch_t *watch, lqg_real work[])
{
    const lqg_plant_t *plant = &kalman->plant;
    lqg_real *outputs = work + plant->nx;
    lqg_status status = LQG_OK;

    for (unsigned i = 0; i < plant->ny; i++) {
        const int used = lqg_watch_uses(watch, i);
        outputs[i] = lqg_plant_decorrelate(plant, kalman->E, i, y, outputs);
        const lqg_status left_out =
            used ? update_output(kalman, i, x, U, d, u_applied, outputs[i], watch, work) : LQG_OK;
        const int heard = used && !left_out;
        if (!used)
            lqg_watch_silence(watch, i, 0);
        status |= left_out;
        if (kalman->M)
            innovation[i] = heard ? 1 : 0;
        if (!heard) /* nor by way of another output */
            outputs[i] = (lqg_real)NAN;
    }
    if (kalman->M)
        lqg_plant_keep_residuals(plant, x, u_applied, outputs, innovation);

    return status | recover_from_update(kalman, x, U, d, u_applied, innovation);
}

lqg_status lqg_kalman_ud_update_output(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[],
                                       lqg_real d[], lqg_real u_applied[], lqg_real innovation[], unsigned i,
                                       lqg_real y_i, const lqg_watch_t *watch, lqg_real work[])
{
    const lqg_plant_t *plant = &kalman->plant;
    const lqg_real alone = lqg_plant_decorrelate_alone(plant, kalman->E, i, y_i);

    const lqg_status left_out = update_output(kalman, i, x, U, d, u_applied, alone, watch, work);
    if (kalman->M)
        innovation[i] = left_out ? 0 : lqg_plant_innovation(plant, i, x, u_applied, alone);
    return left_out | recover_from_update(kalman, x, U, d, u_applied, innovation);
}

lqg_status lqg_kalman_ud_predict(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                                 lqg_real u_applied[], lqg_real innovation[], const lqg_real u[],
                                 lqg_real work[])
{
    const unsigned nx = kalman->plant.nx;
    const lqg_real *A = kalman->M ? kalman->A_free : kalman->plant.A;
    bounds_check_t check = {0, 0, 0};

    lqg_plant_predict(&kalman->plant, kalman->M, x, u_applied, innovation, u, work);
    lqg_factors_predict(U, d, nx, A, kalman->nq, kalman->G, kalman->w, work);

    lqg_bounds_check_add(&check, x, kalman->x_scale, nx);
    const int x_is_fit = is_within_bounds(&check);
    add_factors(&check, U, d, kalman->x_scale, nx);
    return recover(kalman, x_is_fit, is_within_bounds(&check), x, U, d, u_applied, innovation);
}

LQG_STRICT_END
