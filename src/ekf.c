/* SPDX-License-Identifier: MIT */
/* The extended Kalman filter with P = U diag(d) Uᵀ. */
#include "lqg/ekf.h"

#include "bounds_check.h"
#include "factors.h"
#include "plant.h"

LQG_STRICT_BEGIN

static void begin_covariance(const lqg_ekf_t *ekf, lqg_real U[], lqg_real d[])
{
    begin(U, ekf->U0, LQG_STRICT_TRIANGLE(ekf->nx));
    copy(d, ekf->d0, ekf->nx);
}

void lqg_ekf_init(const lqg_ekf_t *ekf, lqg_real x[], lqg_real U[], lqg_real d[])
{
    begin(x, ekf->x0, ekf->nx);
    begin_covariance(ekf, U, d);
}

/* x̂ not finite: all begins anew. U or d not finite, or d no variances: they do, and x̂ stays. `factors`: they are looked
 * at, too. */
static lqg_status recover(const lqg_ekf_t *ekf, int factors, lqg_real x[], lqg_real U[], lqg_real d[])
{
    bounds_check_t check = {0, 0, 0};

    add_finite(&check, x, ekf->nx);
    if (!is_within_bounds(&check)) {
        lqg_ekf_init(ekf, x, U, d);
        return LQG_STATE_RESET;
    }
    if (factors)
        add_factors(&check, U, d, NULL, ekf->nx);
    if (!is_within_bounds(&check)) {
        begin_covariance(ekf, U, d);
        return LQG_COVARIANCE_RESET;
    }
    return LQG_OK;
}

/* innovation = y − expected */
static void subtract(const lqg_ekf_t *ekf, lqg_real innovation[], const lqg_real y[],
                     const lqg_real expected[])
{
    LQG_STRICT_BODY
    if (ekf->subtract)
        ekf->subtract(ekf->context, innovation, y, expected);
    for (unsigned i = 0; !ekf->subtract && i < ekf->ny; i++)
        innovation[i] = y[i] - expected[i];
}

/* Takes output i with the row c of C into δ, U and d, or leaves it out and says why. f[nx] is scratch. */
static lqg_status update_output(const lqg_ekf_t *ekf, unsigned i, lqg_real delta[], lqg_real U[],
                                lqg_real d[], lqg_real innovation, const lqg_real c[],
                                const lqg_watch_t *watch, lqg_real f[])
{
    LQG_STRICT_BODY
    const unsigned nx = ekf->nx;

    /* ν = y_i − ŷ_i − c δ */
    const lqg_real difference = subtract_row_product(innovation, c, 0, nx, delta);
    lqg_status left_out = is_finite(add_all(difference, c, nx)) ? LQG_OK : LQG_OUTPUT_NOT_FINITE;
    if (left_out || !lqg_watch_expects(watch, i, difference, ekf->V[i])) { /* s is V at least */
        lqg_factors_project(U, nx, c, !left_out, f);
        left_out |= lqg_watch_output(watch, i, !left_out, left_out ? 0 : difference,
                                     lqg_factors_variance(d, nx, f, ekf->V[i]), 0);
    }
    const lqg_real nu = left_out ? 0 : difference;

    /* f = Uᵀ cᵀ; with f = 0 the output is left out */
    lqg_factors_project(U, nx, c, !left_out, f);
    update_with_factors(delta, U, d, nx, f, nu, ekf->V[i]);
    return left_out;
}

lqg_status lqg_ekf_update(const lqg_ekf_t *ekf, lqg_real x[], lqg_real U[], lqg_real d[], const lqg_real y[],
                          const lqg_real u[], const lqg_watch_t *watch, lqg_real work[])
{
    LQG_STRICT_BODY
    const unsigned nx = ekf->nx, ny = ekf->ny;
    lqg_real *expected = work, *innovation = work + ny, *C = innovation + ny;
    lqg_real *delta = C + ny * nx, *f = delta + nx;
    lqg_status status = LQG_OK;

    begin(C, NULL, ny * nx);
    begin(delta, NULL, nx);
    ekf->h(ekf->context, expected, C, x, u);
    subtract(ekf, innovation, y, expected);

    for (unsigned i = 0; i < ny; i++)
        if (lqg_watch_uses(watch, i))
            status |= update_output(ekf, i, delta, U, d, innovation[i], C + i * nx, watch, f);
        else
            lqg_watch_silence(watch, i, 0);

    for (unsigned j = 0; j < nx; j++)
        x[j] += delta[j];
    return status | recover(ekf, 0, x, U, d);
}

lqg_status lqg_ekf_predict(const lqg_ekf_t *ekf, lqg_real x[], lqg_real U[], lqg_real d[], const lqg_real u[],
                           lqg_real work[])
{
    const unsigned nx = ekf->nx;
    lqg_real *next = work, *A = next + nx, *scratch = A + nx * nx;

    begin(A, NULL, nx * nx);
    ekf->f(ekf->context, next, A, x, u);
    copy(x, next, nx);
    lqg_factors_predict(U, d, nx, A, ekf->nq, ekf->G, ekf->w, scratch);

    return recover(ekf, 1, x, U, d);
}

LQG_STRICT_END
