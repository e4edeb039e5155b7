/* SPDX-License-Identifier: MIT */
/* The control law with a memory. */
#include "lqg/servo.h"

#include "bounds_check.h"

LQG_STRICT_BEGIN

static void check_contract(const lqg_servo_t *servo, const lqg_servo_state_t *state)
{
    (void)servo;
    (void)state;
    LQG_ASSERT(servo && state);
    LQG_ASSERT(servo->nx >= 1 && servo->nu >= 1 && servo->K && (state->r || !servo->nr));
    LQG_ASSERT(!servo->nxi || (servo->H && servo->output && servo->reference));
    LQG_ASSERT(!servo->nxi || (state->xi && state->error && state->demand));
    LQG_ASSERT(state->u_applied || (!servo->gives_change && !servo->u_step));
}

/* All but r. */
static void begin_memory(const lqg_servo_t *servo, lqg_servo_state_t *state)
{
    lqg_begin(state->xi, NULL, servo->nxi);
    lqg_begin(state->error, NULL, servo->nxi);
    lqg_begin(state->demand, NULL, servo->nu);
    lqg_begin(state->u_applied, NULL, servo->nu);
}

void lqg_servo_init(const lqg_servo_t *servo, lqg_servo_state_t *state)
{
    check_contract(servo, state);
    lqg_begin(state->r, NULL, servo->nr);
    begin_memory(servo, state);
}

void lqg_servo_observe(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real y[])
{
    LQG_STRICT_BODY
    check_contract(servo, state);
    LQG_ASSERT(y);
    for (unsigned i = 0; i < servo->nxi; i++) {
        const lqg_real left = state->r[servo->reference[i]] - y[servo->output[i]];
        state->error[i] = is_plausible(left, servo->error_limit, i) ? left : 0;
    }
}

/* v_i = −K_i [x̂; ξ; u[k−1]] + Nbar_i r, on top of u[k−1] where the law gives its change. An r that is not finite
 * counts as 0. */
static lqg_real law(const lqg_servo_t *servo, const lqg_servo_state_t *state, unsigned i, const lqg_real x[])
{
    LQG_STRICT_BODY
    const unsigned nx = servo->nx, nxi = servo->nxi, last = servo->gives_change ? servo->nu : 0;
    const lqg_real *K = servo->K + i * (nx + nxi + last), *r = state->r;

    lqg_real sum = subtract_row_product(last ? state->u_applied[i] : 0, K, 0, nx, x);
    sum = subtract_row_product(sum, K + nx, 0, nxi, state->xi);
    sum = subtract_row_product(sum, K + nx + nxi, 0, last, state->u_applied);
    for (unsigned j = 0; servo->Nbar && j < servo->nr; j++)
        sum = multiply_add(servo->Nbar[i * servo->nr + j], is_finite(r[j]) ? r[j] : 0, sum);
    return sum;
}

static lqg_status_t check_reference(const lqg_servo_t *servo, const lqg_real r[])
{
    lqg_status_t status = LQG_OK;

    for (unsigned j = 0; j < servo->nr; j++)
        status |= is_finite(r[j]) ? LQG_OK : LQG_REFERENCE_NOT_FINITE;
    return status;
}

/* *value within [low, high]. */
static lqg_status_t limit(lqg_real *value, lqg_real low, lqg_real high)
{
    const int is_low = *value < low;
    const int is_high = *value > high;

    *value = is_low ? low : is_high ? high : *value;
    return is_low || is_high ? LQG_INPUT_LIMITED : LQG_OK;
}

static lqg_status_t limit_input(const lqg_servo_t *servo, unsigned i, const lqg_real u_applied[], lqg_real *u)
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;

    if (servo->u_step)
        status |= limit(u, u_applied[i] - servo->u_step[i], u_applied[i] + servo->u_step[i]);
    if (servo->u_min || servo->u_max)
        status |= limit(u, servo->u_min ? servo->u_min[i] : *u, servo->u_max ? servo->u_max[i] : *u);
    return status;
}

lqg_status_t lqg_servo_control(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real x[], lqg_real u[])
{
    check_contract(servo, state);
    LQG_ASSERT(x && u);
    lqg_status_t status = check_reference(servo, state->r);

    for (unsigned i = 0; i < servo->nu; i++) {
        const lqg_real v = law(servo, state, i, x);
        status |= is_finite(v) ? LQG_OK : LQG_INPUT_LIMITED;
        u[i] = is_finite(v) ? v : 0;
        if (state->demand)
            state->demand[i] = u[i];
        status |= limit_input(servo, i, state->u_applied, &u[i]);
    }
    return status;
}

/* Begins anew unless ξ is within its bounds and u is finite. */
static lqg_status_t reset_unless_bounded(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real u[])
{
    bounds_check_t check = {0, 0, 0};

    lqg_bounds_check_add(&check, state->xi, servo->xi_scale, servo->nxi);
    if (state->u_applied)
        lqg_bounds_check_add(&check, u, NULL, servo->nu);
    if (is_within_bounds(&check))
        return LQG_OK;

    begin_memory(servo, state);
    return LQG_STATE_RESET;
}

/* ξ_i + H_i (u − v) */
static lqg_real corrected(const lqg_servo_t *servo, const lqg_real H[], unsigned i, const lqg_real xi[],
                          const lqg_real u[], const lqg_real v[])
{
    LQG_STRICT_BODY
    lqg_real sum = xi[i];

    for (unsigned j = 0; j < servo->nu; j++)
        sum = multiply_add(H[i * servo->nu + j], u[j] - v[j], sum);
    return sum;
}

lqg_status_t lqg_servo_advance(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real u[])
{
    LQG_STRICT_BODY
    check_contract(servo, state);
    LQG_ASSERT(u);
    lqg_real *xi = state->xi, *error = state->error, *demand = state->demand;

    for (unsigned i = 0; i < servo->nxi; i++) {
        xi[i] = multiply_add(servo->T, error[i], corrected(servo, servo->H, i, xi, u, demand));
        error[i] = 0;
    }
    if (servo->nxi)
        copy(demand, u, servo->nu);
    if (state->u_applied)
        copy(state->u_applied, u, servo->nu);
    return reset_unless_bounded(servo, state, u);
}

lqg_status_t lqg_servo_set_input(const lqg_servo_t *servo, lqg_servo_state_t *state, const lqg_real x[],
                                 const lqg_real u[])
{
    check_contract(servo, state);
    LQG_ASSERT(x && u);
    lqg_real *xi = state->xi, *demand = state->demand;
    lqg_status_t status = LQG_OK;

    if (state->u_applied)
        copy(state->u_applied, u, servo->nu);
    if (servo->nxi) {
        status = check_reference(servo, state->r);
        for (unsigned i = 0; i < servo->nu; i++)
            demand[i] = law(servo, state, i, x);
        for (unsigned i = 0; i < servo->nxi; i++)
            xi[i] = corrected(servo, servo->H_input ? servo->H_input : servo->H, i, xi, u, demand);
        copy(demand, u, servo->nu);
    }
    return status | reset_unless_bounded(servo, state, u);
}

LQG_STRICT_END
