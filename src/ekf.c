/* SPDX-License-Identifier: MIT */
/* The extended Kalman filter with P = U diag(d) Uᵀ. */
#include "lqg/ekf.h"

#include "bounds_check.h"
#include "factors.h"
#include "gate.h"

LQG_STRICT_BEGIN

static void check_contract(const lqg_ekf_t *ekf, const lqg_ekf_state_t *state)
{
    (void)ekf;
    (void)state;
    LQG_ASSERT(ekf && state);
    LQG_ASSERT(ekf->nx >= 1 && ekf->ny >= 1 && ekf->f && ekf->h);
    LQG_ASSERT(ekf->V && ekf->d0 && (!ekf->nw || (ekf->G && ekf->W)));
    LQG_ASSERT(state->x && state->d && (ekf->nx == 1 || state->U));
    check_gate(ekf->gate, &state->gate);
}

static void begin_covariance(const lqg_ekf_t *ekf, lqg_ekf_state_t *state)
{
    lqg_begin(state->U, ekf->U0, LQG_STRICT_TRIANGLE(ekf->nx));
    copy(state->d, ekf->d0, ekf->nx);
}

static void begin_estimate(const lqg_ekf_t *ekf, lqg_ekf_state_t *state)
{
    lqg_begin(state->x, ekf->x0, ekf->nx);
    begin_widening(ekf->gate, &state->gate, ekf->ny);
    begin_covariance(ekf, state);
}

void lqg_ekf_init(const lqg_ekf_t *ekf, lqg_ekf_state_t *state)
{
    check_contract(ekf, state);
    begin_estimate(ekf, state);
}

/* x̂ not finite: all begins anew. U or d not finite, or d no variances: they do, and x̂ stays. `factors`: they are
 * checked, too. */
static lqg_status_t recover(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, int factors)
{
    bounds_check_t check = {0, 0, 0};

    add_finite(&check, state->x, ekf->nx);
    if (!is_within_bounds(&check)) {
        begin_estimate(ekf, state);
        return LQG_STATE_RESET;
    }
    if (factors)
        add_factors(&check, state->U, state->d, NULL, ekf->nx);
    if (!is_within_bounds(&check)) {
        begin_covariance(ekf, state);
        return LQG_COVARIANCE_RESET;
    }
    return LQG_OK;
}

/* innovation = y − expected */
static void subtract(const lqg_ekf_t *ekf, lqg_real innovation[], const lqg_real y[], const lqg_real expected[])
{
    LQG_STRICT_BODY
    if (ekf->subtract)
        ekf->subtract(ekf->context, innovation, y, expected);
    for (unsigned i = 0; !ekf->subtract && i < ekf->ny; i++)
        innovation[i] = y[i] - expected[i];
}

/* Takes output i with the row c of C into δ, U and d, or leaves it out and says why. f[nx] is scratch. */
static lqg_status_t update_output(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, unsigned i, lqg_real delta[],
                                  lqg_real innovation, const lqg_real c[], const gatekeeper_t *keeper, lqg_real f[])
{
    LQG_STRICT_BODY
    const unsigned nx = ekf->nx;
    const lqg_real V = ekf->V[i];

    /* y_i − ŷ_i − c δ */
    const lqg_real difference = subtract_row_product(innovation, c, 0, nx, delta);
    const int plausible = is_finite(add_all(difference, c, nx));
    lqg_status_t left_out = plausible ? LQG_OK : rejected(i);
    if (!plausible || !is_expected(keeper, i, difference, V)) { /* s is V at least */
        lqg_factors_project(state->U, nx, c, plausible, f);
        left_out |= lqg_gate_weigh(keeper, i, plausible, plausible ? difference : 0,
                                   lqg_factors_variance(state->d, nx, f, V), 0);
    }

    /* f = Uᵀ cᵀ; with f = 0 the output is left out */
    lqg_factors_project(state->U, nx, c, !left_out, f);
    update_with_factors(delta, state->U, state->d, nx, f, left_out ? 0 : difference, V);
    return left_out;
}

lqg_status_t lqg_ekf_update(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, const lqg_real y[], const lqg_real u[])
{
    return lqg_ekf_partial_update(ekf, state, y, u, LQG_ALL_OUTPUTS, NULL);
}

lqg_status_t lqg_ekf_partial_update(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, const lqg_real y[],
                                    const lqg_real u[], unsigned long used, const lqg_watch_t *watch)
{
    LQG_STRICT_BODY
    check_contract(ekf, state);
    LQG_ASSERT(y && state->work);
    const unsigned nx = ekf->nx, ny = ekf->ny;
    const gatekeeper_t keeper = {ekf->gate, &state->gate, watch};
    lqg_real *expected = state->work, *innovation = expected + ny, *C = innovation + ny;
    lqg_real *delta = C + ny * nx, *f = delta + nx;
    lqg_status_t status = LQG_OK;

    lqg_begin(C, NULL, ny * nx);
    lqg_begin(delta, NULL, nx);
    ekf->h(ekf->context, expected, C, state->x, u);
    subtract(ekf, innovation, y, expected);

    for (unsigned i = 0; i < ny; i++) {
        if (used & 1uL)
            status |= update_output(ekf, state, i, delta, innovation[i], C + i * nx, &keeper, f);
        else
            skip(&keeper, i, 0);
        used = after_lowest(used);
    }

    for (unsigned j = 0; j < nx; j++)
        state->x[j] += delta[j];
    return status | recover(ekf, state, 0);
}

lqg_status_t lqg_ekf_predict(const lqg_ekf_t *ekf, lqg_ekf_state_t *state, const lqg_real u[])
{
    check_contract(ekf, state);
    LQG_ASSERT(state->work);
    const unsigned nx = ekf->nx;
    lqg_real *next = state->work, *A = next + nx, *scratch = A + nx * nx;

    lqg_begin(A, NULL, nx * nx);
    ekf->f(ekf->context, next, A, state->x, u);
    copy(state->x, next, nx);
    lqg_factors_predict(state->U, state->d, nx, A, NULL, ekf->nw, ekf->G, ekf->W, scratch);

    return recover(ekf, state, 1);
}

LQG_STRICT_END
