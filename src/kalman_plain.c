/* SPDX-License-Identifier: MIT */
/* The Kalman filter that carries the covariance P of its error, as a lower triangle. */
#include "bounds_check.h"
#include "kernel.h"
#include "plant.h"

LQG_STRICT_BEGIN

void lqg_kalman_plain_init(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[], lqg_real u_applied[],
                           lqg_real innovation[])
{
    lqg_plant_begin(&kalman->plant, kalman->x0, x, u_applied, innovation);
    copy(P, kalman->P0, LQG_TRIANGLE(kalman->plant.nx));
}

/* x̂ not within its bounds: all begins anew. P not within its own, or no covariance: P does, and x̂ stays. */
static lqg_status recover(const lqg_kalman_plain_t *kalman, int x_is_fit, int P_is_fit, lqg_real x[], lqg_real P[],
                          lqg_real u_applied[], lqg_real innovation[])
{
    if (!x_is_fit) {
        lqg_kalman_plain_init(kalman, x, P, u_applied, innovation);
        return LQG_STATE_RESET;
    }
    if (!P_is_fit) {
        copy(P, kalman->P0, LQG_TRIANGLE(kalman->plant.nx));
        return LQG_COVARIANCE_RESET;
    }
    return LQG_OK;
}

/* After an update: of a covariance the variance of an innovation is V at least. */
static lqg_status recover_from_update(const lqg_kalman_plain_t *kalman, lqg_status status, lqg_real x[], lqg_real P[],
                                      lqg_real u_applied[], lqg_real innovation[])
{
    bounds_check_t check = {0, 0, 0};
    const int P_is_fit = !(status & LQG_INNOVATION_NOT_POSITIVE);

    lqg_bounds_check_add(&check, x, kalman->x_scale, kalman->plant.nx);
    return status | recover(kalman, is_within_bounds(&check), P_is_fit, x, P, u_applied, innovation);
}

/* Σ_k P_jk v_k: along row j of the triangle as far as the diagonal, then down column j. */
static lqg_real symmetric_row_product(const lqg_real P[], unsigned j, unsigned nx, const lqg_real v[])
{
    LQG_STRICT_BODY
    lqg_real sum = 0;
    unsigned at = LQG_TRIANGLE(j);

    for (unsigned k = 0; k < nx; k++) {
        sum = multiply_add(P[at], v[k], sum);
        at += k < j ? 1 : k + 1;
    }
    return sum;
}

/* Takes output i, y_i, into x̂ and P, or leaves it out and says why. f[nx] is scratch. */
static lqg_status update_output(const lqg_kalman_plain_t *kalman, unsigned i, lqg_real x[], lqg_real P[],
                                const lqg_real u_applied[], lqg_real y_i, const lqg_watch_t *watch,
                                lqg_real f[])
{
    LQG_STRICT_BODY
    const unsigned nx = kalman->plant.nx;
    const lqg_real *c = kalman->plant.C + i * nx;

    /* f = P cᵀ,  s = c P cᵀ + v */
    for (unsigned j = 0; j < nx; j++)
        f[j] = symmetric_row_product(P, j, nx, c);
    const lqg_real s = add_row_product(kalman->V[i], c, 0, nx, f);

    const lqg_real measured = lqg_plant_innovation(&kalman->plant, i, x, u_applied, y_i);
    const int believable = is_believable(measured, kalman->innovation_limit, i);
    const lqg_real innovation = believable ? measured : 0;
    const lqg_status left_out = !believable ? LQG_OUTPUT_NOT_FINITE
                                : !(s > 0)  ? LQG_INNOVATION_NOT_POSITIVE
                                            : LQG_OK;
    const lqg_status watched = !left_out && lqg_watch_expects(watch, i, innovation, s)
                                   ? LQG_OK
                                   : lqg_watch_output(watch, i, !left_out, innovation, s, 0);
    const int usable = !left_out && !watched;
    const lqg_real nu = usable ? innovation : 0;
    const lqg_real inverse = usable ? 1 / s : 0;

    /* gain = f / s,  x̂ ← x̂ + gain ν,  P ← P − gain fᵀ */
    for (unsigned j = 0; j < nx; j++) {
        const lqg_real gain = f[j] * inverse;
        x[j] = multiply_add(gain, nu, x[j]);
        for (unsigned l = 0; l <= j; l++)
            P[LQG_TRIANGLE(j) + l] = multiply_subtract(gain, f[l], P[LQG_TRIANGLE(j) + l]);
    }
    return left_out ? left_out : watched;
}

