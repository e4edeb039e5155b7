/* SPDX-License-Identifier: MIT */
/* Recursive least squares with P = U diag(d) Uᵀ. */
#include "lqg/rls.h"

#include "bounds_check.h"
#include "factors.h"

LQG_STRICT_BEGIN

static void check_contract(const lqg_rls_t *rls, const lqg_rls_state_t *state)
{
    (void)rls;
    (void)state;
    LQG_ASSERT(rls && state);
    LQG_ASSERT(rls->ntheta >= 1 && rls->P0_diagonal && rls->V > 0);
    LQG_ASSERT(rls->forgetting > 0 && rls->forgetting <= 1);
    LQG_ASSERT(state->theta && state->d && (rls->ntheta == 1 || state->U));
}

static void begin_covariance(const lqg_rls_t *rls, lqg_rls_state_t *state)
{
    lqg_begin(state->U, NULL, LQG_STRICT_TRIANGLE(rls->ntheta));
    for (unsigned i = 0; i < rls->ntheta; i++) {
        const lqg_real wanted = rls->P0_diagonal[i];
        state->d[i] = rls->P_limits && wanted > rls->P_limits[i] ? rls->P_limits[i] : wanted;
    }
}

void lqg_rls_init(const lqg_rls_t *rls, lqg_rls_state_t *state)
{
    check_contract(rls, state);
    lqg_begin(state->theta, rls->theta0, rls->ntheta);
    begin_covariance(rls, state);
}

/* P_ii = d_i + Σ_{j>i} d_j U_ij² */
static lqg_real variance_of(const lqg_real U[], const lqg_real d[], unsigned ntheta, unsigned i)
{
    LQG_STRICT_BODY
    lqg_real sum = d[i];
    for (unsigned j = i + 1; j < ntheta; j++) {
        const lqg_real U_ij = U[LQG_STRICT_TRIANGLE(j) + i];
        sum = multiply_add(d[j] * U_ij, U_ij, sum);
    }
    return sum;
}

/* U diag(d) Uᵀ ← Σ U diag(d) Uᵀ Σ: U_ij ← U_ij Σ_i/Σ_j, d_i ← d_i Σ_i², with Σ_i = 2/(1 + P_ii/limit_i) where
 * P_ii is above its limit and otherwise 1; where not wanted, Σ = I. scale[ntheta] is scratch. */
static void limit_variances(const lqg_rls_t *rls, lqg_real U[], lqg_real d[], int wanted, lqg_real scale[])
{
    LQG_STRICT_BODY
    for (unsigned i = 0; i < rls->ntheta; i++) {
        const lqg_real P_ii = variance_of(U, d, rls->ntheta, i), limit = rls->P_limits[i];
        const lqg_real within = 2 * limit / (limit + P_ii);
        scale[i] = wanted && P_ii > limit ? within : 1;
    }
    for (unsigned j = 0; j < rls->ntheta; j++) {
        d[j] = d[j] * (scale[j] * scale[j]);
        for (unsigned i = 0; i < j; i++)
            U[LQG_STRICT_TRIANGLE(j) + i] *= scale[i] / scale[j];
    }
}

/* θ not finite: all begins anew. U or d not finite, or d no variances: they do, and θ stays. */
static lqg_status_t recover(const lqg_rls_t *rls, lqg_rls_state_t *state)
{
    bounds_check_t check = {0, 0, 0};

    add_finite(&check, state->theta, rls->ntheta);
    if (!is_within_bounds(&check)) {
        lqg_rls_init(rls, state);
        return LQG_STATE_RESET;
    }
    add_factors(&check, state->U, state->d, NULL, rls->ntheta);
    if (!is_within_bounds(&check)) {
        begin_covariance(rls, state);
        return LQG_COVARIANCE_RESET;
    }
    return LQG_OK;
}

lqg_status_t lqg_rls_update(const lqg_rls_t *rls, lqg_rls_state_t *state, lqg_real y, const lqg_real phi[])
{
    LQG_STRICT_BODY
    check_contract(rls, state);
    LQG_ASSERT(phi && state->work);
    const unsigned ntheta = rls->ntheta;
    const lqg_real v = rls->forgetting * rls->V;
    lqg_real *theta = state->theta, *U = state->U, *d = state->d, *f = state->work;

    /* f = Uᵀ φ,  s = λV + φᵀ P φ; with f = 0 the sample is left out */
    lqg_factors_project(U, ntheta, phi, 1, f);
    const lqg_real error = subtract_row_product(y, phi, 0, ntheta, theta);
    const int usable = is_finite(error) && is_finite(lqg_factors_variance(d, ntheta, f, v));
    const lqg_real innovation = usable ? error : 0, lambda = usable ? rls->forgetting : 1;
    lqg_factors_project(U, ntheta, phi, usable, f);

    /* gain = P φ/s,  θ ← θ + gain (y − φᵀ θ),  P ← (P − gain (P φ)ᵀ)/λ */
    const lqg_real inverse = lqg_factors_update(U, d, ntheta, f, v);
    for (unsigned i = 0; i < ntheta; i++) {
        theta[i] = multiply_add(f[i] * inverse, innovation, theta[i]);
        d[i] = d[i] / lambda;
    }
    if (rls->P_limits)
        limit_variances(rls, U, d, usable, f);

    return (usable ? LQG_OK : LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0)) | recover(rls, state);
}

LQG_STRICT_END