lqg_status lqg_kalman_plain_update(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                   lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                   lqg_real work[])
{
    return lqg_kalman_plain_update_watched(kalman, x, P, u_applied, innovation, y, NULL, work);
}

lqg_status lqg_kalman_plain_update_watched(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                           lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                           const lqg_watch_t *watch, lqg_real work[])
{
    const lqg_plant_t *plant = &kalman->plant;
    lqg_real *outputs = work + plant->nx;
    lqg_status status = LQG_OK;

    for (unsigned i = 0; i < plant->ny; i++) {
        const int used = lqg_watch_uses(watch, i);
        outputs[i] = lqg_plant_decorrelate(plant, kalman->E, i, y, outputs);
        const lqg_status left_out =
            used ? update_output(kalman, i, x, P, u_applied, outputs[i], watch, work) : LQG_OK;
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

    return recover_from_update(kalman, status, x, P, u_applied, innovation);
}

lqg_status lqg_kalman_plain_update_output(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                          lqg_real u_applied[], lqg_real innovation[], unsigned i,
                                          lqg_real y_i, const lqg_watch_t *watch, lqg_real work[])
{
    const lqg_plant_t *plant = &kalman->plant;
    const lqg_real alone = lqg_plant_decorrelate_alone(plant, kalman->E, i, y_i);

    const lqg_status left_out = update_output(kalman, i, x, P, u_applied, alone, watch, work);
    if (kalman->M)
        innovation[i] = left_out ? 0 : lqg_plant_innovation(plant, i, x, u_applied, alone);
    return recover_from_update(kalman, left_out, x, P, u_applied, innovation);
}

/* P ← A P Aᵀ + W. AP[nx × nx] is scratch. */
static void predict_covariance(const lqg_kalman_plain_t *kalman, lqg_real P[], lqg_real AP[])
{
    const unsigned nx = kalman->plant.nx;
    const lqg_real *A = kalman->M ? kalman->A_free : kalman->plant.A;

    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j < nx; j++)
            AP[i * nx + j] = symmetric_row_product(P, j, nx, A + i * nx);

    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j <= i; j++)
            P[LQG_TRIANGLE(i) + j] = add_row_product(kalman->W[LQG_TRIANGLE(i) + j], AP, i, nx, A + j * nx);
}

lqg_status lqg_kalman_plain_predict(const lqg_kalman_plain_t *kalman, lqg_real x[], lqg_real P[],
                                    lqg_real u_applied[], lqg_real innovation[], const lqg_real u[],
                                    lqg_real work[])
{
    bounds_check_t check = {0, 0, 0};

    lqg_plant_predict(&kalman->plant, kalman->M, x, u_applied, innovation, u, work);
    predict_covariance(kalman, P, work);

    lqg_bounds_check_add(&check, x, kalman->x_scale, kalman->plant.nx);
    const int x_is_fit = is_within_bounds(&check);
    for (unsigned i = 0; i < kalman->plant.nx; i++) /* |P_ij| ≤ √(P_ii P_jj) */
        add_variance(&check, P[LQG_TRIANGLE(i) + i], kalman->x_scale, i);
    return recover(kalman, x_is_fit, is_within_bounds(&check), x, P, u_applied, innovation);
}

LQG_STRICT_END
